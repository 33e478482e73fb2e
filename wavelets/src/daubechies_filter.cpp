#include <complex>
#include <string>
#include <vector>

#include "memo.hpp"
#include "refinable.hpp"
#include "require.hpp"
#include "wavebalance/wavelets/filter.hpp"

namespace wavebalance::wavelets {
namespace {

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 Extended;
#else
using Extended = long double;
#endif

// std::complex of a non-standard floating type is unspecified, hence these few lines.
template <class Real>
struct ComplexOf {
  Real re = 0, im = 0;
  friend ComplexOf operator+(ComplexOf a, ComplexOf b) { return {a.re + b.re, a.im + b.im}; }
  friend ComplexOf operator-(ComplexOf a, ComplexOf b) { return {a.re - b.re, a.im - b.im}; }
  friend ComplexOf operator*(ComplexOf a, ComplexOf b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend Real squared_modulus(ComplexOf a) { return a.re * a.re + a.im * a.im; }
  friend ComplexOf operator/(ComplexOf a, ComplexOf b) {
    const Real scale = squared_modulus(b);
    const ComplexOf product = a * ComplexOf{b.re, -b.im};
    return {product.re / scale, product.im / scale};
  }
};
using Complex = ComplexOf<Extended>;

// Newton from the double-precision root: 53 -> 106 -> 113 bits.
Complex square_root(Complex a) {
  const auto start = std::sqrt(std::complex<double>(static_cast<double>(a.re), static_cast<double>(a.im)));
  Complex root{start.real(), start.imag()};
  for (int step = 0; step < 3; ++step) root = Complex{0.5, 0} * (root + a / root);
  return root;
}

// Coefficients of P(y) = sum_k binomial(N-1+k, k) y^k, lowest first; integers below 2^53 for N <= 20.
std::vector<Extended> daubechies_polynomial(int zeros) {
  std::vector<Extended> coefficients(zeros, 1);
  for (int k = 1; k < zeros; ++k) coefficients[k] = coefficients[k - 1] * (zeros - 1 + k) / k;
  return coefficients;
}

// Improves all roots at once by Durand-Kerner sweeps, until the square of the largest step is below
// `tolerance`.
template <class Real>
void improve_roots(const std::vector<Extended>& coefficients, Real tolerance,
                   std::vector<ComplexOf<Real>>& root) {
  using Number = ComplexOf<Real>;
  const auto coefficient = [&](std::size_t k) { return Number{static_cast<Real>(coefficients[k]), 0}; };
  const std::size_t degree = root.size();
  for (int sweep = 0; sweep < 500; ++sweep) {
    Real change = 0;
    for (std::size_t i = 0; i < degree; ++i) {
      Number value = coefficient(degree);
      for (std::size_t k = degree; k-- > 0;) value = value * root[i] + coefficient(k);
      Number others = coefficient(degree);
      for (std::size_t j = 0; j < degree; ++j)
        if (j != i) others = others * (root[i] - root[j]);
      const Number step = value / others;
      root[i] = root[i] - step;
      if (squared_modulus(step) > change) change = squared_modulus(step);
    }
    if (change < tolerance) return;
  }
}

// The roots of P lie near the curve |4 y (1 - y)| = 1 and are simple. Most sweeps run in double precision,
// which is faster by two orders of magnitude.
std::vector<Complex> roots(const std::vector<Extended>& coefficients) {
  std::vector<ComplexOf<double>> near(coefficients.size() - 1);
  ComplexOf<double> start{0.25, 0};
  for (auto& value : near) value = start = start * ComplexOf<double>{0.4, 0.9};
  improve_roots(coefficients, 1e-20, near);
  std::vector<Complex> root;
  for (const auto& value : near) root.push_back({value.re, value.im});
  improve_roots(coefficients, Extended(1e-56), root);
  return root;
}

// The root of z + 1/z = 2 - 4 y inside the unit circle, from the outer one to avoid cancellation.
Complex inner_root(Complex y) {
  const Complex b = Complex{1, 0} - Complex{2, 0} * y;
  const Complex s = square_root(b * b - Complex{1, 0});
  const Complex plus = b + s, minus = b - s;
  return Complex{1, 0} / (squared_modulus(plus) > squared_modulus(minus) ? plus : minus);
}

void multiply_by(std::vector<Complex>& polynomial, Complex constant, Complex linear) {
  polynomial.push_back({});
  for (std::size_t k = polynomial.size() - 1; k > 0; --k)
    polynomial[k] = polynomial[k] * constant + polynomial[k - 1] * linear;
  polynomial[0] = polynomial[0] * constant;
}

// prod (1 - z w) over the roots with |z| < 1, in the delay w: the minimum-phase factor without zeros at pi.
std::vector<Complex> minimum_phase_factor(int zeros) {
  std::vector<Complex> product{{1, 0}};
  for (const Complex& y : roots(daubechies_polynomial(zeros)))
    multiply_by(product, {1, 0}, Complex{} - inner_root(y));
  return product;
}

}  // namespace

detail::ExtendedVector detail::extended_daubechies_filter(int coefficients, int removed) {
  if (coefficients < 2 || coefficients > 40 || coefficients % 2 != 0)
    reject("daubechies_filter: coefficients", std::to_string(coefficients), "even and in 2..40");
  const int zeros = coefficients / 2;
  static Memo<int, std::vector<Complex>> factors;
  std::vector<Complex> product = factors.get(zeros, [&] { return minimum_phase_factor(zeros); });
  for (int k = 0; k < zeros - removed; ++k) multiply_by(product, {1, 0}, {1, 0});
  Extended sum = 0;
  for (const Complex& value : product) sum += value.re;
  ExtendedVector filter(coefficients - removed);
  for (int k = 0; k < coefficients - removed; ++k)
    filter[k] = static_cast<long double>(2 * product[k].re / sum);
  return filter;
}

Eigen::VectorXd daubechies_filter(int coefficients) {
  return detail::extended_daubechies_filter(coefficients).cast<double>();
}

}  // namespace wavebalance::wavelets

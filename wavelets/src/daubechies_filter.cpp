#include <complex>
#include <stdexcept>
#include <string>
#include <vector>

#include "refinable.hpp"
#include "wavebalance/wavelets/filter.hpp"

namespace wavebalance::wavelets {
namespace {

#if defined(__SIZEOF_FLOAT128__)
__extension__ typedef __float128 Extended;
#else
using Extended = long double;
#endif

// std::complex of a non-standard floating type is unspecified, hence these few lines.
struct Complex {
  Extended re = 0, im = 0;
};
Complex operator+(Complex a, Complex b) { return {a.re + b.re, a.im + b.im}; }
Complex operator-(Complex a, Complex b) { return {a.re - b.re, a.im - b.im}; }
Complex operator*(Complex a, Complex b) { return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re}; }
Extended squared_modulus(Complex a) { return a.re * a.re + a.im * a.im; }
Complex operator/(Complex a, Complex b) {
  const Extended scale = squared_modulus(b);
  const Complex product = a * Complex{b.re, -b.im};
  return {product.re / scale, product.im / scale};
}

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

// All roots at once by Durand-Kerner sweeps. The roots of P lie near the curve |4 y (1 - y)| = 1 and are
// simple.
std::vector<Complex> roots(const std::vector<Extended>& coefficients) {
  const int degree = static_cast<int>(coefficients.size()) - 1;
  std::vector<Complex> root(degree);
  Complex start{0.25, 0};
  for (auto& value : root) value = start = start * Complex{0.4, 0.9};
  for (int sweep = 0; sweep < 500; ++sweep) {
    Extended change = 0;
    for (int i = 0; i < degree; ++i) {
      Complex value{coefficients[degree], 0};
      for (int k = degree - 1; k >= 0; --k) value = value * root[i] + Complex{coefficients[k], 0};
      Complex others{coefficients[degree], 0};
      for (int j = 0; j < degree; ++j)
        if (j != i) others = others * (root[i] - root[j]);
      const Complex step = value / others;
      root[i] = root[i] - step;
      if (squared_modulus(step) > change) change = squared_modulus(step);
    }
    if (change < 1e-56) break;
  }
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

}  // namespace

detail::ExtendedVector detail::extended_daubechies_filter(int coefficients, int removed) {
  if (coefficients < 2 || coefficients > 40 || coefficients % 2 != 0)
    throw std::invalid_argument("daubechies_filter: coefficients = " + std::to_string(coefficients) +
                                ", allowed: even numbers 2..40");
  const int zeros = coefficients / 2;
  std::vector<Complex> product{{1, 0}};
  // Minimum phase: in the delay w, 1 - z w with |z| < 1.
  for (const Complex& y : roots(daubechies_polynomial(zeros)))
    multiply_by(product, {1, 0}, Complex{} - inner_root(y));
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

#include "linalg/multipliers.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/dense.hpp"
#include "linalg/lapack.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"

namespace wavebalance::solvers::detail {
namespace {

using Complex = std::complex<double>;

constexpr double on_circle = 1e-15;  // rounding of z / |z|

// Eigenvalues with the error of each, `map_error` of the norm over their condition, both of the balanced map.
struct KnownEigenvalues {
  Eigen::VectorXcd values;
  Eigen::VectorXd errors;
};

KnownEigenvalues with_errors(Eigen::MatrixXd map, double map_error) {
  const lapack_int n = lapack_size(map.rows());
  Eigen::MatrixXd left(n, n), right(n, n);
  Eigen::VectorXd real(n), imaginary(n), scale(n), condition(n), unused(n);
  lapack_int low = 0, high = 0;
  double norm = 0.0;
  KnownEigenvalues result{Eigen::VectorXcd::Constant(n, missing), Eigen::VectorXd::Constant(n, missing)};
  if (LAPACKE_dgeevx(LAPACK_COL_MAJOR, 'B', 'V', 'V', 'E', n, map.data(), n, real.data(), imaginary.data(),
                     left.data(), n, right.data(), n, &low, &high, scale.data(), &norm, condition.data(),
                     unused.data()) != 0)
    return result;
  result.values.real() = real;
  result.values.imag() = imaginary;
  result.errors = map_error * norm * condition.cwiseInverse();
  return result;
}

}  // namespace

Eigen::VectorXcd map_multipliers(Eigen::MatrixXd map) {
  constexpr double map_error = 1e-12, near = 1e-3;
  if (map.size() == 0) return {};
  if (!map.allFinite()) return Eigen::VectorXcd::Constant(map.rows(), missing);
  // States of overdamped modes decay to numbers that keep the QR iteration from converging.
  const double vanishing = 1e-40 * map.cwiseAbs().maxCoeff();
  map = (map.array().abs() > vanishing).select(map, 0.0);
  Eigen::VectorXcd values = eigenvalues(map);
  // Condition numbers need three times as long.
  if (((values.array().abs() - 1.0).abs() < near).any()) {
    const KnownEigenvalues known = with_errors(std::move(map), map_error);
    values = known.values;
    for (Eigen::Index i = 0; i < values.size(); ++i)
      if (std::abs(std::abs(values[i]) - 1.0) <= known.errors[i]) values[i] /= std::abs(values[i]);
  }
  std::ranges::stable_sort(values, [](Complex a, Complex b) { return std::abs(a) > std::abs(b); });
  return values;
}

Complex free_multiplier(Complex exponent) {
  constexpr double rounding = 1e-10;
  const bool undamped = std::abs(exponent.real()) <= rounding * std::abs(exponent);
  return std::exp(undamped ? Complex(0.0, exponent.imag()) : exponent);
}

bool lies_on_circle(Complex multiplier) { return std::abs(std::abs(multiplier) - 1.0) <= on_circle; }

bool lies_outside_circle(Complex multiplier) { return std::abs(multiplier) > 1.0 + on_circle; }

int count_outside(const Eigen::VectorXcd& multipliers) {
  if (multipliers.size() == 0 || !multipliers.allFinite()) return -1;
  const auto outside = std::ranges::count_if(multipliers, lies_outside_circle);
  return outside == 0 && std::ranges::any_of(multipliers, lies_on_circle) ? -1 : static_cast<int>(outside);
}

}  // namespace wavebalance::solvers::detail

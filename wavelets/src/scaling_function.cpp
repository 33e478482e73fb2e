#include "wavebalance/wavelets/scaling_function.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "memo.hpp"
#include "refinable.hpp"
#include "require.hpp"
#include "wavebalance/wavelets/bspline.hpp"
#include "wavebalance/wavelets/filter.hpp"

namespace wavebalance::wavelets {
namespace {

// exp(-2 pi i x), with x first reduced to one period, which is exact.
std::complex<double> unit_phase(double x) {
  return std::polar(1.0, -2.0 * std::numbers::pi * std::remainder(x, 1.0));
}

// H^s embeds in C^d for s > d + 1/2; a compactly supported function in C^d is in H^d, so d <= s.
int continuous_derivatives(const Eigen::VectorXd& filter, double sobolev) {
  const int certain = static_cast<int>(std::ceil(sobolev - 0.5)) - 1;
  const int possible = static_cast<int>(std::floor(sobolev));
  for (int steps = 4; steps <= 16; steps += 4)
    if (possible > certain && hoelder_lower_bound(filter, steps) > possible) return possible;
  return certain;
}

Eigen::VectorXd spline_table(int degree, int level, int derivative) {
  const Eigen::Index one = Eigen::Index{1} << level;
  Eigen::VectorXd table = Eigen::VectorXd::Zero((degree + 1) * one + 1);
  for (Eigen::Index n = 0; n < one; ++n) {
    const Eigen::VectorXd values =
        bspline_values(degree, std::ldexp(static_cast<double>(n), -level), derivative);
    for (int j = 0; j <= degree; ++j) table[n + j * one] = values[j];
  }
  return table;
}

Eigen::VectorXd daubechies_table(int coefficients, int level, int derivative) {
  static detail::Memo<std::pair<int, int>, detail::Refinable> known;
  const detail::Refinable& divided = known.get({coefficients, derivative}, [&] {
    return detail::refinable(detail::extended_daubechies_filter(coefficients, derivative));
  });
  return detail::values_at_dyadics(divided, level, derivative);
}

// ((1 - exp(-2 pi i x)) / (2 pi i x))^(degree + 1), as the power of sin(pi x)/(pi x) and of a phase.
std::complex<double> spline_transform(int degree, double cycles) {
  if (cycles == 0.0) return 1.0;
  const double sine = std::sin(std::numbers::pi * std::remainder(cycles, 2.0)) / (std::numbers::pi * cycles);
  return std::pow(sine, degree + 1) * unit_phase(std::remainder(cycles, 2.0) * 0.5 * (degree + 1));
}

std::complex<double> refinement_product(const Eigen::VectorXd& filter, double cycles) {
  std::complex<double> product = 1.0;
  // m0 differs from 1 by less than pi L |x|, and so does the whole remaining product.
  const double negligible =
      0.01 * std::numeric_limits<double>::epsilon() / static_cast<double>(filter.size());
  for (double x = 0.5 * cycles; std::abs(x) > negligible; x *= 0.5) {
    const std::complex<double> w = unit_phase(x);
    std::complex<double> symbol = 0.0;
    for (Eigen::Index l = filter.size() - 1; l >= 0; --l) symbol = symbol * w + filter[l];
    product *= 0.5 * symbol;
    if (product == 0.0) break;
  }
  return product;
}

}  // namespace

ScalingFunction ScalingFunction::daubechies(int coefficients) {
  if (coefficients == 2) return haar();
  static detail::Memo<int, ScalingFunction> made;
  return made.get(coefficients, [&] { return make_daubechies(coefficients); });
}

ScalingFunction ScalingFunction::make_daubechies(int coefficients) {
  ScalingFunction result;
  result.filter_ = daubechies_filter(coefficients);
  result.name_ = "daubechies" + std::to_string(coefficients);
  result.coefficients_ = Eigen::VectorXd::Ones(1);
  result.sobolev_exponent_ = wavelets::sobolev_exponent(result.filter_);
  result.pointwise_derivatives_ = continuous_derivatives(result.filter_, result.sobolev_exponent_);
  return result;
}

ScalingFunction ScalingFunction::haar() {
  ScalingFunction result;
  result.filter_ = Eigen::Vector2d(1.0, 1.0);
  result.name_ = "haar";
  result.coefficients_ = Eigen::VectorXd::Ones(1);
  result.spline_degree_ = 0;
  result.sobolev_exponent_ = 0.5;
  result.pointwise_derivatives_ = 0;
  return result;
}

ScalingFunction ScalingFunction::orthonormal_bspline() {
  constexpr int largest = 50;
  static const Eigen::VectorXd half = orthonormal_cubic_coefficients(largest);  // the same for all
  ScalingFunction result;
  result.filter_ = bspline_filter(3);
  result.name_ = "bspline";
  result.first_coefficient_ = -largest;
  result.coefficients_.resize(2 * largest + 1);
  for (int k = 0; k <= largest; ++k)
    result.coefficients_[largest + k] = result.coefficients_[largest - k] = half[k];
  result.spline_degree_ = 3;
  result.sobolev_exponent_ = 3.5;
  result.pointwise_derivatives_ = 2;
  return result;
}

Eigen::VectorXd ScalingFunction::values(int level, int derivative) const {
  detail::require_in_range("ScalingFunction::values: level", level, 0, 24);
  detail::require_in_range("ScalingFunction::values: derivative of " + name_, derivative, 0,
                           pointwise_derivatives_);
  const Eigen::VectorXd table = spline_degree_
                                    ? spline_table(*spline_degree_, level, derivative)
                                    : daubechies_table(static_cast<int>(filter_.size()), level, derivative);
  if (coefficients_.size() == 1) return table;
  const Eigen::Index one = Eigen::Index{1} << level;
  Eigen::VectorXd result = Eigen::VectorXd::Zero((coefficients_.size() - 1) * one + table.size());
  for (Eigen::Index k = 0; k < coefficients_.size(); ++k)
    result.segment(k * one, table.size()) += coefficients_[k] * table;
  return result;
}

std::complex<double> ScalingFunction::fourier_transform(double xi) const {
  return fourier_transform_at_cycles(xi / (2.0 * std::numbers::pi));
}

std::complex<double> ScalingFunction::fourier_transform_at_cycles(double cycles) const {
  if (!std::isfinite(cycles))
    detail::reject("ScalingFunction::fourier_transform: frequency", std::to_string(cycles), "finite");
  if (!spline_degree_) return refinement_product(filter_, cycles);
  const std::complex<double> spline = spline_transform(*spline_degree_, cycles);
  if (coefficients_.size() == 1) return spline;
  return spline /
         std::sqrt(cubic_gram_symbol(std::cos(2.0 * std::numbers::pi * std::remainder(cycles, 1.0))));
}

}  // namespace wavebalance::wavelets

#include "wavebalance/wavelets/connection.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "memo.hpp"
#include "refinable.hpp"
#include "require.hpp"

namespace wavebalance::wavelets {
namespace {

// result[n] = sum_{k - j = n} left_j right_k, n = -(left.size() - 1)..right.size() - 1
template <class Vector>
Vector correlation(const Vector& left, const Vector& right) {
  Vector result = Vector::Zero(left.size() + right.size() - 1);
  for (Eigen::Index j = 0; j < left.size(); ++j)
    result.segment(left.size() - 1 - j, right.size()) += left[j] * right;
  return result;
}

Eigen::VectorXd convolution(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(a.size() + b.size() - 1);
  for (Eigen::Index k = 0; k < a.size(); ++k) result.segment(k, b.size()) += a[k] * b;
  return result;
}

int zeros(const ScalingFunction& function) {
  return function.spline_degree() ? *function.spline_degree() + 1
                                  : static_cast<int>(function.filter().size()) / 2;
}

detail::ExtendedVector divided_filter(const ScalingFunction& function, int removed) {
  if (function.spline_degree()) return detail::extended_bspline_filter(*function.spline_degree(), removed);
  return detail::extended_daubechies_filter(static_cast<int>(function.filter().size()), removed);
}

// C^(derivative) at the integers. The zeros at pi that have to be divided out are taken in equal numbers from
// both filters, as far as each has them.
Eigen::VectorXd correlation_values(const ScalingFunction& trial, const ScalingFunction& weight,
                                   int derivative) {
  const int of_trial = std::min(zeros(trial), std::max(derivative - zeros(weight), (derivative + 1) / 2));
  const detail::ExtendedVector mask =
      correlation(divided_filter(weight, derivative - of_trial), divided_filter(trial, of_trial)) / 2.0L;
  return detail::values_at_integers(mask, derivative);
}

// Key of a family: the degree of a spline, which is at least 0, or minus the length of a Daubechies filter.
int family(const ScalingFunction& function) {
  return function.spline_degree() ? *function.spline_degree() : -static_cast<int>(function.filter().size());
}

const Eigen::VectorXd& known_correlation_values(const ScalingFunction& trial, const ScalingFunction& weight,
                                                int derivative) {
  static detail::Memo<std::tuple<int, int, int>, Eigen::VectorXd> known;
  return known.get({family(trial), family(weight), derivative},
                   [&] { return correlation_values(trial, weight, derivative); });
}

std::string describe(const ScalingFunction& trial, const ScalingFunction& weight, int derivative) {
  return "the inner product of " + weight.name() + " with derivative " + std::to_string(derivative) + " of " +
         trial.name() + " does not exist: the sum of their Sobolev exponents " +
         std::to_string(weight.sobolev_exponent()) + " and " + std::to_string(trial.sobolev_exponent()) +
         " is " + std::to_string(weight.sobolev_exponent() + trial.sobolev_exponent()) +
         "; it must be above " + std::to_string(derivative);
}

}  // namespace

InadmissiblePairError::InadmissiblePairError(const ScalingFunction& trial, const ScalingFunction& weight,
                                             int derivative)
    : std::domain_error(describe(trial, weight, derivative)),
      trial_exponent_(trial.sobolev_exponent()),
      weight_exponent_(weight.sobolev_exponent()),
      derivative_(derivative) {}

bool connection_exists(const ScalingFunction& trial, const ScalingFunction& weight, int derivative) {
  // A sum equal to the derivative is the critical case and excluded; the margin covers rounding.
  return trial.sobolev_exponent() + weight.sobolev_exponent() > derivative + 1e-6;
}

ConnectionCoefficients connection_coefficients(const ScalingFunction& trial, const ScalingFunction& weight,
                                               int derivative) {
  detail::require_in_range("connection_coefficients: derivative", derivative, 0, 12);
  if (!connection_exists(trial, weight, derivative)) throw InadmissiblePairError(trial, weight, derivative);
  ConnectionCoefficients result;
  result.first = 1 - static_cast<int>(weight.filter().size());
  result.values = known_correlation_values(trial, weight, derivative);
  if (trial.coefficients().size() == 1 && weight.coefficients().size() == 1) return result;
  // \int B_w(x - l - a) B_t^(d)(x - b) dx = C^(d)(l + a - b): shifts by b - a.
  result.values = convolution(result.values, correlation(weight.coefficients(), trial.coefficients()));
  result.first += trial.first_coefficient() - weight.first_coefficient() -
                  static_cast<int>(weight.coefficients().size() - 1);
  return result;
}

Eigen::VectorXd periodic_inner_products(const PeriodicBasis& trial, const PeriodicBasis& weight,
                                        int derivative) {
  if (trial.level() != weight.level())
    detail::reject("periodic_inner_products: the number of weight functions",
                   std::to_string(weight.functions()),
                   "that of the trial functions, " + std::to_string(trial.functions()));
  const ConnectionCoefficients line =
      connection_coefficients(trial.scaling_function(), weight.scaling_function(), derivative);
  const int period = trial.functions();
  Eigen::VectorXd circle = Eigen::VectorXd::Zero(period);
  for (int l = line.first; l <= line.last(); ++l) circle[((l % period) + period) % period] += line(l);
  return circle * std::ldexp(1.0, trial.level() * (derivative - 1));
}

}  // namespace wavebalance::wavelets

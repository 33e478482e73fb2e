#include "wavebalance/solvers/time/time_pair.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "wavebalance/solvers/time/translate_spectrum.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

// The number of the `derivative` derivatives that are taken of the trial function. The others are taken of
// the weight, each with a change of sign.
int trial_order(Formulation formulation, int derivative) {
  switch (formulation) {
    case Formulation::strong:
      return derivative;
    case Formulation::weak:
      return derivative == 2 ? 1 : derivative;
    case Formulation::distributional:
      return 0;
  }
  return derivative;
}

std::string derivative_reason(const char* side, int needed, int available) {
  return std::string("the formulation samples derivative ") + std::to_string(needed) + " of the " + side +
         " functions, which have pointwise values up to derivative " + std::to_string(available) +
         " only; use inner_products = \"exact\" or another formulation";
}

}  // namespace

Admissibility admissibility(const AnyTimeBasis& trial, const AnyTimeBasis& weight, Formulation formulation,
                            InnerProducts inner_products) {
  const double sum = trial.sobolev_exponent() + weight.sobolev_exponent();
  constexpr double rounding = 1e-9;  // critical pairs (DB4:DB4 sums to 2 exactly) must not pass by rounding
  if (!(sum > 2.0 + rounding))
    return {false, "the Sobolev exponents of trial and weight are " +
                       std::to_string(trial.sobolev_exponent()) + " and " +
                       std::to_string(weight.sobolev_exponent()) +
                       "; the second derivative needs a sum above 2"};
  if (inner_products == InnerProducts::exact) return {};
  const int on_trial = trial_order(formulation, 2);
  const int on_weight = std::max(2 - on_trial, 1 - trial_order(formulation, 1));
  const int trial_needs = std::max(on_trial, trial_order(formulation, 1));
  if (trial.pointwise_derivatives() < trial_needs)
    return {false, derivative_reason("trial", trial_needs, trial.pointwise_derivatives())};
  if (weight.pointwise_derivatives() < on_weight)
    return {false, derivative_reason("weighting", on_weight, weight.pointwise_derivatives())};
  return {};
}

TimePair::TimePair(AnyTimeBasis trial, AnyTimeBasis weight, TimePairOptions options)
    : trial_(std::move(trial)),
      weight_(std::move(weight)),
      options_(std::move(options)),
      functions_(trial_.functions()),
      points_(options_.quadrature_points) {
  require_sizes();
  const Admissibility verdict = admissibility(trial_, weight_, options_.formulation, options_.inner_products);
  if (!verdict.admissible) throw InadmissiblePair("TimePair: " + verdict.reason);
  trial_spectrum_ = sampled_spectrum(trial_, points_, 0, options_.sample_offset);
  weight_spectrum_ = sampled_spectrum(weight_, points_, 0, options_.sample_offset);
  for (int d = 0; d <= 2; ++d)
    symbols_[static_cast<std::size_t>(d)] =
        options_.inner_products == InnerProducts::quadrature ? sampled_symbol(d) : exact_symbol(d);
  require_sampled_nyquist();
}

void TimePair::require_sizes() const {
  const auto fail = [](const std::string& text) { throw std::invalid_argument("TimePair: " + text); };
  if (weight_.functions() != functions_)
    fail("the trial basis has " + std::to_string(functions_) + " functions and the weighting basis " +
         std::to_string(weight_.functions()) + "; they must have the same number");
  if (points_ < functions_)
    fail("quadrature_points is " + std::to_string(points_) + "; at least as many as the " +
         std::to_string(functions_) + " functions are needed");
  const bool any = trial_.band_limited() && weight_.band_limited();
  if (!any && points_ % functions_ != 0)
    fail("quadrature_points is " + std::to_string(points_) + "; it must be a multiple of the " +
         std::to_string(functions_) + " functions unless both bases are Fourier");
  if (options_.sample_offset != 0.0 && options_.sample_offset != 0.5)
    fail("sample_offset is " + std::to_string(options_.sample_offset) + "; it must be 0 or 0.5");
}

// Alternating functions, of which one is even and the other odd about the middles, have no product there: the
// coefficient would be without mass and stiffness.
void TimePair::require_sampled_nyquist() const {
  constexpr double rounding = 1e-12;
  const bool kept = functions_ % 2 == 0 && !drops_nyquist();
  if (!kept || options_.sample_offset == 0.0 || options_.inner_products == InnerProducts::exact) return;
  if (std::abs(symbols_[0][functions_ / 2]) > rounding * std::abs(symbols_[0][0])) return;
  throw std::invalid_argument(
      "TimePair: sample_offset is 0.5, and the product of the alternating functions of trial and weight "
      "vanishes at the middles of " +
      std::to_string(points_) + " intervals; it must be 0, or the Nyquist coefficient of the " +
      std::to_string(functions_) + " functions dropped");
}

int TimePair::shift_period() const {
  const bool full_harmonics = functions_ % 2 == 1 || drops_nyquist();
  const bool filter = trial_.band_limited() && weight_.band_limited() && full_harmonics;
  return filter ? 1 : points_ / std::gcd(points_, functions_);
}

Eigen::VectorXcd TimePair::sampled_symbol(int derivative) const {
  const int on_trial = trial_order(options_.formulation, derivative);
  const int on_weight = derivative - on_trial;
  Eigen::VectorXcd symbol;
  const auto spectrum = [&](const AnyTimeBasis& basis, const Eigen::VectorXcd& values, int order) {
    return order == 0 ? values : sampled_spectrum(basis, points_, order, options_.sample_offset);
  };
  AliasMap{functions_, points_}.fold(spectrum(weight_, weight_spectrum_, on_weight),
                                     spectrum(trial_, trial_spectrum_, on_trial), symbol);
  const double sign = on_weight % 2 == 0 ? 1.0 : -1.0;
  return symbol * (sign * functions_ / points_ / points_);
}

Eigen::VectorXcd TimePair::exact_symbol(int derivative) const {
  if (!trial_.band_limited() && !weight_.band_limited()) {
    if (!options_.exact_column)
      throw std::invalid_argument(
          "TimePair: exact inner products of two bases that are not band-limited need "
          "exact_column, which is empty");
    const Eigen::VectorXd column = options_.exact_column(derivative);
    if (column.size() != functions_)
      throw std::invalid_argument("TimePair: exact_column returned " + std::to_string(column.size()) +
                                  " values; " + std::to_string(functions_) + " functions need as many");
    return translate_spectrum(column);
  }
  Eigen::VectorXcd symbol = Eigen::VectorXcd::Zero(spectrum_size());
  for (int n = -(functions_ / 2); n <= functions_ / 2; ++n) {
    const int k = ((n % functions_) + functions_) % functions_;
    if (k >= spectrum_size()) continue;
    symbol[k] += std::conj(weight_.fourier_coefficient(n)) * trial_.fourier_coefficient(n) *
                 derivative_factor(n, derivative);
  }
  return symbol * functions_;
}

void TimePair::spread(const Eigen::VectorXcd& coefficients, Eigen::VectorXcd& sample_spectrum) const {
  AliasMap{functions_, points_}.replicate(trial_spectrum_, coefficients, sample_spectrum);
}

void TimePair::project(const Eigen::VectorXcd& sample_spectrum, Eigen::VectorXcd& projection) const {
  AliasMap{functions_, points_}.fold(weight_spectrum_, sample_spectrum, projection);
  projection *= static_cast<double>(functions_) / points_ / points_;
}

Eigen::VectorXcd TimePair::load(const Eigen::VectorXcd& harmonics) const {
  Eigen::VectorXcd projection = Eigen::VectorXcd::Zero(spectrum_size());
  const auto add = [&](int n, Complex amplitude, Complex weight) {
    const int k = ((n % functions_) + functions_) % functions_;
    if (k < spectrum_size()) projection[k] += double(functions_) * std::conj(weight) * amplitude;
  };
  const bool exact = options_.inner_products == InnerProducts::exact;
  const auto weight_coefficient = [&](int n) -> Complex {
    if (exact) return weight_.fourier_coefficient(n);
    const int wrapped = ((n % points_) + points_) % points_;
    const Complex value =
        wrapped <= points_ / 2 ? weight_spectrum_[wrapped] : std::conj(weight_spectrum_[points_ - wrapped]);
    return value * std::polar(1.0, -2.0 * std::numbers::pi * n * first_sample()) / double(points_);
  };
  for (int n = 0; n < harmonics.size(); ++n) {
    if (n == 0) {
      add(0, harmonics[0].real(), weight_coefficient(0));
      continue;
    }
    add(n, 0.5 * harmonics[n], weight_coefficient(n));
    add(-n, 0.5 * std::conj(harmonics[n]), weight_coefficient(-n));
  }
  return projection;
}

}  // namespace wavebalance::solvers

#include "wavebalance/solvers/stability/floquet_exponents.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "linalg/multipliers.hpp"
#include "linalg/option_checks.hpp"
#include "stability/floquet_determinant.hpp"
#include "stability/harmonic_map.hpp"
#include "stability/stability_checks.hpp"
#include "stability/winding.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

// log(1 - exp((zero - sigma) T)) and its derivative by sigma: a factor of the characteristic polynomial.
FloquetDeterminant::Value factor(Complex zero, Complex sigma, double period) {
  const Complex decay = std::exp((zero - sigma) * period);
  return {std::log(1.0 - decay), period * decay / (1.0 - decay)};
}

// log of F = Delta(sigma) prod (1 - exp((lambda_j - sigma) T)) = prod (1 - mu_j / z) up to a factor that
// hardly varies, of which the zeros in `found` are divided out.
class CharacteristicPolynomial {
 public:
  explicit CharacteristicPolynomial(FloquetDeterminant& determinant)
      : determinant_(determinant), period_(2.0 * pi / determinant.angular_frequency()) {}

  FloquetDeterminant& determinant() const { return determinant_; }
  double period() const { return period_; }
  std::vector<Complex>& found() { return found_; }
  // How many multipliers outside the unit circle are among those found.
  int unstable() const {
    int count = 0;
    for (const Complex zero : found_)
      if (zero.real() > 0.0) count += is_pair(zero) ? 2 : 1;
    return count;
  }

  FloquetDeterminant::Value operator()(Complex sigma) const {
    FloquetDeterminant::Value value = determinant_(sigma);
    for (const ContactPole& pole : determinant_.dynamics().poles()) add(pole.exponent, sigma, 1.0, value);
    for (const Complex zero : found_) add(zero, sigma, -1.0, value);
    return value;
  }

 private:
  bool is_pair(Complex zero) const {
    const double angle = std::remainder(zero.imag() * period_, 2.0 * pi);
    return std::abs(angle) > 1e-9 && std::abs(angle) < pi - 1e-9;
  }
  void add(Complex zero, Complex sigma, double times, FloquetDeterminant::Value& value) const {
    const bool pair = times > 0.0 ? zero.imag() != 0.0 : is_pair(zero);
    for (const Complex each : {zero, std::conj(zero)}) {
      const FloquetDeterminant::Value one = factor(each, sigma, period_);
      value.log += times * one.log;
      value.derivative += times * one.derivative;
      if (!pair) return;
    }
  }

  FloquetDeterminant& determinant_;
  double period_;
  std::vector<Complex> found_;
};

// The exponent with 0 <= Im sigma <= omega / 2 of a multiplier or of its conjugate.
Complex folded(Complex sigma, double period) {
  return {sigma.real(), std::abs(std::remainder(sigma.imag() * period, 2.0 * pi)) / period};
}

std::optional<Complex> newton_exponent(const CharacteristicPolynomial& characteristic, Complex sigma,
                                       const FloquetOptions& options) {
  const double period = characteristic.period();
  for (int iteration = 0; iteration < options.max_iterations; ++iteration) {
    Complex step = 1.0 / characteristic(sigma).derivative;
    if (!std::isfinite(std::abs(step))) return std::nullopt;
    const double longest = 0.5 / period;
    if (std::abs(step) > longest) step *= longest / std::abs(step);
    sigma -= step;
    if (std::abs(sigma.real() * period) > 20.0) return std::nullopt;
    if (std::abs(step) * period <= options.tolerance) return sigma;
  }
  return std::nullopt;
}

// Multipliers near the determinant's, the upper one of each conjugate pair: from the map at 0, then of
// modes above all harmonics and from the map at omega / 2.
std::vector<Complex> approximate_multipliers(const FloquetDeterminant& determinant) {
  constexpr double least = 1e-2;
  const HarmonicMaps maps = harmonic_maps(determinant);
  std::vector<Complex> multipliers;
  const auto add = [&](const auto& some) {
    for (const Complex one : some)
      if (one.imag() >= 0.0 && std::abs(one) >= least) multipliers.push_back(one);
  };
  add(detail::map_multipliers(maps.at_zero.map));
  add(free_multipliers(determinant));
  std::ranges::stable_sort(multipliers, [](Complex a, Complex b) { return std::abs(a) > std::abs(b); });
  add(detail::map_multipliers(maps.at_half.map));
  return multipliers;
}

std::size_t wanted_exponents(const FloquetOptions& options) {
  return options.starts.empty() ? 2 * std::size_t(options.max_exponents) + 2 : options.starts.size();
}

// Newton's method takes about four evaluations with a derivative, each as costly as three without.
double expected_operations(const FloquetDeterminant& determinant, const FloquetOptions& options) {
  constexpr double evaluations = 12.0;
  return evaluations * double(wanted_exponents(options)) * determinant.operations();
}

// Into found(). Without starts of the caller's the approximate multipliers are not in the order of the
// exact ones, so that twice the requested number is computed.
void find_exponents(CharacteristicPolynomial& characteristic, const FloquetOptions& options) {
  const double period = characteristic.period();
  std::vector<Complex> starts = options.starts;
  const std::size_t wanted = wanted_exponents(options);
  if (starts.empty())
    for (const Complex multiplier : approximate_multipliers(characteristic.determinant()))
      starts.push_back(std::log(multiplier) / period);
  std::vector<Complex>& found = characteristic.found();
  for (const Complex start : starts) {
    if (found.size() == wanted) break;
    const auto sigma = newton_exponent(characteristic, folded(start, period), options);
    if (!sigma) continue;
    const Complex exponent = folded(*sigma, period);
    const bool known = std::any_of(found.begin(), found.end(),
                                   [&](Complex other) { return std::abs(other - exponent) * period < 1e-8; });
    if (!known) found.push_back(exponent);
  }
}

// Laws that depend on the velocity have their exponents from the monodromy, without motions.
FloquetExponents damped_exponents(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                                  double frequency, const FloquetOptions& options) {
  FloquetExponents result;
  result.harmonics = options.stability.harmonics;
  result.status = unstable_multipliers(dynamics, stiffness, frequency, options.stability).status;
  if (result.status != StabilityStatus::converged) return result;
  const Eigen::MatrixXcd none = Eigen::MatrixXcd::Zero(dynamics.contacts(), 2 * result.harmonics + 1);
  for (const Complex multiplier : monodromy(dynamics, stiffness, frequency)) {
    if (multiplier.imag() < 0.0 || multiplier == 0.0) continue;
    if (int(result.values.size()) == options.max_exponents) break;
    result.values.push_back({std::log(multiplier) * frequency, multiplier, none, none});
  }
  return result;
}

}  // namespace

void FloquetOptions::validate() const {
  stability.validate();
  detail::require_at_least("FloquetOptions", "max_raise", max_raise, 1);
  detail::require_at_least("FloquetOptions", "max_exponents", max_exponents, 1);
  detail::require_at_least("FloquetOptions", "max_iterations", max_iterations, 1);
  detail::require_positive("FloquetOptions", "tolerance", tolerance);
  if (!(max_operations > 0.0)) detail::reject("FloquetOptions", "max_operations", max_operations, "positive");
}

FloquetExponents floquet_exponents(const ContactDynamics& dynamics, const PeriodicStiffness& of_contacts,
                                   double frequency, const FloquetOptions& options) {
  const PeriodicStiffness stiffness = held_stiffness(of_contacts, dynamics.contacts(), dynamics.holding());
  options.validate();
  FloquetExponents result;
  result.status = stiffness.status;
  if (!stiffness.friction.empty()) result.status = StabilityStatus::unsupported_law;
  if (result.status != StabilityStatus::converged) return result;
  if (dynamics.structurally_damped()) {
    result.status = StabilityStatus::structural_damping;
    return result;
  }
  require_stability_arguments("floquet_exponents", dynamics, stiffness, frequency,
                              options.stability.harmonics);
  if (stiffness.needs_map()) return damped_exponents(dynamics, stiffness, frequency, options);
  result.status = options.starts.empty() ? require_countable(dynamics, stiffness, 2.0 * pi * frequency)
                                         : require_stiffness(dynamics, stiffness);
  if (result.status != StabilityStatus::converged) return result;
  const int harmonics = options.stability.harmonics;
  auto resolving = resolving_determinant(dynamics, stiffness, frequency, harmonics,
                                         options.max_raise * harmonics, options.stability.max_omitted);
  if (!resolving) {
    result.status = StabilityStatus::too_few_harmonics;
    return result;
  }
  FloquetDeterminant& determinant = *resolving;
  result.harmonics = determinant.harmonics();
  if (options.starts.empty() && expected_operations(determinant, options) > options.max_operations) {
    result.status = StabilityStatus::effort_limit;
    return result;
  }
  CharacteristicPolynomial characteristic(determinant);
  const double period = characteristic.period();
  find_exponents(characteristic, options);
  std::vector<Complex>& found = characteristic.found();
  std::sort(found.begin(), found.end(), [](Complex a, Complex b) { return a.real() > b.real(); });
  if (options.starts.empty()) {
    StabilityOptions counting = options.stability;
    counting.harmonics = result.harmonics;
    const UnstableMultipliers all = unstable_multipliers(dynamics, stiffness, frequency, counting);
    result.evaluations = all.evaluations;
    if (all.count != characteristic.unstable()) result.status = StabilityStatus::effort_limit;
  }
  if (int(found.size()) > options.max_exponents) found.resize(std::size_t(options.max_exponents));
  for (const Complex sigma : found) {
    FloquetDeterminant::Mode mode = determinant.mode(sigma);
    result.values.push_back(
        {sigma, std::exp(sigma * period), std::move(mode.displacement), std::move(mode.force)});
  }
  result.evaluations += determinant.evaluations();
  return result;
}

FloquetExponents floquet_exponents(const ContactDynamics& dynamics, const CondensedProblem& problem,
                                   const ContactLaws& laws, const PeriodicResponse& response,
                                   const FloquetOptions& options) {
  FloquetOptions own = options;
  own.stability = with_harmonics_of(problem.pair(), options.stability);
  return floquet_exponents(dynamics, contact_stiffness(problem, laws, response), response.frequency, own);
}

}  // namespace wavebalance::solvers

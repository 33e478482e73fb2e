#include "wavebalance/solvers/stability/unstable_multipliers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

#include "linalg/dense.hpp"
#include "linalg/multipliers.hpp"
#include "linalg/option_checks.hpp"
#include "stability/floquet_determinant.hpp"
#include "stability/harmonic_map.hpp"
#include "stability/monodromy_map.hpp"
#include "stability/stability_checks.hpp"
#include "stability/switching_monodromy.hpp"
#include "stability/winding.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"

namespace wavebalance::solvers {
namespace {

using std::numbers::pi;

// True where the monodromy costs much less: many nodes on few modes, which many contacts that last long have.
bool is_costly(const FloquetDeterminant& determinant, const PeriodicStiffness& stiffness, double frequency,
               bool eigenvalues) {
  constexpr double many_operations = 1e9;
  const double operations = determinant.operations() * first_evaluations(determinant);
  return operations > many_operations &&
         operations >
             2.0 * monodromy_operations(determinant.dynamics(), stiffness, frequency, eigenvalues, {});
}

int affordable_evaluations(const FloquetDeterminant& determinant, const StabilityOptions& options) {
  const double affordable = options.max_operations / std::max(1.0, determinant.operations());
  return static_cast<int>(std::min<double>(options.max_evaluations, affordable));
}

// The multipliers by modes up to four times the highest harmonic, or twice as far up to 16 times, the
// others being springs at the contacts. Nothing if half as many harmonics never confirm the side of the
// circle, or where a period leaves much of the other modes.
std::optional<Eigen::VectorXcd> by_slow_modes(const ContactDynamics& dynamics,
                                              const PeriodicStiffness& stiffness, double frequency,
                                              const StabilityOptions& options) {
  constexpr double settled = 1e-6;
  constexpr std::size_t most_poles = 40;
  Eigen::VectorXcd before;
  for (const double within : {2.0, 4.0, 8.0, 16.0}) {
    const double modulus = within * 2.0 * pi * frequency * options.harmonics;
    const ContactDynamics slow = dynamics.with_springs_beyond(modulus);
    if (slow.poles().size() > most_poles) return std::nullopt;
    Eigen::VectorXcd multipliers = switching_monodromy(slow, stiffness, frequency, settled);
    if (before.size() > 0 && are_decided(multipliers, before) &&
        fast_modes_decay(dynamics, modulus, frequency))
      return multipliers;
    before = std::move(multipliers);
  }
  return std::nullopt;
}

bool has_monodromy(const ContactDynamics& dynamics, int max_states) {
  return !dynamics.reduced() && 2 * int(dynamics.poles().size()) <= max_states;
}

// Nothing where there are too many states, contact is too stiff for this, too, or the structure is reduced.
std::optional<Eigen::VectorXcd> by_monodromy(const ContactDynamics& dynamics,
                                             const PeriodicStiffness& stiffness, double frequency,
                                             const StabilityOptions& options) {
  if (!has_monodromy(dynamics, options.max_states)) return std::nullopt;
  const Eigen::VectorXcd multipliers = monodromy(dynamics, stiffness, frequency);
  if (!multipliers.allFinite()) return std::nullopt;
  return multipliers;
}

// Why multipliers with a law that depends on the velocity, or of several rows, are not available. A contact
// that deflects at once would need the rate of its force.
StabilityStatus status_of_damped(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                                 const StabilityOptions& options) {
  if (dynamics.structurally_damped()) return StabilityStatus::structural_damping;
  if (stiffness.status != StabilityStatus::converged) return stiffness.status;
  if (stiffness.damping && dynamics.constant().diagonal().cwiseAbs().maxCoeff() > 0.0)
    return StabilityStatus::coupled_massless;
  if (!has_monodromy(dynamics, options.max_states)) return StabilityStatus::too_many_states;
  return StabilityStatus::converged;
}

UnstableMultipliers without_count(StabilityStatus status) {
  UnstableMultipliers result;
  result.status = status;
  return result;
}

int unstable_poles(const ContactDynamics& dynamics) {
  int count = 0;
  for (const ContactPole& pole : dynamics.poles())
    if (pole.exponent.real() > 0.0) count += pole.exponent.imag() == 0.0 ? 1 : 2;
  return count;
}

}  // namespace

void StabilityOptions::validate() const {
  detail::require_at_least("StabilityOptions", "harmonics", harmonics, 0);
  detail::require_at_least("StabilityOptions", "max_states", max_states, 0);
  detail::require_at_least("StabilityOptions", "max_states_with_friction", max_states_with_friction, 0);
  detail::require_positive("StabilityOptions", "max_omitted", max_omitted);
  detail::require_at_least("StabilityOptions", "max_evaluations", max_evaluations, 1);
  detail::require_positive("StabilityOptions", "max_operations", max_operations);
}

bool fast_modes_decay(const ContactDynamics& dynamics, double modulus, double frequency) {
  constexpr double much = 0.9;
  return std::ranges::none_of(dynamics.poles(), [&](const ContactPole& pole) {
    return std::abs(pole.exponent) > modulus && std::exp(pole.exponent.real() / frequency) > much;
  });
}

bool are_decided(const Eigen::VectorXcd& multipliers, const Eigen::VectorXcd& others) {
  constexpr double least_margin = 1e-5;
  if (!multipliers.allFinite() || !others.allFinite()) return false;
  for (Eigen::Index i = 0; i < multipliers.size(); ++i) {
    const double size = std::abs(multipliers[i]), other = i < others.size() ? std::abs(others[i]) : 0.0;
    if (std::abs(size - 1.0) < std::max(least_margin, 3.0 * std::abs(size - other))) return false;
  }
  return detail::count_outside(multipliers) == detail::count_outside(others);
}

StabilityOptions with_harmonics_of(const TimePair& pair, StabilityOptions options) {
  if (options.harmonics == 0) options.harmonics = std::max(1, pair.solved_size() - 1);
  return options;
}

void require_stability_arguments(const char* who, const ContactDynamics& dynamics,
                                 const PeriodicStiffness& stiffness, double frequency, int harmonics) {
  detail::require_positive(who, "frequency", frequency);
  detail::require_at_least(who, "options.harmonics", harmonics, 1);
  for (const ContactInterval& interval : stiffness.intervals)
    if (interval.contact < 0 || interval.contact >= dynamics.contacts())
      throw std::invalid_argument(std::string(who) + ": an interval belongs to contact " +
                                  std::to_string(interval.contact) + "; the structure has " +
                                  std::to_string(dynamics.contacts()));
}

namespace {

// By what the multipliers of a motion are known: a determinant, or without one a map of the period; or why
// they are not.
struct Way {
  StabilityStatus status = StabilityStatus::converged;
  PeriodicStiffness stiffness = {};  // of the structure as it is held
  std::optional<FloquetDeterminant> determinant = std::nullopt;
  std::optional<Eigen::VectorXcd> multipliers = std::nullopt;  // with friction and of rigid contact
  std::optional<HarmonicMaps> maps = std::nullopt;             // of the determinant, once they are needed
};

const HarmonicMaps& maps_of(Way& way) {
  if (!way.maps) way.maps = harmonic_maps(*way.determinant);
  return *way.maps;
}

// The leading multiplier needs more digits than slow modes give.
Way way_of_friction(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness, double frequency,
                    const StabilityOptions& options) {
  constexpr int few_states = 40;
  Way way{dynamics.structurally_damped() ? StabilityStatus::structural_damping : stiffness.status};
  if (way.status != StabilityStatus::converged) return way;
  const bool all_known = has_monodromy(dynamics, options.max_states_with_friction);
  if (!all_known || !(options.leading || has_monodromy(dynamics, few_states)))
    way.multipliers = by_slow_modes(dynamics, stiffness, frequency, options);
  if (way.multipliers) return way;
  if (!all_known) return {StabilityStatus::too_many_states};
  way.multipliers = switching_monodromy(dynamics, stiffness, frequency);
  if (!way.multipliers->allFinite()) way.status = StabilityStatus::too_few_harmonics;
  return way;
}

// Rigid contact has a limit without mass.
Way way_of_rigid(const ContactDynamics& dynamics, const PeriodicStiffness& contact, double frequency,
                 const StabilityOptions& options) {
  if (dynamics.structurally_damped()) return {StabilityStatus::structural_damping};
  Way way{contact.status};
  if (dynamics.holding() > 0.0 || contact.intervals.empty() || !has_monodromy(dynamics, options.max_states))
    return way;
  way.multipliers = rigid_monodromy(dynamics, contact, frequency);
  if (way.multipliers->allFinite()) way.status = StabilityStatus::converged;
  return way;
}

Way way_of(const char* who, const ContactDynamics& dynamics, const PeriodicStiffness& of_contacts,
           double frequency, const StabilityOptions& options) {
  if (!of_contacts.friction.empty()) return way_of_friction(dynamics, of_contacts, frequency, options);
  Way way{{}, held_stiffness(of_contacts, dynamics.contacts(), dynamics.holding())};
  if (way.stiffness.needs_map()) {
    way.status = status_of_damped(dynamics, way.stiffness, options);
    return way;
  }
  options.validate();
  way.status = way.stiffness.status;
  if (way.status != StabilityStatus::converged) return way;
  require_stability_arguments(who, dynamics, way.stiffness, frequency, options.harmonics);
  way.status = require_countable(dynamics, way.stiffness, 2.0 * pi * frequency);
  if (way.status != StabilityStatus::converged) return way;
  // Where these harmonics do not represent perturbations in contact, the map does.
  if (auto found = resolving_determinant(dynamics, way.stiffness, frequency, options.harmonics,
                                         options.harmonics, options.max_omitted))
    way.determinant.emplace(*std::move(found));
  return way;
}

// All multipliers by a map; nothing where contact is too stiff for it, too.
std::optional<Eigen::VectorXcd> multipliers_of(const Way& way, const ContactDynamics& dynamics,
                                               double frequency, const StabilityOptions& options) {
  return way.multipliers ? way.multipliers : by_monodromy(dynamics, way.stiffness, frequency, options);
}

std::optional<UnstableMultipliers> counted_by_map(const Way& way, const ContactDynamics& dynamics,
                                                  double frequency, const StabilityOptions& options) {
  UnstableMultipliers result;
  if (options.leading || way.multipliers) {
    const auto multipliers = multipliers_of(way, dynamics, frequency, options);
    if (!multipliers) return std::nullopt;
    result.count = detail::count_outside(*multipliers);
    if (result.count < 0)
      result.status = has_undamped_pole(dynamics, 2.0 * pi * frequency) ? StabilityStatus::undamped
                                                                        : StabilityStatus::on_unit_circle;
    if (multipliers->size() > 0)
      result.leading = {(*multipliers)[0].real(), std::abs((*multipliers)[0].imag())};
  } else {
    if (!has_monodromy(dynamics, options.max_states)) return std::nullopt;
    const auto map = lasting_map(dynamics, way.stiffness, frequency);
    if (map) result.count = detail::count_outside_circle(*map);
    if (result.count < 0) return std::nullopt;
  }
  result.winding = result.count;
  return result;
}

double distance_to(std::complex<double> one, const Eigen::VectorXcd& others) {
  return (others.array() - one).abs().minCoeff();
}

// Whether each multiplier of one map is farther from the circle than three times its distance to the other
// map's, and both have the same number outside.
bool are_decided_by_maps(const Eigen::VectorXcd& multipliers, const Eigen::VectorXcd& others) {
  constexpr double least_margin = 1e-5;
  if (multipliers.size() == 0 || !multipliers.allFinite() || !others.allFinite()) return false;
  for (const std::complex<double> one : multipliers)
    if (std::abs(std::abs(one) - 1.0) < std::max(least_margin, 3.0 * distance_to(one, others))) return false;
  return detail::count_outside(multipliers) == detail::count_outside(others);
}

// By both maps of the harmonics, where they leave no doubt. Modes above all harmonics have free multipliers.
std::optional<UnstableMultipliers> counted_by_harmonics(Way& way, const StabilityOptions& options) {
  const FloquetDeterminant& determinant = *way.determinant;
  if (determinant.nodes() == 0 || options.max_evaluations < 2 ||
      harmonic_operations(determinant) > options.max_operations)
    return std::nullopt;
  const HarmonicMaps& maps = maps_of(way);
  const Eigen::VectorXcd multipliers = detail::map_multipliers(maps.at_zero.map),
                         others = detail::map_multipliers(maps.at_half.map);
  if (!are_decided_by_maps(multipliers, others)) return std::nullopt;
  UnstableMultipliers result;
  result.harmonics = options.harmonics;
  result.evaluations = 2;
  result.count = detail::count_outside(multipliers);
  result.leading = multipliers[0];
  result.leading_error = 2.0 * distance_to(multipliers[0], others);
  for (const std::complex<double> free : free_multipliers(determinant)) {
    if (std::abs(free) > 1.0) result.count += 2;
    if (std::abs(free) <= std::abs(result.leading)) continue;
    result.leading = free;
    result.leading_error = missing;  // by contact, which these maps leave out
  }
  result.leading.imag(std::abs(result.leading.imag()));
  result.winding = result.count;
  return result;
}

UnstableMultipliers counted_by_determinant(FloquetDeterminant& determinant, const StabilityOptions& options) {
  UnstableMultipliers result;
  result.harmonics = options.harmonics;
  const int own = unstable_poles(determinant.dynamics());
  if (determinant.nodes() == 0) {
    result.count = own;
    return result;
  }
  const int affordable = affordable_evaluations(determinant, options);
  std::optional<double> turned;
  if (const auto polynomial = polynomial_change(determinant, affordable)) {
    turned = polynomial->change;
    result.winding = polynomial->own - *turned / pi;
  } else if ((turned = determinant_change(determinant, affordable))) {
    result.winding = own - *turned / pi;
  }
  result.evaluations = determinant.evaluations();
  const double rounded = std::round(result.winding);
  if (!turned || !(std::abs(result.winding - rounded) < 1e-3) || rounded < 0.0) {
    result.status = StabilityStatus::effort_limit;
    return result;
  }
  result.count = static_cast<int>(rounded);
  return result;
}

UnstableMultipliers count_of(Way& way, const ContactDynamics& dynamics, double frequency,
                             const StabilityOptions& options) {
  if (way.status != StabilityStatus::converged) return without_count(way.status);
  // A map of the motion's own has the leading multiplier, too.
  if (way.determinant && !options.leading)
    if (const auto counted = counted_by_harmonics(way, options)) return *counted;
  if (!way.determinant || is_costly(*way.determinant, way.stiffness, frequency, options.leading))
    if (const auto counted = counted_by_map(way, dynamics, frequency, options)) return *counted;
  if (!way.determinant) return without_count(StabilityStatus::too_few_harmonics);
  if (options.leading)
    if (const auto counted = counted_by_harmonics(way, options)) return *counted;
  return counted_by_determinant(*way.determinant, options);
}

StabilitySigns signs_of(Way& way, const ContactDynamics& dynamics, double frequency,
                        const StabilityOptions& options) {
  StabilitySigns signs{way.status};
  if (way.status != StabilityStatus::converged) return signs;
  if (way.determinant) {
    signs.fold = maps_of(way).at_zero.sign;
    signs.flip = maps_of(way).at_half.sign;
    return signs;
  }
  const auto multipliers = multipliers_of(way, dynamics, frequency, options);
  return multipliers ? signs_of_multipliers(*multipliers)
                     : StabilitySigns{StabilityStatus::too_few_harmonics};
}

}  // namespace

StabilitySigns signs_of_multipliers(const Eigen::VectorXcd& multipliers) {
  const auto real = multipliers.imag().array() == 0.0;
  StabilitySigns signs;
  signs.fold = (real && multipliers.real().array() > 1.0).count() % 2 == 0 ? 1 : -1;
  signs.flip = (real && multipliers.real().array() < -1.0).count() % 2 == 0 ? 1 : -1;
  return signs;
}

std::optional<Eigen::VectorXcd> multipliers_of_costly(const ContactDynamics& dynamics,
                                                      const PeriodicStiffness& stiffness, double frequency,
                                                      const StabilityOptions& options) {
  const Way way = way_of("multipliers", dynamics, stiffness, frequency, options);
  if (way.status != StabilityStatus::converged) return std::nullopt;
  if (way.determinant && is_costly(*way.determinant, way.stiffness, frequency, true))
    return by_monodromy(dynamics, way.stiffness, frequency, options);
  return way.multipliers;
}

UnstableMultipliers unstable_multipliers(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                                         double frequency, const StabilityOptions& options) {
  Way way = way_of("unstable_multipliers", dynamics, stiffness, frequency, options);
  return count_of(way, dynamics, frequency, options);
}

UnstableMultipliers unstable_multipliers(const ContactDynamics& dynamics, const CondensedProblem& problem,
                                         const ContactLaws& laws, const PeriodicResponse& response,
                                         const StabilityOptions& options) {
  const PeriodicStiffness stiffness = contact_stiffness(problem, laws, response);
  if (stiffness.status == StabilityStatus::no_finite_stiffness) {
    Way way = way_of_rigid(dynamics, stiffness, response.frequency, options);
    return count_of(way, dynamics, response.frequency, options);
  }
  return unstable_multipliers(dynamics, stiffness, response.frequency,
                              with_harmonics_of(problem.pair(), options));
}

UnstableMultipliers unstable_multipliers(const CondensedProblem& problem, const ContactLaws& laws,
                                         const PeriodicResponse& response, const StabilityOptions& options) {
  return unstable_multipliers(ContactDynamics(problem.structure()), problem, laws, response, options);
}

StabilitySigns stability_signs(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                               double frequency, const StabilityOptions& options) {
  Way way = way_of("stability_signs", dynamics, stiffness, frequency, options);
  return signs_of(way, dynamics, frequency, options);
}

SignsAndCount signs_and_count(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                              double frequency, const StabilityOptions& options) {
  Way way = way_of("stability_signs", dynamics, stiffness, frequency, options);
  const UnstableMultipliers count = count_of(way, dynamics, frequency, options);
  return {signs_of(way, dynamics, frequency, options), count};
}

StabilitySigns stability_signs(const ContactDynamics& dynamics, const CondensedProblem& problem,
                               const ContactLaws& laws, const PeriodicResponse& response,
                               const StabilityOptions& options) {
  return stability_signs(dynamics, contact_stiffness(problem, laws, response), response.frequency,
                         with_harmonics_of(problem.pair(), options));
}

}  // namespace wavebalance::solvers

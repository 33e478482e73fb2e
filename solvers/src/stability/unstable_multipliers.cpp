#include "wavebalance/solvers/stability/unstable_multipliers.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

#include "linalg/multipliers.hpp"
#include "linalg/option_checks.hpp"
#include "stability/floquet_determinant.hpp"
#include "stability/friction_monodromy.hpp"
#include "stability/monodromy_map.hpp"
#include "stability/stability_checks.hpp"
#include "stability/winding.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"

namespace wavebalance::solvers {
namespace {

using std::numbers::pi;

// Real operations of one evaluation without derivative: the sums over harmonics and a factorization.
double operations_of(const FloquetDeterminant& determinant) {
  const double nodes = determinant.nodes();
  return nodes * nodes * (8.0 * (2 * determinant.harmonics() + 1) + 8.0 / 3.0 * nodes);
}

// True where the monodromy costs much less: many nodes on few modes, which many contacts that last long have.
bool is_costly(const FloquetDeterminant& determinant, const PeriodicStiffness& stiffness, double frequency,
               bool eigenvalues) {
  constexpr double many_operations = 1e9;
  const double operations = operations_of(determinant) * first_evaluations(determinant);
  return operations > many_operations &&
         operations >
             2.0 * monodromy_operations(determinant.dynamics(), stiffness, frequency, eigenvalues, {});
}

int affordable_evaluations(const FloquetDeterminant& determinant, const StabilityOptions& options) {
  const double affordable = options.max_operations / std::max(1.0, operations_of(determinant));
  return static_cast<int>(std::min<double>(options.max_evaluations, affordable));
}

// Without harmonics where those of the options do not represent perturbations in contact.
Truncation truncation_of(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                         double frequency, const StabilityOptions& options) {
  return resolving_truncation(dynamics, stiffness, 2.0 * pi * frequency, options.harmonics, options.harmonics,
                              options.max_omitted);
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

// Why a law that depends on the velocity, or of several rows, lets no multipliers be known. Those of a
// contact that deflects at once would need the rate of its force.
StabilityStatus status_of_damped(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                                 const StabilityOptions& options) {
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

// Where multipliers on the unit circle leave the count open.
StabilityStatus status_on_circle(const ContactDynamics& dynamics, double frequency) {
  return has_undamped_pole(dynamics, 2.0 * pi * frequency) ? StabilityStatus::undamped
                                                           : StabilityStatus::on_unit_circle;
}

UnstableMultipliers count_of(const Eigen::VectorXcd& multipliers, const ContactDynamics& dynamics,
                             double frequency) {
  UnstableMultipliers result;
  result.count = detail::count_outside(multipliers);
  if (result.count < 0) result.status = status_on_circle(dynamics, frequency);
  result.winding = result.count;
  if (multipliers.size() > 0) result.leading = {multipliers[0].real(), std::abs(multipliers[0].imag())};
  return result;
}

std::optional<UnstableMultipliers> counted_by_monodromy(const ContactDynamics& dynamics,
                                                        const PeriodicStiffness& stiffness, double frequency,
                                                        const StabilityOptions& options) {
  if (options.leading) {
    const auto multipliers = by_monodromy(dynamics, stiffness, frequency, options);
    return multipliers ? std::optional(count_of(*multipliers, dynamics, frequency)) : std::nullopt;
  }
  UnstableMultipliers result;
  if (has_monodromy(dynamics, options.max_states))
    result.count = monodromy_count(dynamics, stiffness, frequency);
  if (result.count < 0) return std::nullopt;
  result.winding = result.count;
  return result;
}

// The multipliers of a motion with friction; nothing and the reason where they are not known.
std::optional<Eigen::VectorXcd> by_friction(const ContactDynamics& dynamics,
                                            const PeriodicStiffness& stiffness, double frequency,
                                            const StabilityOptions& options, StabilityStatus& status) {
  status = stiffness.status;
  if (dynamics.structurally_damped()) status = StabilityStatus::structural_damping;
  if (!has_monodromy(dynamics, options.max_states_with_friction)) status = StabilityStatus::too_many_states;
  if (status != StabilityStatus::converged) return std::nullopt;
  Eigen::VectorXcd multipliers = friction_monodromy(dynamics, stiffness, frequency);
  if (!multipliers.allFinite()) status = StabilityStatus::too_few_harmonics;
  return status == StabilityStatus::converged ? std::optional(std::move(multipliers)) : std::nullopt;
}

// The count for rigid contact, where it has a limit.
UnstableMultipliers rigid_multipliers(const ContactDynamics& dynamics, const PeriodicStiffness& contact,
                                      double frequency, const StabilityOptions& options) {
  UnstableMultipliers result = without_count(contact.status);
  if (dynamics.structurally_damped()) result.status = StabilityStatus::structural_damping;
  if (dynamics.structurally_damped() || dynamics.holding() > 0.0 || contact.intervals.empty() ||
      !has_monodromy(dynamics, options.max_states))
    return result;
  const Eigen::VectorXcd multipliers = rigid_monodromy(dynamics, contact, frequency);
  if (!multipliers.allFinite()) return result;
  return count_of(multipliers, dynamics, frequency);
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

// What is known before anything is computed.
StabilityStatus status_before(const char* who, const ContactDynamics& dynamics,
                              const PeriodicStiffness& stiffness, double frequency,
                              const StabilityOptions& options) {
  options.validate();
  if (stiffness.status != StabilityStatus::converged) return stiffness.status;
  require_stability_arguments(who, dynamics, stiffness, frequency, options.harmonics);
  return require_countable(dynamics, stiffness, 2.0 * pi * frequency);
}

}  // namespace

std::optional<Eigen::VectorXcd> multipliers_of_costly(const ContactDynamics& dynamics,
                                                      const PeriodicStiffness& of_contacts, double frequency,
                                                      const StabilityOptions& options) {
  StabilityStatus status;
  if (!of_contacts.friction.empty()) return by_friction(dynamics, of_contacts, frequency, options, status);
  const PeriodicStiffness stiffness = held_stiffness(of_contacts, dynamics.contacts(), dynamics.holding());
  if (stiffness.needs_map() ||
      status_before("multipliers", dynamics, stiffness, frequency, options) != StabilityStatus::converged)
    return std::nullopt;
  const Truncation truncation = truncation_of(dynamics, stiffness, frequency, options);
  if (truncation.harmonics == 0) return std::nullopt;
  const FloquetDeterminant determinant(dynamics, stiffness, frequency, truncation);
  if (!determinant.resolved() || !is_costly(determinant, stiffness, frequency, true)) return std::nullopt;
  return by_monodromy(dynamics, stiffness, frequency, options);
}

UnstableMultipliers unstable_multipliers(const ContactDynamics& dynamics,
                                         const PeriodicStiffness& of_contacts, double frequency,
                                         const StabilityOptions& options) {
  if (!of_contacts.friction.empty()) return friction_verdict(dynamics, of_contacts, frequency, options).count;
  const PeriodicStiffness stiffness = held_stiffness(of_contacts, dynamics.contacts(), dynamics.holding());
  if (stiffness.needs_map() && dynamics.structurally_damped())
    return without_count(StabilityStatus::structural_damping);
  if (stiffness.needs_map()) {
    const StabilityStatus status = status_of_damped(dynamics, stiffness, options);
    if (status != StabilityStatus::converged) return without_count(status);
    return counted_by_monodromy(dynamics, stiffness, frequency, options)
        .value_or(without_count(StabilityStatus::too_few_harmonics));
  }
  UnstableMultipliers result;
  result.status = status_before("unstable_multipliers", dynamics, stiffness, frequency, options);
  if (result.status != StabilityStatus::converged) return result;
  const Truncation truncation = truncation_of(dynamics, stiffness, frequency, options);
  if (truncation.harmonics == 0)
    return counted_by_monodromy(dynamics, stiffness, frequency, options)
        .value_or(without_count(StabilityStatus::too_few_harmonics));
  FloquetDeterminant determinant(dynamics, stiffness, frequency, truncation);
  if (!determinant.resolved())
    return counted_by_monodromy(dynamics, stiffness, frequency, options)
        .value_or(without_count(StabilityStatus::too_few_harmonics));
  if (is_costly(determinant, stiffness, frequency, options.leading))
    if (const auto counted = counted_by_monodromy(dynamics, stiffness, frequency, options)) return *counted;
  result.harmonics = options.harmonics;
  const int own = unstable_poles(dynamics);
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

UnstableMultipliers unstable_multipliers(const ContactDynamics& dynamics, const CondensedProblem& problem,
                                         const ContactLaws& laws, const PeriodicResponse& response,
                                         const StabilityOptions& options) {
  const PeriodicStiffness stiffness = contact_stiffness(problem, laws, response);
  if (stiffness.status == StabilityStatus::no_finite_stiffness)
    return rigid_multipliers(dynamics, stiffness, response.frequency, options);
  return unstable_multipliers(dynamics, stiffness, response.frequency,
                              with_harmonics_of(problem.pair(), options));
}

UnstableMultipliers unstable_multipliers(const CondensedProblem& problem, const ContactLaws& laws,
                                         const PeriodicResponse& response, const StabilityOptions& options) {
  return unstable_multipliers(ContactDynamics(problem.structure()), problem, laws, response, options);
}

namespace {

StabilitySigns signs_of(const std::optional<Eigen::VectorXcd>& multipliers, StabilityStatus otherwise) {
  StabilitySigns signs;
  signs.status = multipliers ? StabilityStatus::converged : otherwise;
  if (!multipliers) return signs;
  const auto real = multipliers->imag().array() == 0.0;
  signs.fold = (real && multipliers->real().array() > 1.0).count() % 2 == 0 ? 1 : -1;
  signs.flip = (real && multipliers->real().array() < -1.0).count() % 2 == 0 ? 1 : -1;
  return signs;
}

}  // namespace

FrictionVerdict friction_verdict(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                                 double frequency, const StabilityOptions& options) {
  StabilityStatus status = StabilityStatus::converged;
  const auto multipliers = by_friction(dynamics, stiffness, frequency, options, status);
  return {signs_of(multipliers, status),
          multipliers ? count_of(*multipliers, dynamics, frequency) : without_count(status)};
}

StabilitySigns stability_signs(const ContactDynamics& dynamics, const PeriodicStiffness& of_contacts,
                               double frequency, const StabilityOptions& options) {
  if (!of_contacts.friction.empty()) return friction_verdict(dynamics, of_contacts, frequency, options).signs;
  const PeriodicStiffness stiffness = held_stiffness(of_contacts, dynamics.contacts(), dynamics.holding());
  StabilitySigns signs;
  if (stiffness.needs_map() && dynamics.structurally_damped()) {
    signs.status = StabilityStatus::structural_damping;
    return signs;
  }
  signs.status = stiffness.needs_map()
                     ? status_of_damped(dynamics, stiffness, options)
                     : status_before("stability_signs", dynamics, stiffness, frequency, options);
  if (signs.status != StabilityStatus::converged) return signs;
  const Truncation truncation =
      stiffness.needs_map() ? Truncation{} : truncation_of(dynamics, stiffness, frequency, options);
  if (truncation.harmonics == 0)
    return signs_of(by_monodromy(dynamics, stiffness, frequency, options),
                    StabilityStatus::too_few_harmonics);
  FloquetDeterminant determinant(dynamics, stiffness, frequency, truncation);
  if (!determinant.resolved())
    return signs_of(by_monodromy(dynamics, stiffness, frequency, options),
                    StabilityStatus::too_few_harmonics);
  signs.fold = determinant.sign_at_zero();
  signs.flip = determinant.sign_at_half();
  return signs;
}

StabilitySigns stability_signs(const ContactDynamics& dynamics, const CondensedProblem& problem,
                               const ContactLaws& laws, const PeriodicResponse& response,
                               const StabilityOptions& options) {
  return stability_signs(dynamics, contact_stiffness(problem, laws, response), response.frequency,
                         with_harmonics_of(problem.pair(), options));
}

}  // namespace wavebalance::solvers

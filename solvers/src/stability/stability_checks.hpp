#pragma once
#include <optional>

#include "wavebalance/solvers/stability/unstable_multipliers.hpp"

namespace wavebalance::solvers {

/// `options` with the harmonics of the trial functions where it leaves them open.
StabilityOptions with_harmonics_of(const TimePair& pair, StabilityOptions options);

/// Throws std::invalid_argument for a frequency that is not positive and finite, for no harmonics, and for
/// intervals of contacts that the structure does not have.
void require_stability_arguments(const char* who, const ContactDynamics& dynamics,
                                 const PeriodicStiffness& stiffness, double frequency, int harmonics);

/// Whether all modes beyond a modulus (1/s) decay within a period.
bool fast_modes_decay(const ContactDynamics& dynamics, double modulus, double frequency);

/// Whether multipliers show on which side of the circle they lie, though known to what lies between them and
/// `others`.
bool are_decided(const Eigen::VectorXcd& multipliers, const Eigen::VectorXcd& others);

/// All multipliers by the monodromy, by falling modulus, with friction and if the determinant needs much
/// more work; otherwise nothing, because the determinant is more accurate.
std::optional<Eigen::VectorXcd> multipliers_of_costly(const ContactDynamics& dynamics,
                                                      const PeriodicStiffness& stiffness, double frequency,
                                                      const StabilityOptions& options);

/// The signs by all multipliers of a motion.
StabilitySigns signs_of_multipliers(const Eigen::VectorXcd& multipliers);

/// Signs and, where they are known, count of one motion.
struct SignsAndCount {
  StabilitySigns signs;
  UnstableMultipliers count;
};
SignsAndCount signs_and_count(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                              double frequency, const StabilityOptions& options);

}  // namespace wavebalance::solvers

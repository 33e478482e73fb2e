#pragma once
#include <optional>

#include "balance/free_contacts.hpp"
#include "stability/stop_motion.hpp"
#include "wavebalance/solvers/stability/unstable_multipliers.hpp"

namespace wavebalance::solvers {

/// Stability along a curve of a structure between linear stops, where the harmonics of its balance do not
/// represent perturbations: that of the exact motions beside it. A map along the motion of the balance would
/// be that of another motion.
class StopCurve {
 public:
  /// Nothing for other laws and for structures of which not all modes are known, that turn, are held by
  /// springs, or have more than max_states. Keeps a reference to the dynamics.
  static std::optional<StopCurve> of(const CondensedProblem& problem, const ContactLaws& laws,
                                     const ContactDynamics& dynamics, const StabilityOptions& options);

  /// Whether the harmonics of the options do not do, of a damped structure.
  bool is_needed(const PeriodicStiffness& stiffness, double frequency, const StabilityOptions& options) const;

  /// The map of perturbations over a period of the exact motion beside a response; nothing where it is not
  /// found.
  std::optional<Eigen::MatrixXd> map_beside(const CondensedProblem& problem, const PeriodicResponse& response,
                                            const PeriodicStiffness& stiffness);

 private:
  StopCurve(const ContactDynamics& dynamics, detail::LinearStops stops);

  const ContactDynamics& dynamics_;
  detail::StopMotions motions_;
  std::optional<detail::FreeContacts> free_;  // once a motion is sought
};

}  // namespace wavebalance::solvers

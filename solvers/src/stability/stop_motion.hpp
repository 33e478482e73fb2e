#pragma once
#include <map>
#include <optional>
#include <vector>

#include "balance/free_contacts.hpp"
#include "stability/linear_stops.hpp"
#include "wavebalance/solvers/stability/unstable_multipliers.hpp"

namespace wavebalance::solvers {

/// Exact periodic motions of a structure between linear stops, for the stability along a curve where the
/// harmonics of its balance do not represent perturbations. Between two instants at which a stop closes or
/// opens the structure is linear, so that the motion is exact however stiff the stops.
///
/// The instants of the balance's motion determine a periodic state, the motion from this state other
/// instants, and so on: Newton's method, since stops change without a force and a perturbation passes them
/// unchanged. One object per thread.
class StopMotions {
 public:
  /// Nothing for other laws and for structures of which not all modes are known, that turn, are held by
  /// springs, or have more than max_states. Keeps a reference to the dynamics.
  static std::optional<StopMotions> of(const CondensedProblem& problem, const ContactLaws& laws,
                                       const ContactDynamics& dynamics, const StabilityOptions& options);

  /// Whether harmonics do not represent perturbations, harmonics_resolve(), and the structure is damped.
  bool are_needed(const PeriodicStiffness& stiffness, double frequency,
                  const StabilityOptions& options) const;

  /// The multipliers of the exact motion near a response, by falling modulus. Modes beyond the highest
  /// harmonic, or 2, 4, ... times as high, are springs at the contacts, until twice as many do not change
  /// the side of the circle of any multiplier. Nothing where twice in turn no motion is found. O(instants
  /// S^3) for a map, of which a motion needs about two, and O(instants S^2) for each step, S states.
  std::optional<Eigen::VectorXcd> multipliers_beside(const CondensedProblem& problem,
                                                     const PeriodicResponse& response,
                                                     const PeriodicStiffness& stiffness,
                                                     const StabilityOptions& options);

 private:
  struct Reduced {
    ContactDynamics dynamics;                                             // with springs for fast modes
    std::map<std::vector<int>, std::optional<detail::HeldByStops>> held;  // by the stops that are closed
  };

  StopMotions(const ContactDynamics& dynamics, detail::LinearStops stops);
  Reduced& reduced(double modulus);
  std::optional<Eigen::MatrixXd> map_beside(Reduced& reduced, const CondensedProblem& problem,
                                            const PeriodicResponse& response,
                                            const PeriodicStiffness& stiffness);

  const ContactDynamics& dynamics_;
  detail::LinearStops stops_;
  std::map<std::size_t, Reduced> reduced_;    // by the number of slow poles
  std::optional<detail::FreeContacts> free_;  // once a motion is computed
};

}  // namespace wavebalance::solvers

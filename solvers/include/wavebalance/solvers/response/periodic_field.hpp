#pragma once
#include <Eigen/Core>
#include <optional>

#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/time/translate_spectrum.hpp"

namespace wavebalance::solvers {

/// Displacement and velocity of periodic motions at uniform points of the period, for one trial basis.
///
/// Velocities are sum_j a_j q_j'(t) / T [JL14, eq. (34)]. Trial functions without a pointwise derivative
/// (Haar) take the jump between neighbouring cells divided by the cell width, placed at the cell edge and
/// held for half a cell on either side, which spreads the paper's delta functions over one cell. Owns plans:
/// one object per thread.
class MotionEvaluator {
 public:
  /// `points` as in the constructor of TrialEvaluator.
  MotionEvaluator(const AnyTimeBasis& trial, int points);

  int points() const { return points_; }
  /// m, `points` values, for coefficients given as their spectrum over translates (M/2 + 1).
  Eigen::VectorXd displacement(const Eigen::VectorXcd& coefficients);
  /// m/s; frequency in Hz.
  Eigen::VectorXd velocity(const Eigen::VectorXcd& coefficients, double frequency);
  /// The same of several motions, a column each: points x C for (M/2 + 1) x C.
  Eigen::MatrixXd displacement(const Eigen::MatrixXcd& coefficients);
  Eigen::MatrixXd velocity(const Eigen::MatrixXcd& coefficients, double frequency);

 private:
  Eigen::VectorXd jump_velocity(const Eigen::VectorXcd& coefficients, double frequency);

  int functions_;
  int points_;
  TrialEvaluator values_;
  std::optional<TrialEvaluator> rates_;  // empty when the trial functions have no pointwise derivative
  std::optional<TrialEvaluator> cells_;  // then: the values at l/M
};

/// The motion of all n degrees of freedom: n x points each, m and m/s.
struct PeriodicField {
  Eigen::MatrixXd displacement;
  Eigen::MatrixXd velocity;
};

/// The motion under contact force samples (samples() values, N) of a solved problem. Throws SingularSystem.
/// O(n (M + points log points)).
PeriodicField periodic_field(CondensedProblem& problem, const Eigen::VectorXd& contact_force, int points);

/// E = u'^T M u' / 2 + u^T K u / 2 + the potentials of all contacts, J, at each point [JL14, eq. (35)].
/// Throws std::invalid_argument for laws that are neither one nor one per contact. O(n points).
Eigen::VectorXd system_energy(const LinearStructure& structure, const ContactLaws& laws,
                              const PeriodicField& field);

/// The rms of the system energy over the period, J: the paper's energy norm before it is normalised.
double energy_norm(const LinearStructure& structure, const ContactLaws& laws, const PeriodicField& field);

}  // namespace wavebalance::solvers

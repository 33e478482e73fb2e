#pragma once
#include <Eigen/Core>

#include "wavebalance/solvers/balance/condensed_problem.hpp"

namespace wavebalance::solvers {

/// The response of a structure without contact, n x harmonics (m), to a load of the complex amplitudes
/// `amplitudes`, n x harmonics from the static one on (N), of `frequency` Hz. Harmonics without load are left
/// out. A dynamic stiffness that is singular gives numbers that are not finite. O(harmonics n^3).
Eigen::MatrixXcd contact_free_response(const LinearStructure& structure, const Eigen::MatrixXcd& amplitudes,
                                       double frequency);

/// The motion without contact of a structure under the load of a problem, over one period of the load from a
/// maximum of the load's first harmonic on: a load that comes later then gives the same motion later.
/// Immutable.
class ContactFreeMotion {
 public:
  /// `samples` uniform instants of the period are kept. Throws std::invalid_argument where the dynamic
  /// stiffness is singular. O(harmonics (n^3 + samples)).
  ContactFreeMotion(const CondensedProblem& problem, int samples);

  int load_periods() const { return repeats_; }    ///< of the problem
  double frequency() const { return frequency_; }  ///< of the load, Hz
  double start() const { return start_; }          ///< in periods of the load after t = 0

  /// C displacements (m) and velocities (m/s) of the contacts at a time in periods of the load from start()
  /// on. O(C harmonics).
  Eigen::VectorXd displacement(double periods) const { return at(contact_responses_, periods); }
  Eigen::VectorXd velocity(double periods) const { return at(contact_rates_, periods); }
  /// C x harmonics, m: column n belongs to Re(a exp(2 pi i n t)), t likewise.
  const Eigen::MatrixXcd& responses() const { return contact_responses_; }
  /// Those of sample `sample`. O(C).
  Eigen::VectorXd displacement_sample(Eigen::Index sample) const { return displacements_.col(sample); }
  Eigen::VectorXd velocity_sample(Eigen::Index sample) const { return velocities_.col(sample); }

  const Eigen::VectorXd& initial_displacement() const { return initial_displacement_; }  ///< n, m
  const Eigen::VectorXd& initial_velocity() const { return initial_velocity_; }          ///< n, m/s

 private:
  static Eigen::VectorXd at(const Eigen::MatrixXcd& responses, double periods);

  int repeats_ = 1;
  double frequency_ = 0.0, start_ = 0.0;
  Eigen::MatrixXcd contact_responses_, contact_rates_;  // C x harmonics
  Eigen::MatrixXd displacements_, velocities_;          // C x samples
  Eigen::VectorXd initial_displacement_, initial_velocity_;
};

}  // namespace wavebalance::solvers

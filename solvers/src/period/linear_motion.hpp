#pragma once
#include <Eigen/Core>
#include <array>

#include "wavebalance/solvers/balance/condensed_problem.hpp"

namespace wavebalance::solvers {

/// The response of a structure without contact, n x harmonics (m), to a load of the complex amplitudes
/// `amplitudes`, n x harmonics from the static one on (N), of `frequency` Hz. Harmonics without load are left
/// out. A dynamic stiffness that is singular gives numbers that are not finite. O(harmonics n^3).
Eigen::MatrixXcd linear_response(const LinearStructure& structure, const Eigen::MatrixXcd& amplitudes,
                                 double frequency);

/// The linear response of a structure to the load of a problem, over one period of the load from a maximum
/// of the load's first harmonic on: a load that comes later then gives the same motion later. For a free
/// structure, without the part of the static load that accelerates it. Immutable.
class LinearMotion {
 public:
  /// `samples` uniform instants of the period are kept. Throws std::invalid_argument where the dynamic
  /// stiffness is singular. O(harmonics (n^3 + samples)).
  LinearMotion(const CondensedProblem& problem, int samples);

  double frequency() const { return frequency_; }  ///< of the load, Hz
  double start() const { return start_; }          ///< in periods of the load after t = 0

  /// C displacements (m) of the contacts, or with `derivative` = 1 velocities (m/s), at a time in periods of
  /// the load from start() on. O(C harmonics).
  Eigen::VectorXd at(int derivative, double periods) const;
  /// The same at sample `sample`. O(C).
  Eigen::VectorXd sample(int derivative, Eigen::Index sample) const {
    return samples_[std::size_t(derivative)].col(sample);
  }

  const Eigen::VectorXd& left_out() const { return left_out_; }  ///< n, N: that part of the load
  const Eigen::VectorXd& initial_displacement() const { return initial_displacement_; }  ///< n, m
  const Eigen::VectorXd& initial_velocity() const { return initial_velocity_; }          ///< n, m/s

 private:
  int repeats_ = 1;
  double frequency_ = 0.0, start_ = 0.0;
  // By derivative: column n belongs to Re(a exp(2 pi i n t)), t likewise, C x harmonics; and C x samples.
  std::array<Eigen::MatrixXcd, 2> responses_;
  std::array<Eigen::MatrixXd, 2> samples_;
  Eigen::VectorXd left_out_, initial_displacement_, initial_velocity_;
};

}  // namespace wavebalance::solvers

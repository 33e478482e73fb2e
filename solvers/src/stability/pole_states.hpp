#pragma once
#include <vector>

#include "linalg/index.hpp"
#include "wavebalance/solvers/stability/contact_dynamics.hpp"

namespace wavebalance::solvers {

/// The n states of a structure: of each pole its amplitude a, a' = lambda a - left^T f, as one real number or
/// as its real and imaginary part. The contacts are displaced by sum Re(weight residue shape a), weight 2 for
/// a pair. Times are in periods.
class PoleStates {
 public:
  /// `period` in s. `dynamics` must outlive it.
  PoleStates(const ContactDynamics& dynamics, double period);

  Index size() const { return size_; }
  /// Those of which a free flight of `time` leaves more than rounding.
  std::vector<Index> left_after(double time) const;

  /// C x n: displacements of the contacts (m), and their velocities (m/s), a time after the states.
  Eigen::MatrixXd free_motion(double time) const;
  Eigen::MatrixXd free_velocity(double time) const;
  /// The generator Lambda of free motion, a' = Lambda a in 1/s, block diagonal.
  Eigen::MatrixXd generator() const;
  /// Takes the states of all columns on by `time`.
  void advance(double time, Eigen::MatrixXd& states) const;
  /// n x C: the states a time after unit impulses (N s) at the contacts.
  Eigen::MatrixXd after_impulse(double time) const;
  /// What each pole's amplitude is multiplied by in this time.
  Eigen::VectorXcd growth(double time) const;
  /// The states after unit impulses at some contacts, of which each pole's amplitude is that at once times
  /// its factor: n x contacts.
  Eigen::MatrixXd after_impulses(const Eigen::VectorXcd& factors, const std::vector<int>& contacts) const;

 private:
  /// The motion of the contacts by the states, of each pole times a power of its exponent.
  Eigen::MatrixXd motion_of_contacts(double time, int derivative) const;

  const ContactDynamics& dynamics_;
  double period_;
  Index size_ = 0;
  std::vector<Index> begins_;
};

}  // namespace wavebalance::solvers

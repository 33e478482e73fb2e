#pragma once
#include <vector>

#include "linalg/index.hpp"
#include "wavebalance/solvers/stability/contact_dynamics.hpp"

namespace wavebalance::solvers {
namespace detail {

/// The exponents of ContactDynamics::poles(), 1/s.
Eigen::VectorXcd exponents_of(const ContactDynamics& dynamics);
/// C x poles: the displacements of the contacts are Re(shapes a) in states a of the poles.
Eigen::MatrixXcd shapes_of(const ContactDynamics& dynamics);
/// Poles x C: reduction of the states by an impulse of 1 N s at a contact.
Eigen::MatrixXcd inputs_of(const ContactDynamics& dynamics);

/// Complex states of poles as real numbers: the real part of each, and for complex exponents, which
/// represent a pair, also the imaginary part. Factors are one for each pole.
class RealStates {
 public:
  explicit RealStates(const Eigen::VectorXcd& exponents);

  Index size() const { return size_; }
  /// The number of the real part of each pole.
  Index begin(std::size_t pole) const { return begins_[pole]; }
  bool is_pair(std::size_t pole) const { return pairs_[pole]; }

  Eigen::MatrixXd real_of(const Eigen::MatrixXcd& states) const;
  Eigen::MatrixXcd complex_of(const Eigen::MatrixXd& states) const;
  /// The real row by which real states make Re(weights a).
  Eigen::RowVectorXd row_of(const Eigen::RowVectorXcd& weights) const;
  /// The block diagonal matrix that multiplies each pole's state by its factor.
  Eigen::MatrixXd diagonal(const Eigen::VectorXcd& factors) const;
  /// Does so to real states, a column each.
  void multiply(const Eigen::VectorXcd& factors, Eigen::MatrixXd& states) const;

 private:
  std::vector<Index> begins_;
  std::vector<bool> pairs_;
  Index size_ = 0;
};

}  // namespace detail

/// The n states of a structure: of each pole its amplitude a, a' = lambda a - left^T f, as one real number or
/// as its real and imaginary part. The contacts are displaced by sum Re(weight residue shape a), weight 2 for
/// a pair. Times are in periods.
class PoleStates : private detail::RealStates {
 public:
  /// `period` in s.
  PoleStates(const ContactDynamics& dynamics, double period);

  using RealStates::size;
  /// States of which a free flight of `time` leaves more than rounding.
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
  /// Factor of each pole's amplitude in this time.
  Eigen::VectorXcd growth(double time) const;
  /// The states after unit impulses at some contacts, of which each pole's amplitude is that at once times
  /// its factor: n x contacts.
  Eigen::MatrixXd after_impulses(const Eigen::VectorXcd& factors, const std::vector<int>& contacts) const;

 private:
  /// The motion of the contacts by the states, of each pole times a factor.
  Eigen::MatrixXd motion_of_contacts(const Eigen::VectorXcd& factors) const;

  double period_;
  Eigen::VectorXcd exponents_;        // 1/s
  Eigen::MatrixXcd shapes_, inputs_;  // C x poles and poles x C
};

}  // namespace wavebalance::solvers

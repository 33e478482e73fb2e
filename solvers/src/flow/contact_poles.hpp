#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "flow/harmonic_series.hpp"
#include "stability/pole_states.hpp"

namespace wavebalance::solvers::detail {

/// Derivatives of the displacements up to the third, then the force and its first two derivatives.
inline constexpr int levels = 4, kinds = 7, force_kind = 4;

/// Signals of R rows at N points, one R x N matrix per kind, and M memories with their rates, M x N.
struct Signals : std::array<Eigen::MatrixXd, kinds> {
  Eigen::MatrixXd memory, memory_rate;
};

/// The structure between its contacts by P poles, each pair once: y' = r y - b f, and the d-th derivative
/// of the displacements Re(c r^d y) - sum_k feed(d, k) f^(k) relative to the linear response. The feeds are
/// the moments H_i = Re(c r^i b) and the flexibility of contacts without mass. Times in s.
class ContactPoles : public RealStates {
 public:
  /// Keeps no reference. linear_motion is C x (H + 1), m: the n-th column belongs to Re(a exp(2 pi i n t)), t
  /// in periods. Throws std::invalid_argument for structural damping.
  ContactPoles(const ContactDynamics& dynamics, const Eigen::MatrixXcd& linear_motion, double frequency);

  Index rows() const { return inputs_.cols(); }
  Index poles() const { return exponents_.size(); }
  Index states() const { return size(); }  ///< real: one of a real pole, two of a pair
  double period() const { return period_; }
  double holding() const {
    return holding_;
  }  ///< N/m, of the springs that ContactDynamics puts to the contacts
  const Eigen::VectorXcd& exponents() const { return exponents_; }  ///< 1/s
  const Eigen::MatrixXcd& inputs() const { return inputs_; }        ///< b, P x R
  /// c r^d, R x P.
  const Eigen::MatrixXcd& outputs(int level) const { return outputs_[static_cast<std::size_t>(level)]; }
  /// The same of real states, R x states().
  const Eigen::MatrixXd& real_outputs(int level) const {
    return real_outputs_[static_cast<std::size_t>(level)];
  }
  /// R x R, by the k-th derivative of the forces, k <= level.
  const Eigen::MatrixXd& feed(int level, int k) const;
  /// R x R, 1/kg: velocities by impulses.
  const Eigen::MatrixXd& inverse_mass() const { return moments_[1]; }
  /// rad/s, of the fastest pole that rings and has more than a share of 1e-7 in the flexibility.
  double fastest() const { return fastest_; }
  /// The motion without contact at times, derivatives 0 to 3: R x N each.
  std::array<Eigen::MatrixXd, levels> linear_motion(const Eigen::VectorXd& times) const;
  double displacement_scale() const {
    return free_scale_;
  }  ///< m, the largest rms of the motion without contact

 private:
  double period_, holding_, fastest_ = 0.0, free_scale_ = 0.0;
  Eigen::VectorXcd exponents_;
  void keep_harmonics(const Eigen::MatrixXcd& linear_motion);

  std::vector<HarmonicSeries> free_;                // of each row, of many harmonics
  std::vector<Index> harmonics_;                    // of the motion without contact, else
  std::array<Eigen::MatrixXd, levels> amplitudes_;  // of these
  Eigen::MatrixXcd inputs_;
  std::array<Eigen::MatrixXcd, levels> outputs_;
  std::array<Eigen::MatrixXd, levels> real_outputs_;
  std::array<Eigen::MatrixXd, levels> moments_;
  Eigen::MatrixXd constant_;
};

}  // namespace wavebalance::solvers::detail

#pragma once
#include <Eigen/Core>
#include <complex>
#include <vector>

#include "wavebalance/solvers/stability/contact_dynamics.hpp"
#include "wavebalance/solvers/stability/contact_stiffness.hpp"

namespace wavebalance::solvers {

/// Delta(sigma) = det(I + G_sigma(t_i - t_j) w_j D(t_j)) of unstable_multipliers(), and its derivative. Where
/// Im sigma > 0 the harmonic n = -H - 1 is added with the weight 2 Im sigma / omega, so that Delta is real at
/// Im sigma = omega / 2 as it is at 0; where Im sigma < 0 it is the complex conjugate. Compliances at once,
/// ContactDynamics::constant(), are taken into D, D / (1 + G D), and leave a positive factor out.
class FloquetDeterminant {
 public:
  /// Keeps a reference to `dynamics`. frequency in Hz.
  FloquetDeterminant(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness, double frequency,
                     int harmonics);

  int nodes() const { return static_cast<int>(time_.size()); }
  int harmonics() const { return harmonics_; }         ///< H
  double angular_frequency() const { return omega_; }  ///< omega, rad/s
  const ContactDynamics& dynamics() const { return dynamics_; }
  int evaluations() const { return evaluations_; }

  struct Value {
    std::complex<double> log;         ///< log Delta, with any multiple of 2 pi i
    std::complex<double> derivative;  ///< d log Delta / d sigma, s
  };
  Value operator()(std::complex<double> sigma);
  /// Value::log alone, at a third of the cost.
  std::complex<double> log(std::complex<double> sigma);

  /// The signs of Delta at 0 and at i omega / 2, by real arithmetic.
  int sign_at_zero();
  int sign_at_half();

  /// The displacements at the contacts (C x (2H + 1), harmonics n = -H..H) of the vector on which the matrix
  /// is smallest, with their contact forces, scaled to the largest displacement 1. Zero displacements where
  /// the matrix is not singular at sigma.
  struct Mode {
    Eigen::MatrixXcd displacement, force;
  };
  Mode mode(std::complex<double> sigma) const;

 private:
  struct Range {  // of the nodes of one contact
    int contact;
    Eigen::Index begin, count;
  };

  void place_nodes(const PeriodicStiffness& stiffness);
  ContactDynamics::Values compliance(std::complex<double> sigma) const;
  Eigen::MatrixXcd phases() const;
  std::vector<Eigen::MatrixXcd> kernels(const std::vector<const Eigen::MatrixXcd*>& compliances) const;
  Eigen::MatrixXd weighted_waves(const Range& row, const Eigen::VectorXcd& g) const;
  int real_sign(double shift, int first);
  Eigen::Index pair(const Range& row, const Range& column) const {
    return row.contact + column.contact * dynamics_.contacts();
  }

  const ContactDynamics& dynamics_;
  double omega_;
  int harmonics_;
  int evaluations_ = 0;
  std::vector<Range> ranges_;
  Eigen::VectorXd time_, weighted_;  // nodes, in periods; w_j D(t_j)
  Eigen::MatrixXd waves_;            // nodes x 2 (H + 2), cos(2 pi n t), then sin, n = 0..H + 1
};

/// The least number of harmonics, `harmonics` or more by steps of a half, beyond which contact hardly
/// matters: |G(i n omega)| D <= max_omitted for H < n <= 2 H, or a quarter of that where H is raised. 0 where
/// `most` are not enough.
int resolving_harmonics(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                        double angular_frequency, int harmonics, int most, double max_omitted);

/// The first reason why `dynamics` and `stiffness` do not let the argument of the determinant be followed.
StabilityStatus require_countable(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                                  double angular_frequency);
/// The same without the condition that the structure be damped.
StabilityStatus require_stiffness(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness);

}  // namespace wavebalance::solvers

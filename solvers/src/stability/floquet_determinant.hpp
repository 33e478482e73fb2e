#pragma once
#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "wavebalance/solvers/stability/contact_dynamics.hpp"
#include "wavebalance/solvers/stability/contact_stiffness.hpp"

namespace wavebalance::solvers {

/// The middle of the longest time (in periods) over which the fewest contacts are closed.
double quiet_instant(const std::vector<ContactInterval>& intervals);

/// How many harmonics represent perturbations, and with which compliances at once.
struct Truncation {
  int harmonics = 0;        ///< H; 0 for none
  Eigen::VectorXd at_once;  ///< C, m/N; empty for zero
  double omitted = 0.0;     ///< StabilityOptions::max_omitted without these
};

/// Delta(sigma) = det(I + G_sigma(t_i - t_j) w_j D(t_j)) of unstable_multipliers(), and its derivative.
/// Where Im sigma > 0 the harmonic n = -H - 1 is added with the weight 2 Im sigma / omega, so that Delta is
/// real at Im sigma = omega / 2 as it is at 0; where Im sigma < 0 it is the complex conjugate. Static
/// compliances g, ContactDynamics::constant() and the truncated part, are merged into the stiffness as D /
/// (1 + g D). This drops a positive factor, which has no zeros.
class FloquetDeterminant {
 public:
  /// Keeps a reference to `dynamics`. frequency in Hz.
  FloquetDeterminant(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness, double frequency,
                     const Truncation& truncation);

  /// Whether the rules of the pieces represent the stiffness; without that there are no nodes.
  bool resolved() const { return resolved_; }
  int nodes() const { return static_cast<int>(time_.size()); }
  /// Real operations of one evaluation without derivative: the sums over harmonics and a factorization.
  double operations() const {
    const double n = nodes();
    return n * n * (8.0 * (2 * harmonics() + 1) + 8.0 / 3.0 * n);
  }
  int harmonics() const { return harmonics_; }         ///< H
  double angular_frequency() const { return omega_; }  ///< omega, rad/s
  /// Exponents up to which (1/s) resonate within these harmonics.
  double highest_frequency() const { return omega_ * (harmonics_ + 1.5); }
  const ContactDynamics& dynamics() const { return dynamics_; }
  int evaluations() const { return evaluations_; }

  struct Value {
    std::complex<double> log;         ///< log Delta, with any multiple of 2 pi i
    std::complex<double> derivative;  ///< d log Delta / d sigma, s
  };
  Value operator()(std::complex<double> sigma);
  /// The logarithm at i nu, 0 <= nu <= omega / 2, where the weight of the harmonic -H - 1 rises smoothly at
  /// both ends, so that Delta is a smooth function on the whole unit circle.
  std::complex<double> smooth_log(double nu);

  /// The matrix of Delta at i nu, nu = 0 or omega / 2, times exp(i nu t) from the left and its inverse from
  /// the right, by which it is real there.
  Eigen::MatrixXd real_matrix(double nu) const;

  /// A node of the rules.
  struct Node {
    int contact;
    double time;    ///< in periods, origin() or later by less than one
    double weight;  ///< w_j D(t_j)
  };
  Node node(Eigen::Index i) const { return {contact_[std::size_t(i)], time_[i], weighted_[i]}; }
  /// A time (in periods) at which few contacts are closed.
  double origin() const { return origin_; }

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

  void place_nodes(const PeriodicStiffness& stiffness, const std::vector<ContactInterval>& pieces);
  ContactDynamics::Values compliance(std::complex<double> sigma, bool with_slope) const;
  ContactDynamics::Values weighted_compliance(std::complex<double> sigma, double weight,
                                              bool with_slope) const;
  Eigen::MatrixXcd decaying(Eigen::MatrixXcd compliance) const;
  std::vector<Eigen::MatrixXcd> kernels(const std::vector<const Eigen::MatrixXcd*>& compliances) const;
  void set_weighted_waves(const Eigen::MatrixXd& waves, const Range& row,
                          const Eigen::Ref<const Eigen::VectorXcd>& g,
                          Eigen::Ref<Eigen::MatrixXd> columns) const;
  Eigen::Index pair(const Range& row, const Range& column) const {
    return row.contact + column.contact * dynamics_.contacts();
  }

  const ContactDynamics& dynamics_;
  double omega_;
  int harmonics_;
  Eigen::VectorXd at_once_;  // C, m/N, taken out of the compliances
  int evaluations_ = 0;
  double origin_ = 0.0;
  bool resolved_ = true;
  std::vector<Range> ranges_;
  std::vector<int> contact_;         // of each node
  Eigen::VectorXd time_, weighted_;  // nodes, in periods; w_j D(t_j)
  Eigen::MatrixXd waves_;            // nodes x 2 (H + 2), cos(2 pi n t), then sin, n = 0..H + 1
};

/// The determinant with the least number of harmonics, `harmonics` or more by steps of a half up to `most`,
/// beyond which contact hardly matters, see StabilityOptions::max_omitted. Nothing where none of those tried
/// are enough or the rules of the pieces do not represent the stiffness.
std::optional<FloquetDeterminant> resolving_determinant(const ContactDynamics& dynamics,
                                                        const PeriodicStiffness& stiffness, double frequency,
                                                        int harmonics, int most, double max_omitted);

/// Whether such a determinant supports these harmonics and compliances that are small compared with them.
bool harmonics_resolve(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness, double frequency,
                       int harmonics, double max_omitted);

/// Whether an exponent of the structure lies on the imaginary axis to rounding.
bool has_undamped_pole(const ContactDynamics& dynamics, double angular_frequency);
/// The first reason why `dynamics` and `stiffness` do not let the argument of the determinant be followed.
StabilityStatus require_countable(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness,
                                  double angular_frequency);
/// The same without the condition that the structure be damped.
StabilityStatus require_stiffness(const ContactDynamics& dynamics, const PeriodicStiffness& stiffness);

}  // namespace wavebalance::solvers

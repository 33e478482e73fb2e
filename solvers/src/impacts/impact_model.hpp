#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "flow/contact_poles.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"

namespace wavebalance::solvers::detail {

/// Displacement (m), velocity (m/s) and acceleration (m/s^2) of each of C contacts.
struct ContactsAt {
  Eigen::VectorXd displacement, velocity, acceleration;
};

/// A periodic Green function between two contacts, by an impulse of 1 N s in each period, and its derivatives
/// by time (1/s) and by the period at a fixed share of it; `magnitude` is the sum of the moduli of its terms.
struct GreenValues {
  double value = 0.0, rate = 0.0, second = 0.0;
  double value_by_period = 0.0, rate_by_period = 0.0;
  double magnitude = 0.0, rate_magnitude = 0.0;
};

/// The sizes of the motion without contact, m and m/s, the displacement with finite gaps.
struct FreeScales {
  double displacement = 0.0, velocity = 0.0;
};
FreeScales free_scales(const ExactProblem& problem);

/// Constants of a search for impacts of one period: the poles of the contacts, y' = lambda y between
/// impacts and y -> y - p left at one, with the displacements Re(shapes y) relative to the linear response.
/// Immutable.
class ImpactModel {
 public:
  /// Keeps only a reference to the dynamics. Data that depend only on these are copied from a model with
  /// the same dynamics.
  explicit ImpactModel(const ExactProblem& problem, const ImpactModel* like = nullptr);

  const ExactProblem& problem() const { return problem_; }
  const Eigen::VectorXd& gaps() const { return gaps_; }                ///< C, m
  const Eigen::VectorXd& restitution() const { return restitution_; }  ///< C
  double period() const { return period_; }                            ///< s
  int contacts() const { return static_cast<int>(poles_->rows()); }
  Eigen::Index poles() const { return poles_->poles(); }
  const Eigen::VectorXcd& exponents() const { return poles_->exponents(); }  ///< 1/s, one for each pair
  const Eigen::MatrixXcd& inputs() const { return poles_->inputs(); }        ///< poles x C
  /// C x poles: of a derivative 0 to 3 of the displacements of the contacts by the states.
  const Eigen::MatrixXcd& outputs(int derivative) const { return poles_->outputs(derivative); }
  /// C x poles: moduli of the third ones.
  const Eigen::MatrixXd& third_moduli() const { return *third_moduli_; }
  /// C, m/s^3: a bound on the third derivative of the motion without contact.
  const Eigen::VectorXd& free_third() const { return free_third_; }
  const Eigen::MatrixXd& inverse_mass() const { return poles_->inverse_mass(); }  ///< C x C, 1/kg
  double displacement_scale() const { return scales_.displacement; }              ///< m, of motion and gaps
  double velocity_scale() const { return scales_.velocity; }                      ///< m/s

  /// The motion without contact at a time in periods, and the sums of moduli of its harmonics for contact c.
  ContactsAt free_motion(double time) const;
  double free_magnitude(int c, int derivative) const;
  /// Whether the linear structure has a free motion of this period.
  bool is_resonant() const;

  /// Response of contact c to contact d at a fraction of the period after the impulse, 0 < share <= 1; at 1
  /// the limit from below. O(poles).
  GreenValues green(int c, int d, double share) const;
  /// The state of all poles a share of the period (0..1) after an impulse of 1 N s at contact c in each
  /// period, at 0 right after it; with the sign of a force against the contact.
  Eigen::VectorXcd state_after(int c, double share) const;
  /// exp(lambda t) for a time in s.
  Eigen::VectorXcd growth(double seconds) const;
  /// The whole motion of the contacts in a state at a time in periods.
  ContactsAt motion(const Eigen::VectorXcd& state, double time) const;

 private:
  std::complex<double> periodic(Eigen::Index pole, double share) const;

  ExactProblem problem_;
  Eigen::VectorXd gaps_, restitution_;
  double period_;
  std::vector<HarmonicSeries> free_;  // of each contact
  FreeScales scales_;
  std::shared_ptr<const ContactPoles> poles_;  // without the motion without contact
  std::shared_ptr<const Eigen::MatrixXd> third_moduli_;
  Eigen::VectorXcd difference_;  // 1 - exp(lambda T), or exp(-lambda T) - 1 for growing ones
  Eigen::VectorXcd last_;        // periodic() at the end of the period
  Eigen::VectorXd free_third_;
};

/// Throws std::invalid_argument as impact_motion() does for a problem.
void require_impacts(const ExactProblem& problem);

}  // namespace wavebalance::solvers::detail

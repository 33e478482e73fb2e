#pragma once
#include <Eigen/Core>
#include <memory>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/impacts/impacts_problem.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/phases/contact_phases.hpp"

namespace wavebalance::solvers {

enum class ImpactStatus {
  converged,
  iteration_limit,   ///< Newton's method on instants and impulses did not converge
  singular,          ///< its matrix is, as where impacts graze
  wrong_order,       ///< the equations have a solution in which impacts have passed each other
  pulling,           ///< their solution has an impulse that would pull
  penetrating,       ///< their solution passes an obstacle between impacts
  grazing,           ///< it cannot be told whether the solution passes an obstacle
  resonant,          ///< the structure without contact has a motion of this period of its own
  chattering,        ///< infinitely many impacts in a finite time, then contact that lasts
  lasting_contact,   ///< contact lasts from an impact without rebound on, as load or motion press it
  not_settled,       ///< no periodic motion was found within the options' limits
  too_many_impacts,  ///< more than max_impacts in a period of the load
  cancelled          ///< the observer returned false
};

std::string_view to_string(ImpactStatus status);

/// An impact to start from.
struct ImpactGuess {
  int contact = 0;
  double time = 0.0;     ///< periods of the motion
  double impulse = 0.0;  ///< N s
};

struct ImpactMotionOptions {
  int max_iterations = 40;  ///< of Newton's method
  Observer observer = {};   ///< called before each of its steps

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

namespace detail {
class ImpactModel;
}  // namespace detail

/// A periodic motion with impacts, to rounding.
///
/// Immutable; copies share it.
class ImpactMotion {
 public:
  ImpactStatus status = ImpactStatus::not_settled;
  std::vector<Impact> impacts;  ///< by time; the solution of the equations also where it is no motion
  int iterations = 0;
  /// Largest error of the equations over the scales of displacement and velocity.
  double residual = missing;
  /// Where the status is `penetrating`: the largest penetration between impacts (m), its contact and its time
  /// in periods.
  double penetration = missing, penetration_time = missing;
  int penetrating_contact = -1;
  /// Where the status is `chattering` or `lasting_contact`: the contact, and when its impacts end, in periods
  /// of the load after t = 0 of the integration.
  double chattering_end = missing;
  int chattering_contact = -1;

  bool converged() const { return status == ImpactStatus::converged; }
  bool has_solution() const { return model != nullptr; }
  /// Hz, 1 / its period. Throws std::invalid_argument without a solution.
  double frequency() const;
  /// C x K displacements (m) and velocities (m/s) of the contacts at K times in periods; at an impact the
  /// velocity after it. Throw std::invalid_argument without a solution. O(K (log impacts + C poles)).
  Eigen::MatrixXd displacement(const Eigen::VectorXd& times) const;
  Eigen::MatrixXd velocity(const Eigen::VectorXd& times) const;
  /// J per period, of all impacts.
  double energy_lost() const;
  /// Complex amplitudes of the contact forces, N, C x count: column n belongs to Re(a exp(2 pi i n t)). They
  /// do not decay. O(count impacts).
  Eigen::MatrixXcd force_harmonics(int count) const;

  std::shared_ptr<const detail::ImpactModel> model;
  Eigen::MatrixXcd states;  ///< poles x impacts: right after each impact
};

/// The periodic motion near the impacts of a start, in any order. With the periodic Green function G of the
/// contacts, made of their poles,
///
///   u(t) = u0(t) - sum_i p_i G(t - t_i),  u_i(t_i) = gap_i,  p_i J_ii = (1 + e) v_i(t_i-),
///
/// 2 K equations for instants and impulses of K impacts, by Newton's method with exact derivatives [S. W.
/// Shaw, P. J. Holmes, J. Sound Vib. 90, 1983, doi:10.1016/0022-460X(83)90407-8, for one degree of freedom].
/// Without impacts it is the motion without contact. `converged` means: the equations hold to rounding,
/// impulses push, and between impacts no contact passes its gap, which a bound on the third derivative of
/// the motion proves to 1e-12 of its size.
///
/// Throws std::invalid_argument as ImpactsProblem::validate(), and for a contact that does not exist or a
/// number that is not finite. O(K^2 poles + K^3) for each step.
ImpactMotion impact_motion(const ImpactsProblem& problem, const std::vector<ImpactGuess>& start,
                           const ImpactMotionOptions& options = {});

}  // namespace wavebalance::solvers

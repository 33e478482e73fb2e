#pragma once
#include <Eigen/Core>
#include <memory>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/stability/contact_dynamics.hpp"
#include "wavebalance/solvers/stability/contact_stiffness.hpp"

namespace wavebalance::solvers {

/// An interval of time in which a contact stays on one analytic piece of its law and exerts a force: contact,
/// for an obstacle. Times are in periods.
struct ForceInterval {
  int contact = 0;
  int piece = 0;       ///< number of the piece: that many breakpoints of the law lie below it
  double begin = 0.0;  ///< 0 <= begin < 1
  double end = 0.0;    ///< begin < end <= begin + 1

  double length() const { return end - begin; }
  bool always() const { return end - begin >= 1.0; }
};

/// An impact of a periodic motion.
struct Impact {
  int contact = 0;
  double time = 0.0;             ///< periods of the motion, 0..1
  double velocity_before = 0.0;  ///< m/s, towards the obstacle
  double velocity_after = 0.0;   ///< m/s
  double impulse = 0.0;          ///< N s
  double energy_lost = 0.0;      ///< J, impulse (velocity_before + velocity_after) / 2
};

/// A state in which a period begins, `begin` periods after time 0: of the poles and memories, as
/// ContactFlow::state() has it, and of the contacts.
struct PeriodStart {
  double begin = 0.0;
  Eigen::VectorXd state;
  std::vector<int> contacts;
};

enum class ExactStatus {
  converged,
  not_found,  ///< the search ended without a motion near the start, which is no proof that there is none
  tolerance_missed,    ///< the error is estimated above the tolerance at the largest number of unknowns
  too_many_intervals,  ///< the first steps of Newton's method would need more than max_operations
  /// a law has no finite stiffness at a contact with mass, or at a structure that is free to move
  rigid_contact,
  velocity_and_no_mass,  ///< a force of the velocity at a contact without mass
  resonant,              ///< the linear structure has a free motion of this period
  structural_damping,    ///< it has no equation in time
  slip_in_a_plane,       ///< rigid friction along two tangents
  law_over_period,       ///< a law that acts over a period and has no states
  undetermined,          ///< a body is free to be elsewhere: of a curve, whose points would be any of them
  wrong_order,           ///< the equations have a solution in which impacts have passed each other
  pulling,               ///< their solution has an impulse that would pull
  penetrating,           ///< their solution passes an obstacle between impacts
  grazing,               ///< it cannot be decided whether the solution passes an obstacle
  chattering,            ///< infinitely many impacts in a finite time, then contact that lasts
  lasting_contact,       ///< contact lasts from an impact without rebound on, as load or motion press it
  grows,                 ///< the motion leaves every bound
  not_settled,           ///< no periodic motion was found within the options' limits
  too_many_impacts,      ///< more than 2000 in a period of the load
  cancelled              ///< the observer returned false; the motion is that found before, if there is one
};

std::string_view to_string(ExactStatus status);

/// The vibrating system: the compliance of C contacts, their laws, and the motion without contact force.
struct ExactProblem {
  const ContactDynamics& dynamics;  ///< must outlive what refers to it
  ContactLaws laws;
  /// C x (H + 1), m: column n belongs to Re(a exp(2 pi i n t)), t in periods. For a free structure it is
  /// the motion with the springs ContactDynamics::holding().
  Eigen::MatrixXcd linear_motion;
  double frequency = 0.0;  ///< 1 / period, Hz
  /// Keeps `dynamics` of a rotor, which depend on the frequency; null for others.
  std::shared_ptr<const ContactDynamics> kept = {};
};

struct CollocationOptions {
  /// Relative rms error of the displacements of the contacts that the estimate may have.
  double tolerance = 1e-9;
  int nodes = 12;  ///< of a panel, at first
  int max_nodes = 32;
  int max_panels = 400;
  /// Up to so many panels, intervals are cut where other contacts change theirs, since their forces have
  /// kinks in high derivatives there. With many active contacts these cuts cause most of the unknowns.
  int max_cut_panels = 100;
  int max_iterations = 20;  ///< of Newton's method, each time
  int max_changes = 12;     ///< of the intervals
  /// Floating-point operations of all Newton steps. N unknowns need about 2/3 N^3 in one step and 64 N^2
  /// bytes of memory. Nothing is computed if the first three steps would need more.
  double max_operations = 5e11;
  Observer observer = {};  ///< called before each step of Newton's method

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// A periodic motion of a structure with contact, to rounding: contact forces that are polynomials on panels
/// of the contact intervals, whose ends are unknowns.
///
/// Immutable; copies share it.
class ExactSolution {
 public:
  ExactStatus status = ExactStatus::not_found;
  std::vector<ForceInterval> intervals;  ///< by contact, then by begin
  /// Contacts with friction by the parts of the period in which they are open, stick and slip.
  std::vector<FrictionAlong> friction;
  std::vector<FrictionCycle> cycles;  ///< of these
  std::vector<Impact> impacts;        ///< by time
  int unknowns = 0, iterations = 0, changes = 0;
  double operations = 0.0;  ///< that count for CollocationOptions::max_operations
  double residual = 0.0;  ///< of the equations, relative to the largest force and displacement
  /// Relative rms error of the displacements, by the last Legendre coefficients and the residual.
  double estimated_error = 0.0;
  double start_error = 0.0;  ///< relative rms distance of the start's displacements from the motion

  bool converged() const { return status == ExactStatus::converged; }
  /// Hz, 1 / its period.
  double frequency() const;
  /// J per period, of all impacts.
  double energy_lost() const;
  /// C x K displacements (m) and velocities (m/s) of the contacts at K times in periods. O(K panels poles).
  Eigen::MatrixXd displacement(const Eigen::VectorXd& times) const;
  Eigen::MatrixXd velocity(const Eigen::VectorXd& times) const;
  /// C x K contact forces, N. O(K C log panels).
  Eigen::MatrixXd force(const Eigen::VectorXd& times) const;

  /// The exact Fourier coefficients of the contact forces, N, C x count: column n belongs to Re(a exp(2 pi
  /// i n t)), t in periods. For a free structure they exclude the forces of the holding springs
  /// ContactDynamics::holding() at all contacts. Throws std::invalid_argument without a motion and for a
  /// count below 1. O(panels nodes count).
  Eigen::MatrixXcd force_harmonics(int count) const;

  /// The Floquet multipliers of the motion, by falling modulus; those below rounding are left out.
  /// Perturbations satisfy the linearized equations, on panels cut to what they need. Rigid contact has them,
  /// too. Empty where they are not found, need too many panels, or with more than max_states. O(s^3 +
  /// n s p + n w^2) for n unknowns, at most w of them between two instants over which only states last, p
  /// poles and s states of the structure that the longest flight without contact leaves.
  Eigen::VectorXcd multipliers(int max_states = 400) const;

  /// How many of them lie outside the unit circle, for any number of states: by the argument of det(I + V (mu
  /// - D)^-1 U) along the circle, of the map D - U V of the s states over a period, whose n unknowns U and V
  /// have few columns and rows. -1 if that needs more than `max_evaluations`, as with multipliers on the
  /// circle. O(s n^2 + n^3) each.
  int count_unstable(int max_evaluations = 2000) const;

  struct Parts;  ///< what the equations hold
  std::shared_ptr<const Parts> parts;
};

/// The motion near a start: displacements of the contacts, C x N, m, at the times l / N, of a balance or of
/// an integration, and with rigid laws the forces of the contacts, C x N, N. Solves
///
///   u(t) = u_0(t) - integral of G(t - s) f(s) ds - R_0 f(t),   f(t) = f_c(u(t), v(t)) within intervals, 0
///   elsewhere,
///
/// G the periodic Green function of the contacts, by collocation of f at Gauss nodes of the panels and u =
/// kink at the ends of the intervals, whose instants are unknowns. In rigid contact u = gap replaces the law;
/// with R_0 > 0 of a massless contact it is an equation for f. Panels are cut where another contact changes
/// its state, and divided where their error is above the tolerance. Contact intervals are removed or
/// inserted until they agree with the motion.
///
/// Throws std::invalid_argument for sizes that do not fit and for laws over a period, whose intervals
/// flow_motion() seeks. A Newton step costs O(n^3 + n^2 poles) for n unknowns.
ExactSolution collocation_motion(const ExactProblem& problem, const Eigen::MatrixXd& start,
                                 const CollocationOptions& options = {},
                                 const Eigen::MatrixXd& start_force = {});

}  // namespace wavebalance::solvers

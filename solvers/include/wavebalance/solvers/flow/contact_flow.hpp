#pragma once
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/collocation/collocation_motion.hpp"
#include "wavebalance/solvers/flow/law_machine.hpp"

namespace wavebalance::solvers {

/// How a motion in time ended.
enum class FlowStatus {
  converged,  ///< it reached its end
  /// no forces of the laws were found on a panel, the shortest does not resolve them, rounding leaves them
  /// no digits, or a period needs more than max_panels
  step_failure,
  endless_events,  ///< more and more events in a vanishing time
  grows            ///< displacements of a period end beyond 1e9 times length(), or step by step beyond 1e6
};

std::string_view to_string(FlowStatus status);

struct FlowOptions {
  int panels = 16;          ///< of a period, at least, where forces are resolved
  double tolerance = 1e-9;  ///< of forces on a panel, relative to the largest
  int max_panels = 100000;  ///< of a period
  /// Below this share of the fastest impact of a contact one has no rebound, so that contact with restitution
  /// comes to rest after finitely many.
  static constexpr double rest_velocity = 1e-6;
  bool margins = false;  ///< whether off_center() is known
  /// Whether contacts stay in the states in which they begin, whatever ends these.
  bool keeps_states = false;
  /// m, of the motion of the contacts if neither loads nor gaps determine it; 0: see length().
  double length = 0.0;

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// A change of the state of a contact.
struct FlowEvent {
  double time = 0.0;  ///< s, from the beginning of the period
  int contact = 0;    ///< number of the machine
  int from = 0, to = 0;
  double impulse = 0.0;       ///< N s
  double speed = 0.0;         ///< m/s, before an impact
  double after = 0.0;         ///< m/s, behind it
  int row = 0;                ///< of the impulse
  double displacement = 0.0;  ///< m, of this row at an impact
};

/// The contacts at a time, R rows.
struct FlowSample {
  double time = 0.0;                              ///< s
  Eigen::VectorXd displacement, velocity, force;  ///< m, m/s, N
  std::vector<int> states;                        ///< of the machines
};

/// A part of a period in which no contact changes its state.
struct FlowPanel {
  double begin = 0.0, end = 0.0;  ///< s, from the beginning of the period
  /// R x 12, N, at the Gauss nodes of the panel, less the forces of the springs ContactDynamics::holding().
  Eigen::MatrixXd force;
  std::vector<int> states;  ///< of the machines
};

/// Motions in time of a linear structure whose contacts are machines of states: between events, at which a
/// state ends, forces are polynomials on panels, so that the motion is exact to the tolerance; impulses act
/// at events. Laws of all kinds may act together. A perturbation can be taken along: over panels by the
/// slopes of the laws, through events by saltation [R. I. Leine, H. Nijmeijer, Dynamics and Bifurcations of
/// Non-Smooth Mechanical Systems, 2004].
///
/// O(poles q^2) for each panel and, where forces are unknown, O((rows q)^3) with q = 12.
class ContactFlow {
 public:
  /// Keeps no reference to the problem. Throws std::invalid_argument as machines_of() does and for
  /// structural damping.
  explicit ContactFlow(const ExactProblem& problem, const FlowOptions& options = {});
  ~ContactFlow();
  ContactFlow(ContactFlow&&) noexcept;
  ContactFlow& operator=(ContactFlow&&) noexcept;

  /// Begins at time 0 with contacts at rest where they touch nothing, as far as masses let them.
  void start();
  /// Begins at time 0 with states of the poles and contacts that touch nothing.
  void start(const Eigen::VectorXcd& poles);
  /// Begins at time 0 in a state, as of state(), with contacts in discrete states.
  void start(const Eigen::VectorXd& state, const std::vector<int>& contacts);
  /// Begins at time 0 where another flow of the same structure and laws is at the same time, under another
  /// load or frequency: its contacts keep displacement, velocity, state and memory, and the structure
  /// elsewhere changes least.
  void start(const ContactFlow& before);
  /// Begins at time 0 as a periodic motion near this one: under forces of the contacts with harmonics, R x
  /// (H + 1), N, column n of which belongs to Re(a exp(2 pi i n t)), t in periods, and with displacements
  /// and forces of the laws at time 0. For a free structure the harmonics exclude the forces of the springs
  /// ContactDynamics::holding().
  void start_near(const Eigen::MatrixXcd& harmonics, const Eigen::VectorXd& displacement,
                  const Eigen::VectorXd& force);

  /// For a problem without periodic load: the period lasts so many s from here on; panels and thresholds do
  /// not change. Throws std::invalid_argument for one that is not positive.
  void set_period(double seconds);

  /// Goes on by one period; then time is 0 again. Calls `sample` at `points` uniform times of the period, the
  /// first of them that share of their distance after its beginning.
  FlowStatus advance_period(int points = 0, const std::function<void(const FlowSample&)>& sample = {},
                            double first = 0.0);

  /// Goes on to a time of the period, s.
  FlowStatus advance_to(double time);

  /// The states of all poles, then all memories; those without a meaning are zero.
  Eigen::VectorXd state() const;
  /// Its rate, 1/s, at the end of the last panel, before an event there.
  Eigen::VectorXd rate() const;
  const std::vector<int>& contact_states() const;
  const std::vector<ContactMachine>& machines() const;
  /// Events of the last period.
  const std::vector<FlowEvent>& events() const;
  /// The last period, panel by panel.
  const std::vector<FlowPanel>& panels() const;
  /// The largest displacement of a contact that a number of state() makes, m.
  Eigen::VectorXd displacements_by_state() const;
  /// The same of the pole that a number belongs to, whatever the phase in which it turns.
  Eigen::VectorXd amplitudes_by_state() const;
  /// Transitions of each contact in the last period.
  const std::vector<FrictionCycle>& cycles() const;
  /// Impacts without rebound since they were below rest_velocity, in the last period.
  int rests() const;
  /// m, by memories: how far a slider that stuck in all of the last period lies in front of the middle of the
  /// positions in which it would have; 0 of others.
  Eigen::VectorXd off_center() const;
  /// Rows by state() that stayed constant and zero in the last period, a position and a velocity of each
  /// contact that rigid friction held all along by its mass.
  Eigen::MatrixXd held() const;
  double period() const;     ///< s
  double tolerance() const;  ///< FlowOptions::tolerance
  /// The largest last coefficient of the forces on a panel of the last period beyond their rounding,
  /// relative to the largest force.
  double unresolved() const;
  /// m, that the motion of the contacts has: of the motion without contact about its mean, or a gap.
  double length() const;
  /// Whether its static deflection without contact is more than 1e4 times as large.
  bool rests_on_contacts() const;

  /// Takes perturbations of state() along from here on: columns.
  void perturb(const Eigen::MatrixXd& columns);
  Eigen::MatrixXd perturbation() const;

 private:
  class Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace wavebalance::solvers

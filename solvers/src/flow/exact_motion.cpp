#include "wavebalance/solvers/flow/exact_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "flow/closed_period.hpp"
#include "flow/flow_intervals.hpp"
#include "flow/flow_start.hpp"
#include "flow/law_machines.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers {
namespace {

using namespace detail;

ExactStatus refusal_of(const ExactProblem& problem, bool free_period = false) {
  const ContactDynamics& dynamics = problem.dynamics;
  for (int row = 0; row < dynamics.contacts(); row += problem.laws[row].rows()) {
    const AnyContactLaw& law = problem.laws[row];
    const auto constants = law.friction();
    if (constants && constants->tangents > 1 && std::isinf(constants->tangential_stiffness))
      return ExactStatus::slip_in_a_plane;
    if (!constants && !law.coupled() && law.acts_over_period()) return ExactStatus::law_over_period;
    if (!constants && law.is_rigid() && !law.restitution() && inverse_mass_of(dynamics, row) > 0.0)
      return ExactStatus::rigid_contact;
  }
  if (dynamics.structurally_damped()) return ExactStatus::structural_damping;
  if (free_period) return ExactStatus::converged;
  constexpr double least = 1e-9;
  for (const ContactPole& pole : dynamics.poles())
    if (!(std::abs(1.0 - std::exp(pole.exponent / problem.frequency)) > least)) return ExactStatus::resonant;
  return ExactStatus::converged;
}

void require_sizes(const ExactProblem& problem, const Eigen::MatrixXd& start,
                   const Eigen::MatrixXd& start_force) {
  const int rows = problem.dynamics.contacts();
  problem.laws.require(rows);
  if (problem.linear_motion.rows() != rows || problem.linear_motion.cols() < 1)
    throw std::invalid_argument("flow_motion: linear_motion has " +
                                std::to_string(problem.linear_motion.rows()) + " rows; the structure has " +
                                std::to_string(rows) + " contact directions");
  if (start.rows() != rows || start.cols() < 8 || !start.allFinite())
    throw std::invalid_argument("flow_motion: start is " + std::to_string(start.rows()) + " x " +
                                std::to_string(start.cols()) + "; it must have a finite row for each of " +
                                std::to_string(rows) + " contact directions and at least 8 columns");
  if (start_force.size() > 0 && (start_force.rows() != start.rows() || start_force.cols() != start.cols()))
    throw std::invalid_argument("flow_motion: start_force is " + std::to_string(start_force.rows()) + " x " +
                                std::to_string(start_force.cols()) +
                                "; it must be as large as start, or empty");
  if (!(problem.frequency > 0.0) || !std::isfinite(problem.frequency))
    throw std::invalid_argument("flow_motion: frequency is " + std::to_string(problem.frequency) +
                                " Hz; it must be positive and finite");
}

// The least error of any solution, relative to the rms of the displacements: a large static deflection
// without contact is rounded before contacts cancel it.
double rounding_of(const ExactProblem& problem, const Eigen::MatrixXd& displacement) {
  const double size = displacement.norm() / std::sqrt(double(displacement.cols()));
  return std::numeric_limits<double>::epsilon() * problem.linear_motion.rowwise().norm().maxCoeff() / size;
}

// Where a flow begins, in periods, in a motion without load whose time 0 is the first instant at which a
// contact begins to stick, or else its first event.
double begin_by_event(const ContactFlow& flow) {
  const std::vector<FlowEvent>& events = flow.events();
  const auto sticks = [&](const FlowEvent& event) {
    return flow.machines()[std::size_t(event.contact)].law->kind(event.to) == ContactState::stick;
  };
  const auto stick = std::find_if(events.begin(), events.end(), sticks);
  if (events.empty()) return 0.0;
  const double time = (stick == events.end() ? events.front() : *stick).time / flow.period();
  return std::fmod(1.0 - time, 1.0);
}

class MotionSearch {
 public:
  MotionSearch(const ExactProblem& problem, PeriodStart start, Index points,
               const CollocationOptions& options, bool free_period = false)
      : original_(problem),
        free_period_(free_period),
        from_(std::move(start)),
        problem_(begun_at(problem, from_.begin)),
        options_(options),
        times_(Eigen::VectorXd::LinSpaced(points, 0.0, 1.0 - 1.0 / double(points))) {
    if (free_period)  // no load defines the size of displacements
      length_ = ContactFlow(problem_).displacements_by_state().cwiseProduct(from_.state).norm();
  }

  ExactSolution run() {
    for (const double tolerance : {1e-6, 1e-8, 1e-10, 1e-12}) {
      const bool refined = refine(tolerance);
      // Rounding may leave no digits to the last one, of tables with many points above all.
      if (!refined && found_.found && !exhausted_ && !cancelled_) refine(10.0 * tolerance);
      if (!refined || error_ <= options_.tolerance) break;
    }
    const bool found = std::isfinite(error_);  // by two solutions at least
    if (found)
      set_multipliers(motion_, multipliers_of(*flow_, found_, free_period_));
    else
      motion_ = {};
    motion_.unknowns = int(found_.state.size());
    motion_.residual = found_.distance;
    motion_.iterations = iterations_;
    motion_.operations = options_.max_operations - operations_left_;
    motion_.estimated_error = error_;
    motion_.status = cancelled_                     ? ExactStatus::cancelled
                     : !found && exhausted_         ? ExactStatus::too_many_intervals
                     : !found                       ? ExactStatus::not_found
                     : error_ <= options_.tolerance ? ExactStatus::converged
                                                    : ExactStatus::tolerance_missed;
    return std::move(motion_);
  }

 private:
  // Whether operations and observer allow what follows a period.
  bool goes_on_after(const ContactFlow& flow, const Progress& progress) {
    operations_left_ -= period_operations(flow, problem_.dynamics.contacts());
    exhausted_ = operations_left_ < 0.0;
    cancelled_ = !goes_on(options_.observer, progress);
    return !exhausted_ && !cancelled_;
  }

  // In a period; the first one carries the perturbations of all states along.
  int affordable_panels(int most) const {
    const Index states = from_.state.size(), perturbations = found_.map.size() > 0 ? 0 : states;
    const double of_panel = panel_operations(states, problem_.dynamics.contacts(), perturbations);
    return int(std::min(operations_left_ / of_panel, double(most)));
  }

  // The motion with a tolerance of the flow, and how far it lies from the one before.
  bool refine(double tolerance) {
    constexpr double least = 1e-13;
    const FlowOptions usual;
    const int most_panels = affordable_panels(usual.max_panels);
    exhausted_ = most_panels < usual.panels;
    if (exhausted_) return false;
    ContactFlow flow(problem_, {.tolerance = tolerance, .max_panels = most_panels, .length = length_});
    if (found_.found && free_period_) flow.set_period(found_.period);
    if (found_.found)
      flow.start(found_.state, found_.contacts);
    else
      flow.start(from_.state, from_.contacts);
    const Observer observer = [&](const Progress& progress) { return goes_on_after(flow, progress); };
    ClosedPeriod closed = close_period(flow, options_.max_iterations, observer, found_.map, free_period_);
    iterations_ += closed.iterations;
    exhausted_ = exhausted_ || int(flow.panels().size()) >= most_panels;
    if (!closed.found) return false;
    const double begin = free_period_ ? begin_by_event(flow) : from_.begin;
    motion_ = motion_of({original_.dynamics, original_.laws, original_.linear_motion, 1.0 / closed.period},
                        flow, {begin, closed.state, closed.contacts});
    const Eigen::MatrixXd now = motion_.displacement(times_);
    const double rounded = rounding_of(problem_, now);
    // The solution before is farther off. Both may have the same panels, so that their distance does not
    // include the truncation of the forces, of which displacements have less than a tenth.
    const double left_out = 0.1 * flow.unresolved();
    if (found_.found)
      error_ = std::max({(now - displacement_).norm() / now.norm(), left_out, rounded, least});
    displacement_ = now;
    found_ = std::move(closed);
    flow_ = std::move(flow);
    return true;
  }

  const ExactProblem& original_;
  bool free_period_;
  double length_ = 0.0;  // m, or 0
  PeriodStart from_;
  ExactProblem problem_;  // from the time at which the flow begins
  const CollocationOptions& options_;
  Eigen::VectorXd times_;
  // Result.
  std::optional<ContactFlow> flow_;
  ClosedPeriod found_;
  ExactSolution motion_;
  Eigen::MatrixXd displacement_;
  double error_ = std::numeric_limits<double>::infinity(), operations_left_ = options_.max_operations;
  int iterations_ = 0;
  bool cancelled_ = false, exhausted_ = false;
};

}  // namespace

ExactSolution flow_motion(const ExactProblem& problem, const Eigen::MatrixXd& start,
                          const CollocationOptions& options, const Eigen::MatrixXd& start_force) {
  options.validate();
  require_sizes(problem, start, start_force);
  ExactSolution refused;
  refused.status = refusal_of(problem);
  if (!refused.converged()) return refused;
  const Eigen::MatrixXd force = start_force.size() > 0 ? start_force : problem.laws.force(start);
  ExactSolution motion =
      MotionSearch(problem, start_near(problem, start, force, 0.5), start.cols(), options).run();
  if (motion.parts == nullptr) return motion;
  const Eigen::MatrixXd found =
      motion.displacement(Eigen::VectorXd::LinSpaced(start.cols(), 0.0, 1.0 - 1.0 / double(start.cols())));
  motion.start_error = (start - found).norm() / found.norm();
  return motion;
}

ExactSolution flow_motion_from(const ExactProblem& problem, const PeriodStart& start,
                               const CollocationOptions& options) {
  constexpr Index points = 1024;  // at which two solutions are compared
  options.validate();
  ExactSolution refused;
  refused.status = refusal_of(problem);
  return refused.converged() ? MotionSearch(problem, start, points, options).run() : refused;
}

ExactSolution autonomous_motion_from(const ExactProblem& problem, const PeriodStart& start,
                                     const CollocationOptions& options) {
  constexpr Index points = 1024;
  options.validate();
  ExactSolution refused;
  refused.status = refusal_of(problem, true);
  return refused.converged() ? MotionSearch(problem, start, points, options, true).run() : refused;
}

ExactSolution exact_motion(const ExactProblem& problem, const Eigen::MatrixXd& start,
                           const CollocationOptions& options, const Eigen::MatrixXd& start_force) {
  using enum ExactStatus;
  if (problem.laws.act_over_period()) return flow_motion(problem, start, options, start_force);
  ExactSolution motion = collocation_motion(problem, start, options, start_force);
  const bool failed =
      motion.status == not_found || motion.status == too_many_intervals || motion.status == tolerance_missed;
  if (!failed) return motion;
  if (motion.status == tolerance_missed) {
    const Eigen::VectorXd times =
        Eigen::VectorXd::LinSpaced(start.cols(), 0.0, 1.0 - 1.0 / double(start.cols()));
    if (rounding_of(problem, motion.displacement(times)) > options.tolerance) return motion;
  }
  ExactSolution other = flow_motion(problem, start, options, start_force);
  motion.operations = other.operations += motion.operations;
  if (other.status == cancelled) motion.status = cancelled;  // nothing is known of what was not tried
  const bool better =
      other.parts != nullptr && (motion.parts == nullptr || other.estimated_error < motion.estimated_error);
  return better ? other : motion;
}

}  // namespace wavebalance::solvers

#include "wavebalance/solvers/collocation/collocation_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "collocation/collocation_newton.hpp"
#include "collocation/collocation_refinement.hpp"
#include "collocation/exact_solution_parts.hpp"
#include "collocation/interval_agreement.hpp"
#include "linalg/enum_table.hpp"
#include "linalg/index.hpp"
#include "linalg/option_checks.hpp"

namespace wavebalance::solvers {

namespace {

using detail::ContactMotion, detail::Layout, detail::LegendreNodes, detail::PanelForces,
    detail::CollocationIterate, detail::CollocationModel, detail::CollocationResult;
using Found = detail::CollocationSolution;

// At least so many instants at which the motion found is compared with its intervals.
constexpr Index least_samples = 256;

ExactStatus refusal(const ExactProblem& problem) {
  const ContactDynamics& dynamics = problem.dynamics;
  if (dynamics.structurally_damped()) return ExactStatus::structural_damping;
  if (!problem.laws.have_finite_force() && dynamics.holding() > 0.0) return ExactStatus::rigid_contact;
  if (problem.laws.depend_on_velocity() && !dynamics.constant().isZero(0.0))
    return ExactStatus::velocity_and_no_mass;
  constexpr double least = 1e-9;
  for (const ContactPole& pole : dynamics.poles())
    if (!(std::abs(1.0 - std::exp(pole.exponent / problem.frequency)) > least)) return ExactStatus::resonant;
  return ExactStatus::converged;
}

void require_sizes(const ExactProblem& problem, const Eigen::MatrixXd& start) {
  const int contacts = problem.dynamics.contacts();
  problem.laws.require(contacts);
  if (problem.laws.act_over_period())
    throw std::invalid_argument("collocation_motion: a law acts over a period; take flow_motion()");
  if (problem.linear_motion.rows() != contacts || problem.linear_motion.cols() < 1)
    throw std::invalid_argument("collocation_motion: linear_motion has " +
                                std::to_string(problem.linear_motion.rows()) + " rows; the structure has " +
                                std::to_string(contacts) + " contacts");
  if (start.rows() != contacts || start.cols() < 8)
    throw std::invalid_argument("collocation_motion: start is " + std::to_string(start.rows()) + " x " +
                                std::to_string(start.cols()) + "; it must have a row for each of " +
                                std::to_string(contacts) + " contacts and at least 8 columns");
  if (!(problem.frequency > 0.0) || !std::isfinite(problem.frequency))
    throw std::invalid_argument("collocation_motion: frequency is " + std::to_string(problem.frequency) +
                                " Hz; it must be positive and finite");
}

void require_start_force(const ContactLaws& laws, const Eigen::MatrixXd& start,
                         const Eigen::MatrixXd& start_force) {
  const bool rigid = !laws.have_finite_force();
  if (start_force.size() == 0 && !rigid) return;
  if (start_force.rows() == start.rows() && start_force.cols() == start.cols()) return;
  throw std::invalid_argument("collocation_motion: start_force is " + std::to_string(start_force.rows()) +
                              " x " + std::to_string(start_force.cols()) + "; it must be as large as start" +
                              (rigid ? ", since a law is rigid" : ", or empty"));
}

bool is_among(const std::vector<Layout>& layouts, const Layout& layout) {
  return std::any_of(layouts.begin(), layouts.end(), [&](const Layout& other) {
    int contacts = 0;
    for (const auto* one : {&layout, &other})
      for (const detail::Passage& passage : one->passages) contacts = std::max(contacts, passage.contact + 1);
    for (int c = 0; c < contacts; ++c)
      if (!detail::same_intervals(layout, other, c)) return false;
    return true;
  });
}

class Search {
 public:
  Search(const CollocationModel& model, const CollocationOptions& options, Index samples)
      : model_(model),
        options_(options),
        operations_left_(options.max_operations),
        times_(Eigen::VectorXd::LinSpaced(samples, 0.0, 1.0 - 1.0 / double(samples))),
        free_(model.free_motion(times_)),
        observer_([this](const Progress& progress) {
          cancelled_ = cancelled_ || !goes_on(options_.observer, progress);
          return !cancelled_;
        }) {}

  ExactSolution run(const Eigen::MatrixXd& start, const Eigen::MatrixXd& start_force) {
    const Index more_nodes = std::min(options_.max_nodes, 2 * options_.nodes);
    ExactSolution result;
    const ContactMotion first = detail::reach(model_, {start, detail::periodic_slopes(start)}, start_force);
    Found found = at(first, result);
    for (std::vector<Layout> tried; !found.agrees() && !stopped() && result.changes < options_.max_changes;
         ++result.changes) {
      const bool lost = found.is_lost();
      const bool fewer = lost && leave_out_shortest();
      if (!fewer && (lost || is_among(tried, found.intervals_of_motion))) {
        if (nodes_.count() >= more_nodes) break;
        nodes_ = LegendreNodes(more_nodes);
        tried.clear();
      }
      if (!fewer) least_ = 0.0;
      if (!lost) tried.push_back(found.intervals_of_motion);
      found = at(lost ? first : found.reach, result);
    }
    if (found.agrees()) refine(found, result);
    if (found.agrees()) {
      const Eigen::MatrixXd own =
          found.motion.displacement(Eigen::all, Eigen::seqN(0, start.cols(), times_.size() / start.cols()));
      result.start_error = (start - own).norm() / own.norm();
    }
    return describe(found, std::move(result));
  }

 private:
  using NewtonMethod = CollocationResult (*)(const CollocationModel&, CollocationIterate,
                                             const LegendreNodes&, const detail::NewtonLimits&,
                                             detail::KnownPeriod);

  bool stopped() const { return cancelled_ || exhausted_; }

  // As many steps as the operations allow; none where they do not allow three.
  CollocationResult newton(NewtonMethod method, CollocationIterate iterate, double tolerance,
                           ExactSolution& result, detail::KnownPeriod known = {}) {
    constexpr double least_steps = 3.0;
    const double poles = double(model_.response.poles()),
                 n = double(nodes_.count()) * double(iterate.layout.grid().panels.size()) +
                     double(iterate.layout.passages.size()),
                 of_step = detail::step_operations(n, poles), steps = operations_left_ / of_step;
    if (steps < least_steps) {
      exhausted_ = true;
      CollocationResult none;
      none.residual = std::numeric_limits<double>::infinity();
      none.iterate = std::move(iterate);
      return none;
    }
    const int most = static_cast<int>(std::min<double>(options_.max_iterations, steps));
    CollocationResult solved =
        method(model_, std::move(iterate), nodes_, {most, tolerance, observer_}, std::move(known));
    result.iterations += solved.iterations;
    operations_left_ -= of_step * (solved.iterations + 1);
    return solved;
  }

  Found solved(CollocationIterate iterate, double tolerance, ExactSolution& result,
               detail::KnownPeriod known = {}) {
    CollocationResult found =
        newton(&detail::solve_intervals, std::move(iterate), tolerance, result, std::move(known));
    return {model_, std::move(found), nodes_, times_, free_};
  }

  // Samples of a balance may open and close a contact within less than they resolve, above all one that is
  // rigid, and equations with such an interval have no solution. If the motion has it, it is inserted later.
  bool leave_out_shortest() {
    constexpr double longest = 0.01, above = 1.0 + 1e-9;
    if (!(shortest_ < longest) || shortest_ < least_) return false;  // or between different pieces
    least_ = above * shortest_;
    return true;
  }

  // With many active contacts one initial panel per contact interval needs far fewer unknowns than one for
  // each part between their passages.
  Layout layout_of(const ContactMotion& motion) {
    Layout layout =
        detail::layout_of(model_.laws, model_.frequency, motion.displacement, motion.velocity, least_);
    shortest_ = layout.shortest_interval();
    layout.cut_by_others = static_cast<int>(layout.grid().panels.size()) <= options_.max_cut_panels;
    return layout;
  }

  // Stiff contact does not fit the panels at first: with the passages held they are refined until they
  // roughly resolve its force.
  Found at(const ContactMotion& motion, ExactSolution& result) {
    constexpr double rough = 0.03, start_of_newton = 1e-4;
    constexpr Index many_nodes = 12;
    Layout layout = layout_of(motion);
    PanelForces forces = detail::forces_along(model_, layout, nodes_, motion);
    CollocationIterate iterate{std::move(layout), std::move(forces)};
    detail::KnownPeriod known;
    for (int level = 0; level < 6; ++level) {
      CollocationResult held = newton(&detail::solve_forces, iterate, rough, result);
      known = std::move(held.known);
      if (!held.converged) break;
      iterate = std::move(held.iterate);
      const Eigen::MatrixXd& coefficients = iterate.forces.coefficients();
      if (coefficients.size() == 0 ||
          coefficients.bottomRows(2).cwiseAbs().maxCoeff() < rough * coefficients.cwiseAbs().maxCoeff())
        break;
      known = {};
      if (nodes_.count() < many_nodes)
        nodes_ = LegendreNodes(many_nodes);
      else
        detail::divide(iterate, rough);
    }
    return solved(std::move(iterate), start_of_newton, result, std::move(known));
  }

  // Layers of fast modes and laws that are not analytic where contact begins have errors that their
  // coefficients do not show; near a fold estimates are too large. The error of the previous estimate,
  // measured by the next motion, corrects it. Kinks within panels are hidden, too.
  void refine(Found& found, ExactSolution& result) {
    constexpr double part = 0.05, rounding = 1e-14, safety = 3.0, least = 0.1, of_kinks = 10.0;
    bool tight = false, compared = false, by_panels = false;
    for (double factor = 1.0;; tight = true) {
      detail::EstimatedError error =
          detail::error_of(found.newton, detail::rms_of(found.motion.displacement));
      const double estimate = error.all();
      error.resolution *= found.newton.iterate.layout.cut_by_others ? factor : of_kinks * factor;
      result.estimated_error = error.all();
      CollocationIterate finer = found.newton.iterate;
      const LegendreNodes nodes = nodes_;
      const bool free = finer.forces.panels().empty();
      const bool resolved = free || (compared && error.resolution <= options_.tolerance);
      if (!resolved && !compared) detail::join_panels(finer, error, nodes_, options_);
      const bool finest = resolved || !make_finer(finer, error, by_panels);
      if (finest && (tight || error.residual <= part * options_.tolerance)) return;
      Found better = solved(std::move(finer), std::max(rounding, part * options_.tolerance), result);
      if (!better.agrees()) {
        nodes_ = nodes;  // of the remaining motion
        if (finest || by_panels) return;
        by_panels = true;  // long panels of many nodes may lose their digits
        continue;
      }
      if (!finest) {
        const double distance = detail::rms_of(better.motion.displacement - found.motion.displacement) /
                                detail::rms_of(better.motion.displacement);
        factor = std::max(least, safety * distance / std::max(estimate, rounding));
        compared = true;
      }
      found = std::move(better);
    }
  }

  bool make_finer(CollocationIterate& iterate, const detail::EstimatedError& error, bool by_panels) {
    return by_panels ? detail::divide_panels(iterate, error, options_)
                     : detail::make_finer(iterate, nodes_, error, options_);
  }

  ExactSolution describe(const Found& found, ExactSolution result) const {
    const CollocationIterate& iterate = found.newton.iterate;
    result.operations = options_.max_operations - operations_left_;
    result.residual = found.newton.residual;
    result.unknowns = static_cast<int>(iterate.forces.coefficients().size()) +
                      static_cast<int>(iterate.layout.passages.size());
    if (exhausted_) result.status = ExactStatus::too_many_intervals;
    if (cancelled_) result.status = ExactStatus::cancelled;
    if (!found.agrees()) return result;
    if (result.estimated_error <= options_.tolerance)
      result.status = ExactStatus::converged;
    else if (!cancelled_)
      result.status = ExactStatus::tolerance_missed;
    detail::set_parts(result, model_, found.newton, nodes_);
    return result;
  }

  const CollocationModel& model_;
  const CollocationOptions& options_;
  double operations_left_;
  Eigen::VectorXd times_;  // l / N
  ContactMotion free_;     // without contact, there
  LegendreNodes nodes_{options_.nodes};
  Observer observer_;  // the observer of the options, which is not called after it has returned false
  bool cancelled_ = false, exhausted_ = false;
  double least_ = 0.0, shortest_ = 1.0;  // intervals between passages of the next start, and of the last one
};

}  // namespace

void CollocationOptions::validate() const {
  detail::require_positive("collocation_motion", "tolerance", tolerance);
  detail::require_at_least("collocation_motion", "nodes", nodes, 4);
  detail::require_at_least("collocation_motion", "max_nodes", max_nodes, nodes);
  detail::require_at_least("collocation_motion", "max_panels", max_panels, 1);
  detail::require_at_least("collocation_motion", "max_cut_panels", max_cut_panels, 0);
  detail::require_at_least("collocation_motion", "max_iterations", max_iterations, 1);
  detail::require_at_least("collocation_motion", "max_changes", max_changes, 0);
  detail::require_positive("collocation_motion", "max_operations", max_operations);
}

std::string_view to_string(ExactStatus status) {
  using enum ExactStatus;
  return detail::name_in<ExactStatus>({{converged, "converged"},
                                       {not_found, "not_found"},
                                       {tolerance_missed, "tolerance_missed"},
                                       {rigid_contact, "rigid_contact"},
                                       {velocity_and_no_mass, "velocity_and_no_mass"},
                                       {too_many_intervals, "too_many_phases"},
                                       {resonant, "resonant"},
                                       {structural_damping, "structural_damping"},
                                       {slip_in_a_plane, "slip_in_a_plane"},
                                       {law_over_period, "law_over_period"},
                                       {undetermined, "undetermined"},
                                       {wrong_order, "wrong_order"},
                                       {pulling, "pulling"},
                                       {penetrating, "penetrating"},
                                       {grazing, "grazing"},
                                       {chattering, "chattering"},
                                       {lasting_contact, "lasting_contact"},
                                       {grows, "grows"},
                                       {not_settled, "not_settled"},
                                       {too_many_impacts, "too_many_impacts"},
                                       {cancelled, "cancelled"}},
                                      status);
}

ExactSolution collocation_motion(const ExactProblem& problem, const Eigen::MatrixXd& start,
                                 const CollocationOptions& options, const Eigen::MatrixXd& start_force) {
  options.validate();
  require_sizes(problem, start);
  ExactSolution result;
  result.status = refusal(problem);
  if (!result.converged()) return result;
  const CollocationModel model(problem, start.cwiseAbs().maxCoeff());
  const bool with_mass = std::any_of(
      model.laws.begin(), model.laws.end(),
      [](const detail::LawSegments& law) { return law.jumps() && !(law.yielding().velocity > 0.0); });
  if (with_mass) {
    result.status = ExactStatus::rigid_contact;
    return result;
  }
  require_start_force(problem.laws, start, start_force);
  const Index finer = (least_samples + start.cols() - 1) / start.cols();
  return Search(model, options, finer * start.cols()).run(start, start_force);
}

}  // namespace wavebalance::solvers

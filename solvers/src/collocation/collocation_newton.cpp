#include "collocation/collocation_newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "collocation/collocation_evaluation.hpp"
#include "linalg/dense.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

// Newton's matrix of the first `count` unknowns.
Lu<double> factor_of(const CollocationIterate& at, const Evaluation& now, const LegendreNodes& nodes,
                     const Influence& influence, Index count) {
  return Lu<double>(
      jacobian(now, impulses_of(at.layout, now, nodes), nodes, influence).topLeftCorner(count, count));
}

double rms_at_nodes(const Eigen::VectorXd& displacements, Index nodes) {
  return nodes > 0 ? displacements.head(nodes).norm() / std::sqrt(double(nodes)) : 0.0;
}

// Effect of the Newton correction on displacements at nodes and passages, towards the other side of their
// obstacles.
Eigen::VectorXd displacements_of(const CollocationIterate& at, const Evaluation& now,
                                 const LegendreNodes& nodes, const Influence& influence,
                                 const Eigen::VectorXd& unknowns) {
  return influence.displacement * impulses_of(at.layout, now, nodes).cwiseProduct(unknowns);
}

// The displacements that the last two Legendre coefficients of each panel make: a column for each.
Eigen::MatrixXd displacements_of_last(const PanelForces& forces, const Influence& influence,
                                      const LegendreNodes& nodes) {
  const Eigen::MatrixXd& coefficients = forces.coefficients();
  const Index q = coefficients.rows();
  const Eigen::MatrixXd parts = nodes.values.middleCols(q - 2, 2) * coefficients.bottomRows(2);
  Eigen::MatrixXd result(influence.displacement.rows(), parts.cols());
  for (Index p = 0; p < parts.cols(); ++p)
    result.col(p) = influence.displacement.middleCols(q * p, q) * parts.col(p);
  return result;
}

}  // namespace

double admissible_part(const Layout& layout, const Eigen::VectorXd& shifts) {
  constexpr double longest = 0.02;
  double part = 1.0;
  if (shifts.size() > 0) part = std::min(part, longest / std::max(longest, shifts.cwiseAbs().maxCoeff()));
  for (const LayoutInterval& interval : layout.intervals) {
    if (interval.begin < 0) continue;
    const double length = layout.end(interval) - layout.begin(interval);
    const double lost = shifts[interval.begin] -
                        (interval.begin == interval.end ? shifts[interval.begin] : shifts[interval.end]);
    if (lost > 0.0) part = std::min(part, 0.5 * length / lost);
  }
  return part;
}

void move(CollocationIterate& at, const Evaluation& now, const LegendreNodes& nodes,
          const Eigen::VectorXd& change) {
  const Index n = now.force.size();
  at.forces = PanelForces(now.grid, nodes, now.force + change.head(n));
  for (Index i = 0; i < now.passing.size(); ++i)
    at.layout.passages[static_cast<std::size_t>(i)].time += change[n + i];
}

bool has_collapsed(const Layout& layout) {
  constexpr double shortest = 1e-11;
  return std::any_of(layout.intervals.begin(), layout.intervals.end(), [&](const LayoutInterval& interval) {
    const double length = layout.end(interval) - layout.begin(interval);
    return !(length > shortest && length < 1.0 + shortest);
  });
}

void set_errors(CollocationResult& result, const Evaluation& now, const LegendreNodes& nodes,
                const Influence& influence, double frequency,
                const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& answer) {
  result.tangent = now.tangent;
  result.damping = now.damping / frequency;
  if (now.residual.size() == 0) return;
  const CollocationIterate& at = result.iterate;
  const Index n = now.force.size();
  const Eigen::MatrixXd of_panels = displacements_of_last(at.forces, influence, nodes);
  result.panel_errors = of_panels.topRows(n).colwise().norm().transpose() / std::sqrt(double(n));
  const Eigen::VectorXd last = of_panels.rowwise().sum();
  const Eigen::MatrixXd none;
  const Eigen::VectorXd answered = answer(residual_by_motion(now, last, none));
  result.residual_error = rms_at_nodes(displacements_of(at, now, nodes, influence, answer(now.residual)), n);
  result.resolution_error = rms_at_nodes(last + displacements_of(at, now, nodes, influence, answered), n);
}

// A residual needs only the motion by the forces, far less work than their influence. The influence is
// computed for a step unless the previous matrix is still good. The influence before a step gives the
// errors of its result.
CollocationResult solve_intervals(const CollocationModel& model, CollocationIterate start,
                                  const LegendreNodes& nodes, const NewtonLimits& limits, KnownPeriod known) {
  CollocationResult result;
  result.iterate = std::move(start);
  constexpr double good = 1e-3;  // what a step leaves of the residual
  double before = std::numeric_limits<double>::infinity();
  bool again = false;  // whether the last step was taken by the matrix of the one before
  std::optional<Lu<double>> factor;
  Influence influence;
  const auto set_factor = [&](const Evaluation& now) {
    influence = known.influence ? *std::exchange(known.influence, std::nullopt)
                                : model.response.influence(*now.period, model.velocity);
    factor = factor_of(result.iterate, now, nodes, influence, now.residual.size());
  };
  for (;; ++result.iterations) {
    const Evaluation now = evaluate(model, result.iterate, nodes, std::exchange(known.period, nullptr));
    result.residual = now.error();
    result.iterate.forces = PanelForces(now.grid, nodes, now.force);
    result.known.period = now.period;
    const bool fits = factor && factor->size() == now.residual.size();  // panels may have come or gone
    const bool is_rounding = fits && !again && now.is_rounding(before, influence);
    if (result.residual < limits.tolerance || is_rounding) {
      result.converged = true;
      if (now.residual.size() > 0 && !fits) set_factor(now);
      set_errors(result, now, nodes, influence, model.frequency,
                 [&](const Eigen::VectorXd& residual) { return factor->solve(Eigen::VectorXd(-residual)); });
      return result;
    }
    again = fits && result.residual < good * before;
    before = result.residual;
    if (result.iterations == limits.max_iterations || !std::isfinite(result.residual)) return result;
    if (!goes_on(limits.observer, {"exact solution", result.iterations, result.residual})) return result;
    if (!again) set_factor(now);
    const Eigen::VectorXd step = factor->solve(Eigen::VectorXd(-now.residual));
    if (!step.allFinite()) return result;
    move(result.iterate, now, nodes,
         admissible_part(result.iterate.layout, step.tail(now.passing.size())) * step);
    result.collapsed = has_collapsed(result.iterate.layout);
    if (result.collapsed) return result;
  }
}

CollocationResult solve_forces(const CollocationModel& model, CollocationIterate start,
                               const LegendreNodes& nodes, const NewtonLimits& limits, KnownPeriod known) {
  CollocationResult result;
  result.iterate = std::move(start);
  result.known = std::move(known);
  for (;; ++result.iterations) {
    const Evaluation now = evaluate(model, result.iterate, nodes, result.known.period);
    result.known.period = now.period;
    result.residual = now.force_error();
    result.converged = result.residual < limits.tolerance;
    result.iterate.forces = PanelForces(now.grid, nodes, now.force);
    if (result.converged || result.iterations == limits.max_iterations || !std::isfinite(result.residual) ||
        !goes_on(limits.observer, {"exact solution", result.iterations, result.residual}))
      return result;
    if (!result.known.influence)
      result.known.influence = model.response.influence(*now.period, model.velocity);
    const Index n = now.force.size();
    const Lu<double> factor = factor_of(result.iterate, now, nodes, *result.known.influence, n);
    const Eigen::VectorXd step = factor.solve(Eigen::VectorXd(-now.residual.head(n)));
    if (!step.allFinite()) return result;
    result.iterate.forces = PanelForces(now.grid, nodes, now.force + step);
  }
}

}  // namespace wavebalance::solvers::detail

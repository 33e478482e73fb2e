#include "friction/rubbing_newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "linalg/dense.hpp"

namespace wavebalance::solvers::detail {
namespace {

// The largest part of the shifts of the instants that leaves each phase half of its length, and no instant
// more than a fiftieth of the period behind.
double part_of_shifts(const RubbingLayout& layout, const Eigen::VectorXd& shifts) {
  constexpr double longest = 0.02;
  double part = 1.0;
  if (shifts.size() > 0) part = longest / std::max(longest, shifts.cwiseAbs().maxCoeff());
  for (const RubbingPhase& phase : layout.phases) {
    if (phase.always() || phase.begin == phase.end) continue;
    const double lost = shifts[phase.begin] - shifts[phase.end];
    if (lost > 0.0) part = std::min(part, 0.5 * (layout.end(phase) - layout.begin(phase)) / lost);
  }
  return part;
}

bool is_collapsed(const RubbingLayout& layout) {
  constexpr double shortest = 1e-10;
  return std::any_of(layout.phases.begin(), layout.phases.end(), [&](const RubbingPhase& phase) {
    return !(layout.end(phase) - layout.begin(phase) > shortest);
  });
}

// Takes the step of all unknowns, as far as the instants may go.
void take_step(RubbingIterate& iterate, const RubbingEvaluation& now, const Eigen::VectorXd& step,
               const LegendreNodes& nodes, double part) {
  const Index s = iterate.sliders.size();
  Eigen::VectorXd force = now.force;
  for (Index i = 0; i < force.size(); ++i)
    if (const int free = now.free[static_cast<std::size_t>(i)]; free >= 0) force[i] += part * step[free];
  iterate.forces = PanelForces(now.grid, nodes, force);
  iterate.sliders += part * step.segment(now.free_count, s);
}

}  // namespace

Index unknowns_of(const RubbingLayout& layout, const LegendreNodes& nodes) {
  std::vector<bool> slips(layout.panels.phases.size(), false);
  for (const RubbingPhase& phase : layout.phases)
    if (phase.state == RubbingState::slip) slips[static_cast<std::size_t>(phase.tangent)] = true;
  Index free = 0;
  for (const Panel& panel : layout.panels.grid().panels)
    free += slips[static_cast<std::size_t>(panel.phase)] ? 0 : nodes.count();
  return free + layout.sliders + Index(layout.instants.size());
}

RubbingIterate with_forces(const RubbingModel& model, RubbingLayout layout, const LegendreNodes& nodes) {
  RubbingIterate iterate{std::move(layout), {}, {}};
  iterate.sliders.setZero(iterate.layout.sliders);
  const RubbingEvaluation now = evaluate(model, iterate, nodes, true);
  const Index count = now.free_count + iterate.layout.sliders;
  Eigen::VectorXd step = Eigen::VectorXd::Zero(now.residual.size());
  if (count > 0)
    step.head(count) = Lu<double>(now.jacobian.topLeftCorner(count, count))
                           .solve(Eigen::VectorXd(-now.residual.head(count)));
  take_step(iterate, now, step, nodes, 1.0);
  return iterate;
}

double unresolved_part(const PanelForces& forces) {
  const Eigen::MatrixXd& coefficients = forces.coefficients();
  if (coefficients.size() == 0) return 0.0;
  return coefficients.bottomRows(2).cwiseAbs().maxCoeff() / coefficients.cwiseAbs().maxCoeff();
}

RubbingSolution solve_rubbing(const RubbingModel& model, RubbingIterate start, const LegendreNodes& nodes,
                              const NewtonLimits& limits) {
  constexpr double of_unresolved = 0.01;
  RubbingSolution result;
  result.iterate = std::move(start);
  double before = std::numeric_limits<double>::infinity();
  for (;; ++result.iterations) {
    const RubbingEvaluation now = evaluate(model, result.iterate, nodes, true);
    result.residual = now.error();
    result.iterate.forces = PanelForces(now.grid, nodes, now.force);
    const double tolerance =
        std::max(limits.tolerance, of_unresolved * unresolved_part(result.iterate.forces));
    result.converged = result.residual < tolerance || now.is_rounding(before);
    if (result.converged || result.iterations == limits.max_iterations || !std::isfinite(result.residual) ||
        !goes_on(limits.observer, {"contact phases", result.iterations, result.residual}))
      return result;
    before = result.residual;
    const Eigen::VectorXd step = Lu<double>(now.jacobian).solve(Eigen::VectorXd(-now.residual));
    if (!step.allFinite()) return result;
    const Index instants = Index(result.iterate.layout.instants.size());
    const double part = part_of_shifts(result.iterate.layout, step.tail(instants));
    take_step(result.iterate, now, step, nodes, part);
    for (Index k = 0; k < instants; ++k)
      result.iterate.layout.shift(int(k), part * step[step.size() - instants + k]);
    if (is_collapsed(result.iterate.layout)) return result;
  }
}

}  // namespace wavebalance::solvers::detail

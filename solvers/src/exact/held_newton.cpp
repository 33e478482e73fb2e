#include "exact/held_newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

Eigen::VectorXd slope_by_parameter(const ProblemFamily& family, double length, double value,
                                   const CollocationIterate& at, const Evaluation& now,
                                   const LegendreNodes& nodes) {
  const double change = 1e-7 * value;
  const CollocationModel beside(family.at(value + change), length);
  return (evaluate(beside, at, nodes).residual - now.residual) / change;
}

// Newton's matrix with the slope by the parameter in the place of that by the unknown held.
struct HeldMatrix {
  Lu<double> factor;
  Eigen::VectorXd column;  // of the unknown held
};

HeldMatrix matrix_of(Eigen::MatrixXd slopes, Index held, const Eigen::VectorXd& by_parameter) {
  if (held == slopes.cols()) return {Lu<double>(slopes), by_parameter};
  const Eigen::VectorXd column = slopes.col(held);
  slopes.col(held) = by_parameter;
  return {Lu<double>(slopes), column};
}

// The unknowns with the parameter last: `solved` has it in the place of the one held, which is `own`.
Eigen::VectorXd ordered(Eigen::VectorXd solved, Index held, double own) {
  const Index count = solved.size();
  solved.conservativeResize(count + 1);
  solved[count] = own;
  if (held < count) std::swap(solved[held], solved[count]);
  return solved;
}

double part_of_step(const CollocationIterate& at, const Eigen::VectorXd& step, Index forces, double value) {
  constexpr double largest_change = 0.05;
  const Index passages = step.size() - 1 - forces;
  const double change = std::abs(step[step.size() - 1] / value);
  return std::min(admissible_part(at.layout, step.segment(forces, passages)),
                  largest_change / std::max(largest_change, change));
}

}  // namespace

Index Held::number(Index forces, Index passages) const {
  if (kind == Kind::parameter) return forces + passages;
  return kind == Kind::passage ? forces + index : index;
}

// A matrix serves as long as the residual falls by it as Newton's method would have it fall, because it
// needs far longer than a residual. The last one belongs to the solution.
HeldSolution solve_held(const ProblemFamily& family, double length, double value, CollocationIterate start,
                        const LegendreNodes& nodes, const Held& held, const NewtonLimits& limits) {
  constexpr double enough = 1e-2;  // of a step, to go on with its matrix
  HeldSolution result{{}, value, {}};
  CollocationIterate& at = result.newton.iterate;
  at = std::move(start);
  double before = std::numeric_limits<double>::infinity();
  Influence influence;
  std::optional<HeldMatrix> matrix;
  bool own = false;  // whether the last step used the matrix of its iterate
  const auto goes_on = [&] {
    return solvers::goes_on(limits.observer,
                            {"exact curve", result.newton.iterations, result.newton.residual});
  };
  for (; goes_on(); ++result.newton.iterations) {
    const CollocationModel model(family.at(result.value), length);
    const Evaluation now = evaluate(model, at, nodes);
    const Index n = now.force.size(), m = now.passing.size(), number = held.number(n, m);
    result.newton.residual = now.error();
    at.forces = PanelForces(now.grid, nodes, now.force);
    const double residual = result.newton.residual;
    if (!std::isfinite(residual)) return result;
    const bool fits = matrix && matrix->factor.size() == n + m;  // panels may have come or gone
    result.newton.converged =
        residual < limits.tolerance || (fits && own && now.is_rounding(before, influence));
    own = result.newton.converged || !fits || residual > enough * before;
    if (own) {
      if (!goes_on()) return HeldSolution{};
      const bool by_parameter = result.newton.converged || held.kind != Held::Kind::parameter;
      influence = model.response.influence(*now.period, model.velocity);
      if (!goes_on()) return HeldSolution{};  // each of the three may need seconds
      const Eigen::VectorXd slope =
          by_parameter ? slope_by_parameter(family, length, result.value, at, now, nodes) : Eigen::VectorXd();
      Eigen::MatrixXd slopes = jacobian(now, impulses_of(at.layout, now, nodes), nodes, influence);
      if (!goes_on()) return HeldSolution{};
      matrix = matrix_of(std::move(slopes), number, slope);
    }
    if (result.newton.converged) {
      result.direction = ordered(matrix->factor.solve(Eigen::VectorXd(-matrix->column)), number, 1.0);
      set_errors(result.newton, now, nodes, influence, model.frequency, [&](const Eigen::VectorXd& by) {
        Eigen::VectorXd answer = matrix->factor.solve(Eigen::VectorXd(-by));
        if (number < answer.size()) answer[number] = 0.0;
        return answer;
      });
      return result;
    }
    before = residual;
    if (result.newton.iterations == limits.max_iterations) return result;
    const Eigen::VectorXd step = ordered(matrix->factor.solve(Eigen::VectorXd(-now.residual)), number, 0.0);
    if (!step.allFinite()) return result;
    const double part = part_of_step(at, step, n, result.value);
    move(at, now, nodes, part * step);
    result.value += part * step[n + m];
    result.newton.collapsed = has_collapsed(at.layout);
    if (result.newton.collapsed || !(result.value > 0.0)) return result;
  }
  return result;
}

}  // namespace wavebalance::solvers::detail

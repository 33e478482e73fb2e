#pragma once
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <optional>

#include "collocation/collocation_equations.hpp"
#include "collocation/collocation_evaluation.hpp"

namespace wavebalance::solvers::detail {

/// Quantities of a period with given instants and nodes.
struct KnownPeriod {
  std::shared_ptr<const PeriodCells> period = nullptr;
  std::optional<Influence> influence = std::nullopt;
};

struct CollocationResult {
  bool converged = false;
  bool collapsed = false;  ///< an interval has no length any more
  int iterations = 0;
  double residual = 0.0;
  CollocationIterate iterate;
  /// rms at the nodes, m: displacements by the last two Legendre coefficients of each panel as if they were
  /// missing, and by the residual, with what forces and passages do in answer.
  double resolution_error = 0.0, residual_error = 0.0;
  Eigen::VectorXd panel_errors;  ///< the former for each panel, without an answer
  /// At the instants and nodes of the iterate, which it refers to; the influence of solve_forces only.
  KnownPeriod known;
  Eigen::VectorXd tangent, damping;  ///< n, slopes of the laws by displacement (N/m) and by velocity (N s/m)
};

struct NewtonLimits {
  int max_iterations;
  double tolerance;  ///< of the residual, relative to the largest force and displacement
  const Observer& observer;
};

/// Estimated floating-point operations of a step.
inline double step_operations(double unknowns, double poles) {
  return unknowns * unknowns * (unknowns / 1.5 + 4.0 * poles) + 1.0;
}

/// Newton's method on the forces at q nodes of each panel and the instants of all passages. That with
/// the residual of rounding, Evaluation::is_rounding(), is converged, too. `known`: of the start.
CollocationResult solve_intervals(const CollocationModel& model, CollocationIterate start,
                                  const LegendreNodes& nodes, const NewtonLimits& limits, KnownPeriod known);
/// The same, only for the forces.
CollocationResult solve_forces(const CollocationModel& model, CollocationIterate start,
                               const LegendreNodes& nodes, const NewtonLimits& limits, KnownPeriod known);

/// The largest part of the shifts of the passages that leaves each interval half of its length, and no
/// passage more than a fiftieth of the period behind.
double admissible_part(const Layout& layout, const Eigen::VectorXd& shifts);
/// Adds a change of the n forces and m instants, the first n + m of its values, to the iterate of an
/// evaluation.
void move(CollocationIterate& at, const Evaluation& now, const LegendreNodes& nodes,
          const Eigen::VectorXd& change);
/// Whether an interval has no length, or more than a period.
bool has_collapsed(const Layout& layout);

/// Sets the results of a converged solution in addition to its iterate. `answer`: the unknowns by which
/// Newton's method answers a residual.
void set_errors(CollocationResult& result, const Evaluation& now, const LegendreNodes& nodes,
                const Influence& influence, double frequency,
                const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& answer);

}  // namespace wavebalance::solvers::detail

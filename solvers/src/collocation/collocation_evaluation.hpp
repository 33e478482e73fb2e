#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <memory>
#include <vector>

#include "collocation/collocation_equations.hpp"

namespace wavebalance::solvers::detail {

/// The end of a panel at which the law's force is to vanish; panel -1 where a passage has no such condition.
struct Release {
  int panel = -1;
  bool at_end = true;

  bool exists() const { return panel >= 0; }
};

/// One evaluation of the equations: n forces, then m passages.
struct Evaluation {
  CellGrid grid;
  std::shared_ptr<const PeriodCells> period;  ///< of the grid
  Eigen::VectorXd force;                      ///< n, N
  Eigen::VectorXd residual;                   ///< n + m
  Eigen::VectorXd tangent, damping;           ///< n: by displacement and by velocity per period
  Eigen::VectorXd own;                        ///< n: of the residual by its force; 0 for a rigid law
  Eigen::VectorXd passing;                    ///< m, m per period
  std::vector<Release> released;              ///< m
  double holding = 0.0;                       ///< N/m
  double force_size = 0.0, displacement_size = 0.0;

  double softness() const { return displacement_size / force_size; }
  double force_error() const {
    return force.size() > 0 ? residual.head(force.size()).cwiseAbs().maxCoeff() / force_size : 0.0;
  }
  double error() const {
    const Eigen::Index m = residual.size() - force.size();
    const double places = m > 0 ? residual.tail(m).cwiseAbs().maxCoeff() / displacement_size : 0.0;
    return std::max(force_error(), places);
  }
  /// Whether the residual is rounding: it did not fall from `before`, and is small compared with the
  /// largest force, or forces of its size do not move the contacts. A short contact has a small force and
  /// the rounding errors of large displacements. `influence`: of the iterate before, of as many unknowns.
  bool is_rounding(double before, const Influence& influence) const {
    constexpr double small = 1e-9, nothing = 1e-11;
    const double now = error();
    if (!(now > 0.5 * before)) return false;
    const Eigen::Index n = force.size(), m = residual.size() - n;
    if (now < small) return true;
    double moved = m > 0 ? residual.tail(m).cwiseAbs().maxCoeff() : 0.0;
    if (n > 0)
      moved = std::max(moved, (influence.displacement.leftCols(n) * residual.head(n)).cwiseAbs().maxCoeff());
    return moved < nothing * displacement_size;
  }
};

/// `known`: the cells of an iterate with the same instants and nodes. Keeps a reference to the nodes.
/// O(n poles (q + contacts)).
Evaluation evaluate(const CollocationModel& model, const CollocationIterate& at, const LegendreNodes& nodes,
                    std::shared_ptr<const PeriodCells> known = nullptr);

/// 1 for each force, and for each passage the impulse, N, that it adds if it comes later.
Eigen::VectorXd impulses_of(const Layout& layout, const Evaluation& now, const LegendreNodes& nodes);

/// The evaluation of a solution on other panels of the same intervals and passages, by its polynomials:
/// without residual and period.
Evaluation on_panels_of(const Layout& layout, const CollocationModel& model, const Evaluation& solved,
                        const LegendreNodes& nodes);

/// The derivative of the residual by a motion that forces move towards them: displacements at nodes and
/// passages, velocities at nodes, by any unknowns.
Eigen::MatrixXd residual_by_motion(const Evaluation& now, const Eigen::MatrixXd& displacement,
                                   const Eigen::MatrixXd& node_velocity);

/// The derivative of the residual by forces and passages, (n + m) x (n + m), for their influence on the
/// motion and the `impulses_of` the iterate.
Eigen::MatrixXd jacobian(const Evaluation& now, const Eigen::VectorXd& impulses, const LegendreNodes& nodes,
                         const Influence& influence);

}  // namespace wavebalance::solvers::detail

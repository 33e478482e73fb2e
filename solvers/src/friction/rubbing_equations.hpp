#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "friction/rubbing_layout.hpp"

namespace wavebalance::solvers::detail {

/// An iterate: the instants, the forces between them, and k_t times the positions of the sliders, N.
struct RubbingIterate {
  RubbingLayout layout;
  PanelForces forces;
  Eigen::VectorXd sliders;
};

/// One evaluation of the equations. Unknowns are the forces at the f nodes where they are free, then s
/// sliders, then m instants; the force of slip follows from the normal one at the same node.
struct RubbingEvaluation {
  CellGrid grid;
  Eigen::VectorXd force;     ///< n, N, at all nodes
  Eigen::VectorXd residual;  ///< f + s + m, N
  Eigen::MatrixXd jacobian;  ///< of the same; empty where not asked for
  std::vector<int> free;     ///< of each node the number of its unknown, -1 in slip
  Index free_count = 0;
  double force_size = 0.0, displacement_size = 0.0;
  /// Largest change of the displacements by forces like the residual, m.
  double moved = 0.0;
  /// N, what rounding of the displacements makes of the forces: these are differences of much larger ones
  /// where the structure is nearly free.
  double rounding = 0.0;

  double error() const { return residual.size() > 0 ? residual.cwiseAbs().maxCoeff() / force_size : 0.0; }
  /// Whether the residual is that of rounding: it fell no more, from `before`, and is small beside the
  /// forces or what rounding makes of them, or forces of its size move the contacts by nothing.
  bool is_rounding(double before) const {
    constexpr double small = 1e-9, nothing = 1e-12;
    const double least = std::max(small, rounding / force_size);
    return error() > 0.5 * before && (error() < least || moved < nothing * displacement_size);
  }
};

/// The equations
///
///   f_n = N_0 + k_n u_n where closed,   f_t = k_t u_t - s in stick,   f_t = sign mu f_n in slip
///
/// at the nodes; f_t = sign mu f_n, or 0 after closing, at the begin of a stick for its slider s; and at the
/// instants f_n = 0 where the contact closes and opens, f_t = sign mu f_n where it begins to slip, and f_t' =
/// sign mu f_n' where it begins to stick. The last one is that of a slip rate of zero, in forces alone.
/// Forces are polynomials that are continued as instants move. O((n + m)^2 poles).
RubbingEvaluation evaluate(const RubbingModel& model, const RubbingIterate& at, const LegendreNodes& nodes,
                           bool with_jacobian);

}  // namespace wavebalance::solvers::detail

#pragma once
#include <Eigen/Core>

#include "collocation/collocation_newton.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"

namespace wavebalance::solvers::detail {

/// Relative rms errors of the displacements: by the coefficients that are left out, if they go on to decay as
/// the last ones do, and by the residual.
struct EstimatedError {
  double resolution = 0.0, residual = 0.0;
  Eigen::VectorXd shares = {};  ///< of each panel in the former; their sum is 1

  double all() const { return resolution + residual; }
};

/// For a solution whose displacements have this rms, m.
EstimatedError error_of(const CollocationResult& solved, double motion_rms);

double rms_of(const Eigen::MatrixXd& values);

/// Cuts the intervals where the last coefficients of a panel are above `share` of the largest force: near an
/// end of the interval, where layers of fast modes lie, or in the middle. Whether it cut any.
bool divide(CollocationIterate& iterate, double share);

/// Takes away the cuts of panels at an end of their interval that have next to no part in the error: no layer
/// of fast modes is there. Not where the others need the largest number of nodes, so that every panel counts.
void join_panels(CollocationIterate& iterate, const EstimatedError& error, const LegendreNodes& nodes,
                 const CollocationOptions& options);

/// The panels that have more than their part in an error above the tolerance. False where none is or there
/// are max_panels already.
bool divide_panels(CollocationIterate& iterate, const EstimatedError& error,
                   const CollocationOptions& options);

/// Enough nodes that the last coefficients reach the tolerance at their present decay, and at least a third
/// more; or divided panels, if these need fewer unknowns or the nodes exceed their limit. False if neither
/// is possible.
bool make_finer(CollocationIterate& iterate, LegendreNodes& nodes, const EstimatedError& error,
                const CollocationOptions& options);

}  // namespace wavebalance::solvers::detail

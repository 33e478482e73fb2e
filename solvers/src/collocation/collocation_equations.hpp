#pragma once
#include <Eigen/Core>
#include <vector>

#include "collocation/collocation_model.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"

namespace wavebalance::solvers::detail {

/// An iterate: the instants of the intervals and the forces within them.
struct CollocationIterate {
  Layout layout;
  PanelForces forces;
};

/// The forces of the laws along a motion that is sampled at times l / N, C x N, at the nodes of a layout.
PanelForces forces_along(const CollocationModel& model, const Layout& layout, const LegendreNodes& nodes,
                         const ContactMotion& motion);

/// The forces of all contacts at K times in periods, C x K, N.
Eigen::MatrixXd force_at(const PanelForces& forces, const CollocationModel& model,
                         const Eigen::VectorXd& times);

}  // namespace wavebalance::solvers::detail

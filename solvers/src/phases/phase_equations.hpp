#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "phases/phase_model.hpp"
#include "wavebalance/solvers/phases/contact_phases.hpp"

namespace wavebalance::solvers::detail {

/// An iterate: the instants of the phases and the forces within them.
struct PhaseIterate {
  Layout layout;
  PanelForces forces;
};

/// The map of perturbations over a period that begins after the longest flight without forces, by the states
/// of the poles that this leaves: s x s. Its eigenvalues are the Floquet multipliers; those of the states
/// left out are zero. Empty where a matrix is singular.
Eigen::MatrixXd monodromy_of(const PhaseModel& model, const PhaseIterate& iterate,
                             const LegendreNodes& nodes);

/// The forces of the laws along a motion that is sampled at times l / N, C x N, at the nodes of a layout.
PanelForces forces_along(const PhaseModel& model, const Layout& layout, const LegendreNodes& nodes,
                         const ContactMotion& motion);

/// The forces of all contacts at K times in periods, C x K, N.
Eigen::MatrixXd force_at(const PanelForces& forces, const PhaseModel& model, const Eigen::VectorXd& times);

}  // namespace wavebalance::solvers::detail

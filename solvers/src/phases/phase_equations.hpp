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
/// of the poles that this leaves: free - by_unknowns unknowns_by, s x s, of which `free` is block diagonal
/// with a block for each pole. Its eigenvalues are the Floquet multipliers; those of the states left out are
/// zero.
struct PeriodMap {
  Eigen::MatrixXd free;         ///< s x s
  Eigen::MatrixXd by_unknowns;  ///< s x (n + m)
  Eigen::MatrixXd unknowns_by;  ///< (n + m) x s

  Eigen::MatrixXd all() const;
};

/// Nothing where a matrix is singular.
std::optional<PeriodMap> period_map(const PhaseModel& model, const PhaseIterate& iterate,
                                    const LegendreNodes& nodes);

/// The forces of the laws along a motion that is sampled at times l / N, C x N, at the nodes of a layout.
PanelForces forces_along(const PhaseModel& model, const Layout& layout, const LegendreNodes& nodes,
                         const ContactMotion& motion);

/// The forces of all contacts at K times in periods, C x K, N.
Eigen::MatrixXd force_at(const PanelForces& forces, const PhaseModel& model, const Eigen::VectorXd& times);

}  // namespace wavebalance::solvers::detail

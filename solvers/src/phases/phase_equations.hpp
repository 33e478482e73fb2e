#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "phases/phase_layout.hpp"
#include "wavebalance/solvers/phases/contact_phases.hpp"

namespace wavebalance::solvers::detail {

/// What does not change while a motion is sought.
struct PhaseModel {
  PhaseModel(const PhasesProblem& problem, double length);

  PoleResponse response;
  std::vector<LawPieces> laws;    // one per contact
  Eigen::MatrixXcd contact_free;  // C x (H + 1), m
  double frequency;               // Hz
  bool velocity = false;          // whether a force depends on it

  /// Displacement (m) and velocity (m per period) without contact at instants.
  Eigen::VectorXd free_displacement(const std::vector<Instant>& instants) const;
  Eigen::VectorXd free_velocity(const std::vector<Instant>& instants) const;
  /// Displacement (m) and velocity (m per period) of all contacts at K times, C x K.
  Influence motion(const PanelForces& forces, const Eigen::VectorXd& times) const;
};

/// An iterate: the instants of the phases and the forces within them.
struct PhaseIterate {
  Layout layout;
  PanelForces forces;
};

struct PhaseNewtonResult {
  bool converged = false;
  bool collapsed = false;  ///< a phase has no length any more
  int iterations = 0;
  double residual = 0.0;
  PhaseIterate iterate;
  Eigen::MatrixXd displacement;  ///< K x n: influence of the nodes' forces on the displacements at the nodes
};

/// Newton's method on the forces at q nodes of each panel and the instants of all passages.
PhaseNewtonResult solve_phases(const PhaseModel& model, PhaseIterate start, const LegendreNodes& nodes,
                               int max_iterations);
/// The same on the forces alone, to `tolerance` of the largest.
PhaseNewtonResult solve_forces(const PhaseModel& model, PhaseIterate start, const LegendreNodes& nodes,
                               int max_iterations, double tolerance);

/// The forces of the laws along a motion that is sampled at times l / N, C x N, at the nodes of a layout.
PanelForces forces_along(const PhaseModel& model, const Layout& layout, const LegendreNodes& nodes,
                         const Influence& motion);

/// The slopes of the laws by displacement (N/m) and by velocity (N s/m) along the motion of an iterate, as
/// polynomials on its panels.
struct LawSlopes {
  PanelForces tangent, damping;
};
LawSlopes slopes_along(const PhaseModel& model, const PhaseIterate& iterate, const LegendreNodes& nodes);

/// The instants of q nodes of each panel, by panel.
std::vector<Instant> instants_of(const std::vector<Panel>& panels, const LegendreNodes& nodes);

}  // namespace wavebalance::solvers::detail

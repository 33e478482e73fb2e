#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "phases/phase_layout.hpp"
#include "wavebalance/solvers/phases/contact_phases.hpp"

namespace wavebalance::solvers::detail {

/// Where and when a displacement or a velocity is wanted.
struct Instant {
  int contact = 0;
  double time = 0.0;  ///< periods
};

/// What does not change while a motion is sought.
struct PhaseModel {
  PhaseModel(const PhasesProblem& problem, double length);

  PoleResponse response;
  std::vector<LawPieces> laws;    // one per contact
  Eigen::MatrixXcd contact_free;  // C x (H + 1), m
  double frequency;               // Hz
  bool velocity = false;          // whether a force depends on it

  /// N/m, of the springs that hold a structure which is free to move.
  double holding() const { return laws.empty() ? 0.0 : laws.front().holding(); }

  /// Displacement (m) and velocity (m per period) without contact at instants.
  Eigen::VectorXd free_displacement(const std::vector<Instant>& instants) const;
  Eigen::VectorXd free_velocity(const std::vector<Instant>& instants) const;
  /// Displacement (m) and velocity (m per period) of all contacts at K times, C x K.
  ContactMotion free_motion(const Eigen::VectorXd& times) const;
  ContactMotion motion(const PanelForces& forces, const LegendreNodes& nodes,
                       const Eigen::VectorXd& times) const;
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
  /// rms at the nodes, m: displacements by the last two Legendre coefficients of each panel as if they were
  /// missing, and by the residual, with what forces and passages do in answer.
  double resolution_error = 0.0, residual_error = 0.0;
  Eigen::VectorXd tangent, damping;  ///< n, slopes of the laws by displacement (N/m) and by velocity (N s/m)
};

struct NewtonLimits {
  int max_iterations;
  double tolerance;  ///< of the residual, relative to the largest force and displacement
  const Observer& observer;
};

/// Newton's method on the forces at q nodes of each panel and the instants of all passages. A residual below
/// 1e-9 that falls no more is converged, too.
PhaseNewtonResult solve_phases(const PhaseModel& model, PhaseIterate start, const LegendreNodes& nodes,
                               const NewtonLimits& limits);
/// The same on the forces alone.
PhaseNewtonResult solve_forces(const PhaseModel& model, PhaseIterate start, const LegendreNodes& nodes,
                               const NewtonLimits& limits);

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

/// The instants of q nodes of each panel, by panel.
std::vector<Instant> instants_of(const std::vector<Panel>& panels, const LegendreNodes& nodes);

}  // namespace wavebalance::solvers::detail

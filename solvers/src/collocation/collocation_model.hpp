#pragma once
#include <Eigen/Core>
#include <vector>

#include "collocation/collocation_layout.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"

namespace wavebalance::solvers::detail {

/// Where and when a displacement or a velocity is wanted.
struct Instant {
  int contact = 0;
  double time = 0.0;  ///< periods
};

/// Constants of a search for a motion.
struct CollocationModel {
  CollocationModel(const ExactProblem& problem, double length);

  PoleResponse response;
  std::vector<LawSegments> laws;   // one per contact; none of laws over a period
  Eigen::MatrixXcd linear_motion;  // C x (H + 1), m
  double frequency;                // Hz
  double holding;                  // N/m, of the springs that hold a structure which is free to move
  bool velocity = false;           // whether a force depends on it

  /// Displacement (m) and velocity (m per period) without contact at instants.
  Eigen::VectorXd free_displacement(const std::vector<Instant>& instants) const;
  Eigen::VectorXd free_velocity(const std::vector<Instant>& instants) const;
  /// Displacement (m) and velocity (m per period) of all contacts at K times, C x K.
  ContactMotion free_motion(const Eigen::VectorXd& times) const;
  /// The same by forces with these cells.
  ContactMotion motion(const PanelForces& forces, const PeriodCells& period,
                       const Eigen::VectorXd& times) const;
};

/// The instants of q nodes of each panel, by panel.
std::vector<Instant> instants_of(const std::vector<Panel>& panels, const LegendreNodes& nodes);

}  // namespace wavebalance::solvers::detail

#pragma once
#include "wavebalance/solvers/phases/contact_phases.hpp"

namespace wavebalance::solvers::detail {

/// What a flow begins with near a periodic motion, at a time far from all events.
struct FlowStart {
  double begin = 0.0;            ///< periods
  Eigen::MatrixXcd harmonics{};  ///< as ContactFlow::start_near() takes them, likewise the others
  Eigen::VectorXd displacement{}, force{};
};

/// Of a motion with these displacements, R x N, m, and forces of the laws, N, at the times l / N: at a share
/// of the longest time in which no contact changes its state.
FlowStart flow_start(const PhasesProblem& problem, const Eigen::MatrixXd& displacement,
                     const Eigen::MatrixXd& force, double share_of_calm = 0.5);

/// The problem with time 0 so many periods later.
PhasesProblem begun_at(PhasesProblem problem, double begin);

}  // namespace wavebalance::solvers::detail

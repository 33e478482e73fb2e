#pragma once
#include <optional>
#include <vector>

#include "wavebalance/solvers/flow/contact_flow.hpp"

namespace wavebalance::solvers::detail {

/// Where a motion with these displacements, R x N, m, and forces of the laws, N, at the times l / N begins
/// anew: at a share of the longest time in which no contact changes its state.
PeriodStart start_near(const ExactProblem& problem, const Eigen::MatrixXd& displacement,
                       const Eigen::MatrixXd& force, double share_of_calm);

/// The longest time without events in a period of `whole` s, which may go on over its end.
struct Calm {
  double begin = 0.0, length = 0.0;  ///< s
};
Calm longest_calm(const std::vector<FlowEvent>& events, double whole);

/// The same motion from a time far from all events on: at that share of the longest time without any. Nothing
/// where the flow of the period fails.
std::optional<PeriodStart> calmed(const ExactProblem& problem, const PeriodStart& start,
                                  const std::vector<FlowEvent>& events, double share_of_calm,
                                  const FlowOptions& options = {});

/// The problem with time 0 so many periods later.
ExactProblem begun_at(ExactProblem problem, double begin);

}  // namespace wavebalance::solvers::detail

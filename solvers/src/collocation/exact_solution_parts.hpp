#pragma once
#include <functional>
#include <optional>

#include "collocation/collocation_newton.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"

namespace wavebalance::solvers {

struct ExactSolution::Parts {
  /// With the cells of the period, which refer to the nodes.
  static std::shared_ptr<const Parts> complete(Parts parts) {
    auto result = std::make_shared<Parts>(std::move(parts));
    result->period = result->model.response.cells(result->iterate.forces.grid(), result->nodes);
    return result;
  }

  detail::CollocationModel model;
  detail::CollocationIterate iterate;
  detail::LegendreNodes nodes;
  detail::PanelForces tangent, damping;                // slopes of the laws, N/m and N s/m
  std::function<Eigen::VectorXcd()> multipliers = {};  // where they need no such slopes
  std::optional<PeriodStart> start = {};               // of a motion of the flow
  std::shared_ptr<const detail::PeriodCells> period = {};
};

namespace detail {

/// Gives a motion the contact intervals and parts of a solution.
void set_parts(ExactSolution& motion, const CollocationModel& model, const CollocationResult& solved,
               const LegendreNodes& nodes);

}  // namespace detail
}  // namespace wavebalance::solvers

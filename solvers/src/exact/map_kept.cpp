#include "exact/map_path.hpp"
#include "flow/flow_intervals.hpp"

namespace wavebalance::solvers::detail {

std::optional<MapPath::Closed> MapPath::closed_as_kept(double value,
                                                       const Eigen::VectorXd& displacement) const {
  const Eigen::MatrixXd by_time = displacement.reshaped(family().dynamics().contacts(), times().size());
  const MapStart start = near_start(value, by_time, family().at(value).laws.force(by_time));
  keeps_states_ = true;
  auto found = closed(start, along_parameter(start.state.size()), {}, tolerance_);
  keeps_states_ = false;
  return found;
}

std::optional<Eigen::VectorXd> MapPath::kept(double value, const Eigen::VectorXd& displacement) const {
  const auto found = closed_as_kept(value, displacement);
  if (!found) return std::nullopt;
  return displacement_of(motion_of(family().at(value), found->flow, found->start));
}

std::shared_ptr<MapPoint> MapPath::solve_kept(double value, const Eigen::VectorXd& displacement) const {
  auto found = closed_as_kept(value, displacement);
  return found ? solved(found->start, along_parameter(found->start.state.size()), found->slopes) : nullptr;
}

}  // namespace wavebalance::solvers::detail

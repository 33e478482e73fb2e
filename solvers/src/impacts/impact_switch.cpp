#include "impacts/impact_switch.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

// Whether a place lies near the step.
bool lies_near(const ImpactStep& step, const CurvePoint& at) {
  constexpr double twice = 2.0;
  const CurvePoint way = ImpactPath::chord(step.last.point, step.next.point),
                   part = ImpactPath::chord(step.last.point, at);
  return step.path.inner(part, part) <= twice * twice * step.path.inner(way, way);
}

void reverse(CurvePoint& point) {
  point.displacement_tangent *= -1.0;
  point.parameter_tangent *= -1.0;
}

CurvePoint start_at(Eigen::VectorXd unknowns, double value) {
  CurvePoint start;
  start.displacement = std::move(unknowns);
  start.parameter = value;
  return start;
}

// The impact whose impulse vanishes first, and after which share of the step; -1 where none does.
std::pair<Index, double> first_to_vanish(const ImpactStep& step) {
  const auto count = Index(step.path.contacts().size());
  const Eigen::VectorXd from = step.last.point.displacement.tail(count),
                        to = step.next.point.displacement.tail(count);
  std::pair<Index, double> first{-1, 2.0};
  for (Index i = 0; i < count; ++i)
    if (to[i] <= 0.0 && from[i] > to[i] && from[i] / (from[i] - to[i]) < first.second)
      first = {i, from[i] / (from[i] - to[i])};
  return first;
}

// Towards growing parameters.
CurvePoint upwards(const ImpactStep& step, const CurvePoint& at) {
  CurvePoint along = at;
  along.displacement_tangent = Eigen::VectorXd::Zero(at.displacement.size());
  along.parameter_tangent = step.scales.parameter;
  return along;
}

std::optional<ImpactSwitch> vanishing(const ImpactStep& step) {
  const auto [gone, share] = first_to_vanish(step);
  if (gone < 0) return std::nullopt;
  CurvePoint start = step.last.point;
  start.displacement += share * (step.next.point.displacement - start.displacement);
  start.parameter += share * (step.next.point.parameter - start.parameter);
  const std::optional<ImpactPlace> grazing = step.path.at_grazing(start, gone);
  if (!grazing || !lies_near(step, grazing->point)) return std::nullopt;
  std::vector<int> contacts = step.path.contacts();
  contacts.erase(contacts.begin() + gone);
  ImpactSwitch found{std::make_unique<ImpactPath>(step.family, step.scales, contacts), {}};
  const CurvePoint at = start_at(without_impact(grazing->point.displacement, gone), grazing->point.parameter);
  std::optional<ImpactPlace> place = found.path->at_value(at, at.parameter);
  if (!place || !found.path->set_tangent(place->point, upwards(step, at))) return std::nullopt;
  // Where the contact is below its gap it touches no more.
  CurvePoint whole = place->point;
  whole.displacement_tangent = with_impact(whole.displacement_tangent, gone, 0.0);
  if (step.path.height_slope(gone, whole) > 0.0) reverse(place->point);
  found.place = std::move(*place);
  return found;
}

// The number and the instant of the impact that the penetrating contact makes, among those of the path.
std::pair<Index, double> place_of_touch(const ImpactStep& step) {
  const Eigen::VectorXd& unknowns = step.next.point.displacement;
  const auto count = Index(step.path.contacts().size());
  double time = step.next.motion.penetration_time;
  if (count == 0) return {0, time};
  time = unknowns[0] + (time - unknowns[0] - std::floor(time - unknowns[0]));
  Index place = 0;
  while (place < count && unknowns[place] < time) ++place;
  return {place, time};
}

std::optional<ImpactSwitch> appearing(const ImpactStep& step) {
  if (step.next.motion.penetrating_contact < 0) return std::nullopt;
  const auto [added, time] = place_of_touch(step);
  std::vector<int> contacts = step.path.contacts();
  contacts.insert(contacts.begin() + added, step.next.motion.penetrating_contact);
  const auto count = Index(contacts.size());
  ImpactSwitch found{std::make_unique<ImpactPath>(step.family, step.scales, contacts), {}};
  std::optional<ImpactPlace> grazing = found.path->at_grazing(
      start_at(with_impact(step.next.point.displacement, added, time), step.next.point.parameter), added);
  if (!grazing) return std::nullopt;
  CurvePoint along = grazing->point;
  along.displacement_tangent = Eigen::VectorXd::Unit(2 * count, count + added);
  along.parameter_tangent = 0.0;
  if (!found.path->set_tangent(grazing->point, along)) return std::nullopt;
  if (grazing->point.displacement_tangent[count + added] < 0.0) reverse(grazing->point);
  // Without the impact that has no impulse it is a motion of the present path.
  const CurvePoint at =
      start_at(without_impact(grazing->point.displacement, added), grazing->point.parameter);
  if (!lies_near(step, at)) return std::nullopt;
  std::optional<ImpactPlace> present = step.path.at_value(at, at.parameter);
  if (!present) return std::nullopt;
  grazing->motion = std::move(present->motion);
  found.place = std::move(*grazing);
  return found;
}

std::optional<ImpactSwitch> passing(const ImpactStep& step) {
  const auto count = Index(step.path.contacts().size());
  const Eigen::VectorXd& unknowns = step.next.point.displacement;
  std::vector<Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), Index{0});
  std::ranges::stable_sort(order, {}, [&](Index i) { return unknowns[i]; });
  std::vector<int> contacts;
  std::vector<Index> all = order;
  for (const Index i : order) contacts.push_back(step.path.contacts()[static_cast<std::size_t>(i)]);
  for (const Index i : order) all.push_back(count + i);
  if (contacts == step.path.contacts()) return std::nullopt;
  ImpactSwitch found{std::make_unique<ImpactPath>(step.family, step.scales, contacts), {}, false};
  const CurvePoint at = start_at(unknowns(all), step.next.point.parameter);
  std::optional<ImpactPlace> place = found.path->at_value(at, at.parameter);
  CurvePoint along = at;
  along.displacement_tangent = step.last.point.displacement_tangent(all);
  along.parameter_tangent = step.last.point.parameter_tangent;
  if (!place || !found.path->set_tangent(place->point, along)) return std::nullopt;
  found.place = std::move(*place);
  return found;
}

std::optional<ImpactSwitch> switch_of(const ImpactStep& step) {
  switch (step.next.motion.status) {
    case ImpactStatus::pulling:
      return vanishing(step);
    case ImpactStatus::penetrating:
      return appearing(step);
    case ImpactStatus::wrong_order:
      return passing(step);
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<ImpactSwitch> impact_switch(const ImpactStep& step) {
  std::optional<ImpactSwitch> found = switch_of(step);
  if (found && !found->place.motion.converged()) found.reset();
  return found;
}

Eigen::VectorXd without_impact(const Eigen::VectorXd& unknowns, Index i) {
  const Index count = unknowns.size() / 2;
  Eigen::VectorXd fewer(unknowns.size() - 2);
  fewer << unknowns.head(i), unknowns.segment(i + 1, count - 1), unknowns.tail(count - 1 - i);
  return fewer;
}

Eigen::VectorXd with_impact(const Eigen::VectorXd& unknowns, Index i, double time) {
  const Index count = unknowns.size() / 2;
  Eigen::VectorXd more(unknowns.size() + 2);
  more << unknowns.head(i), time, unknowns.segment(i, count), 0.0, unknowns.tail(count - i);
  return more;
}

}  // namespace wavebalance::solvers::detail

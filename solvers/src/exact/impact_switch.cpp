#include "exact/impact_switch.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "linalg/index.hpp"
#include "linalg/root.hpp"

namespace wavebalance::solvers::detail {
namespace {

// Whether a place lies near the step.
bool lies_near(const ImpactStep& step, const ImpactPoint& at) {
  constexpr double twice = 2.0;
  const ImpactPoint way = ImpactPath::chord(step.last.point, step.next.point),
                    part = ImpactPath::chord(step.last.point, at);
  return step.path.inner(part, part) <= twice * twice * step.path.inner(way, way);
}

void reverse(ImpactPoint& point) {
  point.displacement_tangent *= -1.0;
  point.parameter_tangent *= -1.0;
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

// The impacts without an impulse at a place: several of equal contacts vanish together. The last one first.
std::vector<Index> without_impulse(const ImpactPoint& at) {
  constexpr double rounding = 1e-9;  // of the impulses' scale
  const Index count = at.displacement.size() / 2;
  std::vector<Index> gone;
  for (Index i = count - 1; i >= 0; --i)
    if (std::abs(at.displacement[count + i]) <= rounding) gone.push_back(i);
  return gone;
}

std::optional<ImpactSwitch> vanishing(const ImpactStep& step) {
  const auto [first, share] = first_to_vanish(step);
  if (first < 0) return std::nullopt;
  ImpactPoint start = step.last.point;
  start.displacement += share * (step.next.point.displacement - start.displacement);
  start.parameter += share * (step.next.point.parameter - start.parameter);
  const std::optional<ImpactPlace> grazing = step.path.at_grazing(start, first);
  if (!grazing || !lies_near(step, grazing->point)) return std::nullopt;
  std::vector<int> contacts = step.path.contacts();
  Eigen::VectorXd unknowns = grazing->point.displacement;
  const std::vector<Index> gone = without_impulse(grazing->point);
  for (const Index i : gone) {
    contacts.erase(contacts.begin() + i);
    unknowns = without_impact(unknowns, i);
  }
  ImpactSwitch found{std::make_unique<ImpactPath>(step.family, step.scales, contacts), {}};
  std::optional<ImpactPlace> place = found.path->at_value(unknowns, grazing->point.parameter);
  if (!place || !found.path->tangent_at(place->point, found.path->along_parameter(true))) return std::nullopt;
  // Where the contact is below its gap it touches no more.
  ImpactPoint whole = place->point;
  for (auto i = gone.rbegin(); i != gone.rend(); ++i)
    whole.displacement_tangent = with_impact(whole.displacement_tangent, *i, 0.0);
  if (step.path.curve().height_slope(first, whole) > 0.0) reverse(place->point);
  found.place = std::move(*place);
  return found;
}

// A contact that touches its obstacle, and where it does, periods.
struct Contact {
  int contact = 0;
  double time = 0.0;
};

// The number of the impact before which a touch comes, with its instant relative to the first.
std::pair<Index, double> place_of_touch(const Eigen::VectorXd& unknowns, double time) {
  const Index count = unknowns.size() / 2;
  if (count == 0) return {0, time};
  time = unknowns[0] + (time - unknowns[0] - std::floor(time - unknowns[0]));
  Index place = 0;
  while (place < count && unknowns[place] < time) ++place;
  return {place, time};
}

// The contacts that touch their obstacles without an impulse, except impacts and one known touch: their
// highest points reach the gap. Equal contacts graze together.
std::vector<Contact> touches_beside(const ImpactSolution& motion, const Contact& known) {
  constexpr int instants = 1024;
  constexpr double same = 1e-4, rounding = 1e-8;  // periods, of the motion
  const ImpactModel& model = *motion.model;
  const auto near = [](double a, double b) { return std::abs(a - b - std::round(a - b)) < same; };
  const auto height = [&](int contact, double time) {
    return motion.at(time).displacement[contact] - model.gaps()[contact];
  };
  Eigen::MatrixXd u(model.contacts(), instants);
  for (int k = 0; k < instants; ++k) u.col(k) = motion.at(double(k) / instants).displacement;
  std::vector<Contact> found;
  for (int c = 0; c < model.contacts(); ++c)
    for (Index k = 0; k < instants; ++k) {
      if (u(c, k) < u(c, (k + 1) % instants) || u(c, k) <= u(c, (k + instants - 1) % instants)) continue;
      const auto velocity = [&](double time) { return motion.at(time).velocity[c]; };
      const double low = (double(k) - 1.0) / instants, high = (double(k) + 1.0) / instants;
      const auto top = root(velocity, {low, velocity(low)}, {high, velocity(high)}, 1e-12);
      const double time = top.value_or(double(k) / instants);
      if (height(c, time) < -rounding * model.displacement_scale()) continue;
      if (c == known.contact && near(time, known.time)) continue;
      if (std::ranges::any_of(motion.impacts, [&](const Impact& impact) {
            return impact.contact == c && near(impact.time, time);
          }))
        continue;
      found.push_back({c, time});
    }
  return found;
}

// The path with impacts more, at the place where the first of them has no impulse.
struct Added {
  std::unique_ptr<ImpactPath> path;
  std::optional<ImpactPlace> grazing;
  Index first = 0;             // its number
  std::vector<Index> numbers;  // of all that were added, in the order of their insertion
};

Added with_touches(const ImpactStep& step, const ImpactPoint& at, const std::vector<Contact>& touches) {
  Added added;
  std::vector<int> contacts = step.path.contacts();
  Eigen::VectorXd unknowns = at.displacement;
  for (const Contact& touch : touches) {
    const auto [place, time] = place_of_touch(unknowns, touch.time);
    contacts.insert(contacts.begin() + place, touch.contact);
    unknowns = with_impact(unknowns, place, time);
    if (!added.numbers.empty() && place <= added.first) ++added.first;
    if (added.numbers.empty()) added.first = place;
    added.numbers.push_back(place);
  }
  added.path = std::make_unique<ImpactPath>(step.family, step.scales, contacts);
  added.grazing = added.path->at_grazing(impact_point(unknowns, at.parameter), added.first);
  return added;
}

ImpactPoint without(const ImpactPoint& at, const std::vector<Index>& numbers) {
  Eigen::VectorXd unknowns = at.displacement;
  for (auto i = numbers.rbegin(); i != numbers.rend(); ++i) unknowns = without_impact(unknowns, *i);
  return impact_point(unknowns, at.parameter);
}

std::optional<ImpactSwitch> appearing(const ImpactStep& step) {
  const ImpactSolution& beyond = step.next.solution;
  if (beyond.penetrating_contact < 0) return std::nullopt;
  std::vector<Contact> touches{{beyond.penetrating_contact, beyond.penetration_time}};
  Added added = with_touches(step, step.next.point, touches);
  if (!added.grazing) return std::nullopt;
  // Without the impact that has no impulse it is a motion of the present path.
  ImpactPoint at = without(added.grazing->point, added.numbers);
  if (!lies_near(step, at)) return std::nullopt;
  std::optional<ImpactPlace> present = step.path.at_value(at.displacement, at.parameter);
  if (!present) return std::nullopt;
  touches.front().time = added.grazing->point.displacement[added.first];
  for (const Contact& other : touches_beside(present->solution, touches.front())) touches.push_back(other);
  if (touches.size() > 1)
    if (Added all = with_touches(step, present->point, touches); all.grazing) added = std::move(all);
  std::optional<ImpactPlace>& grazing = added.grazing;
  ImpactPoint along = grazing->point;
  const auto count = Index(added.path->contacts().size());
  along.displacement_tangent = Eigen::VectorXd::Unit(2 * count, count + added.first);
  along.parameter_tangent = 0.0;
  if (!added.path->tangent_at(grazing->point, along)) return std::nullopt;
  if (grazing->point.displacement_tangent[count + added.first] < 0.0) reverse(grazing->point);
  grazing->solution = std::move(present->solution);
  return ImpactSwitch{std::move(added.path), std::move(*grazing)};
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
  std::optional<ImpactPlace> place = found.path->at_value(unknowns(all), step.next.point.parameter);
  ImpactPoint along;
  along.displacement_tangent = step.last.point.displacement_tangent(all);
  along.parameter_tangent = step.last.point.parameter_tangent;
  if (!place || !found.path->tangent_at(place->point, along)) return std::nullopt;
  found.place = std::move(*place);
  return found;
}

std::optional<ImpactSwitch> switch_of(const ImpactStep& step) {
  switch (step.next.solution.status) {
    case ExactStatus::pulling:
      return vanishing(step);
    case ExactStatus::penetrating:
      return appearing(step);
    case ExactStatus::wrong_order:
      return passing(step);
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<ImpactSwitch> impact_switch(const ImpactStep& step) {
  std::optional<ImpactSwitch> found = switch_of(step);
  if (found && !found->place.solution.converged()) found.reset();
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

#include "exact/interval_switch.hpp"

#include <algorithm>
#include <cmath>

#include "collocation/exact_solution_parts.hpp"
#include "linalg/index.hpp"
#include "linalg/multipliers.hpp"

namespace wavebalance::solvers::detail {
namespace {

// Periods. The length of a new interval grows like the root of the distance from grazing, so that intervals
// of this length are very near to it. The interval of a stiff contact is soon shorter than without its
// force: a quarter of the length is tried, and so on.
constexpr double short_interval = 1e-2, shortest_interval = 1e-5, vanishing_interval = 6e-3;

// The interval of a contact at a time, if it has one.
const LayoutInterval* interval_at(const Layout& layout, int contact, double time) {
  for (const LayoutInterval& part : layout.intervals) {
    if (part.contact != contact) continue;
    const double begin = layout.begin(part), shifted = time - std::floor(time - begin);
    if (shifted <= layout.end(part)) return &part;
  }
  return nullptr;
}

// Whether a contact is on other pieces of its law by the two at a time.
bool differ_at(const Layout& a, const Layout& b, int contact, double time) {
  const LayoutInterval *const one = interval_at(a, contact, time), *const other =
                                                                       interval_at(b, contact, time);
  return one && other ? one->piece != other->piece : one != other;
}

bool is_new(const Interval& interval, const Layout& before, const Layout& now) {
  return differ_at(before, now, interval.contact, interval.begin + 0.5 * interval.length);
}

// The intervals of the motion that the equations do not have, the shortest first.
std::vector<Interval> new_intervals(const PathPoint& point) {
  std::vector<Interval> intervals = intervals_of(point.intervals_of_motion);
  std::erase_if(intervals, [&](const Interval& interval) {
    return !is_new(interval, point.iterate.layout, point.intervals_of_motion);
  });
  return intervals;
}

// A point beyond grazing whose motion has the new interval, which has a length in `next`, with about the
// length that is wanted.
std::optional<PathPoint> slightly_beyond(const PathModel& model, const PathPoint& grazing,
                                         const PathPoint& next, double length, double wanted,
                                         const Held& held, double forwards) {
  if (length <= wanted) return next;
  const double share = std::pow(wanted / length, 2);
  const double place = grazing.place + share * (next.place - grazing.place);
  Prediction expected = through({&grazing, &next}, place);
  return model.solve(expected.value, std::move(expected.iterate), held, forwards);
}

// Passages in the equations are known far better than from samples of the motion.
void keep_passages(const Layout& known, Layout& layout) {
  constexpr double same = 1e-4;  // periods
  for (Passage& passage : layout.passages)
    for (const Passage& one : known.passages) {
      const double apart = passage.time - one.time, shift = std::round(apart);
      if (one.contact == passage.contact && one.breakpoint == passage.breakpoint &&
          std::abs(apart - shift) < same)
        passage.time = one.time + shift;
    }
}

// The intervals of the motion of a solution and the forces along it.
CollocationIterate along_own_motion(const PathPoint& at) {
  constexpr Index instants = 1024;
  const CollocationModel& own = at.motion.parts->model;
  const LegendreNodes& nodes = at.motion.parts->nodes;
  const ContactMotion motion =
      own.motion(at.iterate.forces, *at.motion.parts->period,
                 Eigen::VectorXd::LinSpaced(instants, 0.0, 1.0 - 1.0 / double(instants)));
  Layout layout = layout_of(own.laws, own.frequency, motion.displacement, motion.velocity);
  keep_passages(at.iterate.layout, layout);
  layout.cut_by_others = at.iterate.layout.cut_by_others;
  layout = with_cuts_of(at.iterate.layout, std::move(layout));
  PanelForces forces = forces_along(own, layout, nodes, motion);
  return {std::move(layout), std::move(forces)};
}

// A point with an interval.
struct WithInterval {
  PathPoint point;
  Interval interval;
};

bool differ(const PathModel& model, const PathPoint& a, const PathPoint& b) {
  if (a.slope * b.slope < 0.0) return true;
  return model.options().stability &&
         count_outside(a.motion.multipliers()) != count_outside(b.motion.multipliers());
}

// Whether an interval is about as long in a solution as it was in its start. Else it is another one of the
// curve, which may turn soon behind grazing.
bool has_about_the_length(const PathPoint& found, const Interval& interval, double length) {
  for (const Interval& one : intervals_of(found.iterate.layout))
    if (one.from == interval.from && one.to == interval.to)
      return one.length > 0.5 * length && one.length < 2.0 * length;
  return false;
}

// Points with the interval from one of them towards grazing, each with half of its length, until slope and
// stability equal the values at grazing. The parameter differs by the square of the length, so that if none
// is found then, it equals grazing to ten digits. Where the contact is so stiff that rounding stops
// Newton's method before, it is one to six; nothing where it stops earlier.
std::optional<std::vector<PathPoint>> towards(const PathModel& model, const PathPoint& grazing,
                                              const WithInterval& from) {
  constexpr double shortest = 1e-5, one = 1e-6;
  std::vector<PathPoint> points;
  const PathPoint* last = &from.point;
  const auto moves = [&](int passage) { return std::abs(from.point.motion_of(passage)); };
  const Held held{Held::Kind::passage, moves(from.interval.to) > moves(from.interval.from)
                                           ? from.interval.to
                                           : from.interval.from};
  const double forwards = model.sign_of(from.point, held), order = growth(from.point, from.interval);
  points.reserve(64);
  for (double length = from.interval.length; length > shortest && differ(model, grazing, *last);
       length *= 0.5) {
    const Prediction expected = along_tangent(*last, -0.5 * length, growth(*last, from.interval));
    std::optional<PathPoint> shorter = model.solve(expected.value, expected.iterate, held, forwards);
    if (shorter && !has_about_the_length(*shorter, from.interval, 0.5 * length)) shorter.reset();
    if (!shorter && std::abs(last->value - grazing.value) < one * grazing.value) break;
    if (!shorter) return std::nullopt;
    shorter->place = last->place - std::copysign(length, order);
    points.push_back(std::move(*shorter));
    last = &points.back();
  }
  return points;
}

// The solution with the contact intervals of its motion; the end of the new interval is fixed.
std::optional<WithInterval> with_new_interval(const PathModel& model, const PathPoint& beyond,
                                              double wanted) {
  CollocationIterate start = along_own_motion(beyond);
  const std::vector<Interval> intervals = intervals_of(start.layout);
  for (const Interval& interval : intervals) {
    if (interval.length > 3.0 * wanted) break;
    if (!is_new(interval, beyond.iterate.layout, start.layout)) continue;
    const Held held{Held::Kind::passage, interval.to};
    std::optional<PathPoint> found = model.solve(beyond.value, start, held, 1.0);
    if (!found || !found->agrees || !has_about_the_length(*found, interval, interval.length)) continue;
    if (growth(*found, interval) < 0.0) found->turn_around();
    return WithInterval{std::move(*found), interval};
  }
  return std::nullopt;
}

// Where the motion without an interval grazes, over the parameter, by the secant method; and forwards from
// there, towards motions that do not pass the breakpoint.
std::optional<PathPoint> grazing_without(const PathModel& model, const PathPoint& start,
                                         const Grazing& grazing) {
  constexpr int most = 20;
  constexpr double apart = 1e-9;
  const Held held{};
  double before = start.value, passed_before = passed_by(start.motion, grazing);
  double now = before * (1.0 + 1e-7);
  std::optional<PathPoint> point;
  CollocationIterate iterate = start.iterate;
  double slope = 0.0;
  for (int i = 0; i < most; ++i) {
    point = model.solve(now, iterate, held, 1.0);
    if (!point) return std::nullopt;
    const double passed = passed_by(point->motion, grazing);
    // For two nearly identical points it is rounding.
    if (i == 0 || std::abs(now - before) > apart * now) slope = (passed - passed_before) / (now - before);
    if (!std::isfinite(slope)) return std::nullopt;
    const double step = -passed / slope;
    if (std::abs(step) < 1e-14 * now || passed == passed_before) {
      if (slope > 0.0) point->turn_around();
      return point;
    }
    if (std::abs(step) > 0.2 * model.parameter_scale()) return std::nullopt;
    iterate = point->iterate;
    before = now;
    passed_before = passed;
    now += step;
  }
  return std::nullopt;
}

// The length of an interval falls like the root of the distance from grazing, by its half over as long a way.
// Whether neither the parameter nor other passages change by more than a step may on that way.
bool vanishes_soon(const PathModel& model, const PathPoint& at, const Interval& interval) {
  const double shrinks = -growth(at, interval);
  if (!(shrinks > 0.0)) return false;
  const double way = 0.5 * interval.length / shrinks, most = model.options().largest_step;
  double farthest = std::abs(at.motion_of_parameter()) / model.parameter_scale();
  for (int i = 0; i < at.passages(); ++i)
    if (i != interval.from && i != interval.to)
      farthest = std::max(farthest, std::abs(at.motion_of(i)) / passage_scale);
  return way * farthest < most;
}

// The first grazing point of the way to `next` by new intervals of its motion, and the interval.
struct FirstGrazing {
  PathPoint point;
  double length;  // of the interval in `next`
};

std::optional<FirstGrazing> first_grazing(const PathModel& model, const PathPoint& current,
                                          const PathPoint& next, bool turns) {
  constexpr std::size_t most = 6;
  const std::vector<Interval> intervals = new_intervals(next);
  if (intervals.size() > most) return std::nullopt;
  std::optional<FirstGrazing> first;
  for (const Interval& interval : intervals) {
    const Grazing grazing = grazing_of(next, next.intervals_of_motion, interval);
    const PointOnCurve at = zero_between(model, current, next, turns, [&](const CurvePoint& point) {
      return passed_by(point.motion, grazing);
    });
    if (!at) return std::nullopt;
    if (!first || at->place < first->point.place)
      first = FirstGrazing{static_cast<const PathPoint&>(*at), interval.length};
  }
  return first;
}

}  // namespace

std::optional<Switch> appearance(const PathModel& model, const PathPoint& current, const PathPoint& next) {
  const bool turns = current.slope * next.slope < 0.0;
  const Held held = model.fastest(current, !turns);
  std::optional<FirstGrazing> first = first_grazing(model, current, next, turns);
  if (!first) return std::nullopt;
  PathPoint* const at = &first->point;
  std::optional<WithInterval> behind;
  std::optional<std::vector<PathPoint>> between;
  for (double wanted = short_interval; !between && wanted > shortest_interval; wanted *= 0.25) {
    const std::optional<PathPoint> beyond =
        slightly_beyond(model, *at, next, first->length, wanted, held, model.sign_of(current, held));
    if (beyond) behind = with_new_interval(model, *beyond, wanted);
    if (beyond && behind) between = towards(model, *at, *behind);
  }
  if (!between) return std::nullopt;
  const PathPoint& nearest = between->empty() ? behind->point : between->back();
  const bool reverses = nearest.slope * at->slope < 0.0;
  std::reverse(between->begin(), between->end());
  return Switch{std::move(*at), std::move(behind->point), true, *std::move(between), reverses};
}

std::optional<Switch> disappearance(const PathModel& model, const PathPoint& current) {
  std::vector<Interval> vanishing = intervals_of(current.iterate.layout);
  std::erase_if(vanishing, [&](const Interval& interval) {
    return interval.length > vanishing_interval || !vanishes_soon(model, current, interval);
  });
  if (vanishing.empty()) return std::nullopt;
  // Equal contacts vanish together, others one after the other.
  constexpr double equal = 1.0 + 1e-6;
  const double shortest = vanishing.front().length;
  std::erase_if(vanishing, [&](const Interval& interval) { return interval.length > equal * shortest; });
  const Grazing grazing = grazing_of(current, current.iterate.layout, vanishing.front());
  const std::optional<PathPoint> start = model.solve(
      current.value, with_layout(current, without(current.iterate.layout, vanishing)), Held{}, 1.0);
  if (!start) return std::nullopt;
  std::optional<PathPoint> at = grazing_without(model, *start, grazing);
  if (!at || at->iterate.layout.shortest_interval() < shortest_interval) return std::nullopt;
  std::optional<std::vector<PathPoint>> between = towards(model, *at, {current, vanishing.front()});
  if (!between) return std::nullopt;
  const bool reverses = (between->empty() ? current : between->back()).slope * at->slope < 0.0;
  PathPoint next = *at;
  return Switch{std::move(*at), std::move(next), false, *std::move(between), reverses};
}

}  // namespace wavebalance::solvers::detail

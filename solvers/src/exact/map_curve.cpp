#include "exact/map_curve.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "collocation/collocation_refinement.hpp"
#include "exact/curve_tracer.hpp"
#include "exact/map_path.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers::detail {
namespace {

/// Prediction at another place of the curve.
struct Expected {
  MapStart start;
  Eigen::VectorXd displacement;
};

/// Two motions that are one to nine digits of a step, between which a contact changes what it does.
struct Change {
  double value;  ///< of the parameter
  std::shared_ptr<const MapPoint> before, behind;
};

class MapTracer : public CurveTracer {
 public:
  MapTracer(MapPath& path, ExactCurve& curve, PointOnCurve first)
      : CurveTracer(path, curve, std::move(first)), path_(path) {}

 private:
  /// By arc length.
  struct Secant {
    Eigen::VectorXd displacement;
    double value;
  };

  void advance() override {
    constexpr double beside = 0.1;  // of the longest time without events
    if (last().nearest_event < beside * last().calm) begin_anew();
    const std::shared_ptr<MapPoint> next = corrected();
    if (!next) return retry();
    failures_ = 0;
    take(next);
  }

  // Where a contact of several rows opens or closes in all of the period at once, as a journal in a ring
  // does, the curve has a corner, behind which displacements go on as they do on a secant before it. The
  // parameter goes on or back.
  bool pass_corner() {
    constexpr double near = 1e-4, way = 1e-2, farthest = 5.0 * way;
    if (step_ > near) return false;
    const Secant secant = secant_before(10.0 * near);
    const Eigen::VectorXd beyond = last().displacement + way * secant.displacement;
    const double ahead = std::copysign(way * path_.parameter_scale(), secant.value);
    for (const double change : {ahead, -ahead}) {
      if (!within(last().value + change)) continue;
      std::shared_ptr<MapPoint> next = path_.solve_kept(last().value + change, beyond);
      if (!next || next->start.contacts == last().start.contacts) continue;
      const Eigen::VectorXd moved = next->displacement - last().displacement;
      if (moved.dot(secant.displacement) < 0.0 || path_.arc_length(last(), *next) > farthest) continue;
      if (next->displacement_direction.dot(moved) < 0.0) next->turn_around();
      go_round(secant, beyond, std::move(next));
      step_ = 0.1 * way;
      return true;
    }
    return false;
  }

  void go_round(const Secant& secant, const Eigen::VectorXd& beyond, std::shared_ptr<MapPoint> next) {
    CurvePoint corner = last();
    corner.value += way_to_corner(secant, beyond);
    if (secant.value * next->slope < 0.0) note(SpecialPointType::fold, corner);
    note(SpecialPointType::grazing, corner);
    points().clear();
    accept(std::move(next));
  }

  // The change of the parameter up to where the motions of either side meet: those behind a corner go on
  // before it, where their contacts keep their states.
  double way_to_corner(const Secant& secant, const Eigen::VectorXd& beyond) const {
    const double value = last().value, small = 1e-3 * path_.parameter_scale();
    const auto here = path_.kept(value, beyond), there = path_.kept(value + small, beyond);
    if (!here || !there) return 0.0;
    const Eigen::VectorXd meet =
        (*there - *here) / small - secant.displacement / secant.value;  // by the parameter
    return meet.dot(last().displacement - *here) / meet.squaredNorm();
  }

  // By arc length, from a point so far before the last one.
  Secant secant_before(double far) {
    CurvePoint before;
    double arc = 0.0;
    for (std::size_t i = curve().points.size() - 1; i > 0 && arc < far; --i) {
      before.value = curve().points[i - 1].value;
      before.displacement = path_.displacement_of(curve().points[i - 1].motion);
      arc = path_.arc_length(before, last());
    }
    if (arc == 0.0) return {last().displacement_direction, last().slope};
    return {(last().displacement - before.displacement) / arc, (last().value - before.value) / arc};
  }

  // Another beginning of the period, if contacts change their state at the beginning of the last point.
  void retry() {
    constexpr int most = 4;
    if (pass_corner()) return;
    shorten_step();
    if (++failures_ % most == 0) begin_anew();
  }

  void begin_anew() {
    PointOnCurve anew = path_.begun_anew(last());
    if (!anew) return;
    points().clear();
    points().push_back(std::move(anew));
  }

  const MapPoint& last() const { return static_cast<const MapPoint&>(*points().back()); }

  // The next point, if it lies where it is expected.
  std::shared_ptr<MapPoint> corrected() {
    // Where the curve has become sharper than its last steps are long, their polynomial predicts nothing.
    if (is_smooth())
      if (std::shared_ptr<MapPoint> next = near(through_last())) return next;
    return near({moved_by(last().direction), last().displacement + step_ * last().displacement_direction});
  }

  MapStart moved_by(const Eigen::VectorXd& direction) {
    MapStart start = last().start;
    start.state += step_ * direction.head(start.state.size());
    start.value += step_ * direction[start.state.size()];
    return start;
  }

  // By the polynomial through the last points with the same states of the contacts at the beginning.
  Expected through_last() {
    std::vector<const MapPoint*> known;
    for (auto it = points().rbegin(); it != points().rend(); ++it) {
      const auto& point = static_cast<const MapPoint&>(**it);
      if (point.start.contacts != last().start.contacts) break;
      known.push_back(&point);
    }
    const double place = last().place + step_;
    Expected expected{last().start, Eigen::VectorXd::Zero(last().displacement.size())};
    expected.start.value = 0.0;
    expected.start.state.setZero();
    for (const MapPoint* one : known) {
      double weight = 1.0;
      for (const MapPoint* other : known)
        if (other != one) weight *= (place - other->place) / (one->place - other->place);
      expected.start.value += weight * one->value;
      expected.start.state += weight * one->start.state;
      expected.displacement += weight * one->displacement;
    }
    return expected;
  }

  std::shared_ptr<MapPoint> near(const Expected& expected) {
    std::shared_ptr<MapPoint> next = path_.solve(expected.start, last());
    if (!next) return nullptr;
    const double scale = path_.arc_scale(last()), arc = path_.arc_length(last(), *next),
                 off = std::hypot(rms_of(next->displacement - expected.displacement) / scale,
                                  (next->value - expected.start.value) / path_.parameter_scale());
    return fits(*next, off, arc, cosine(last(), *next)) ? next : nullptr;
  }

  // Cosine of the angle between the secant from one point to another and the tangent there.
  double cosine(const MapPoint& from, const MapPoint& to) const {
    const double scale = path_.arc_scale(from) * std::sqrt(double(from.displacement.size()));
    Eigen::VectorXd way(from.displacement.size() + 1), direction(way.size());
    way << (to.displacement - from.displacement) / scale, (to.value - from.value) / path_.parameter_scale();
    direction << to.displacement_direction / scale, to.slope / path_.parameter_scale();
    return way.dot(direction) / (way.norm() * direction.norm());
  }

  void append_changes(const CurvePoint& next, std::vector<PlacedEvent>& events) override {
    constexpr int most = 16;  // of a step
    const auto& b = static_cast<const MapPoint&>(next);
    const MapPoint* a = &last();
    std::shared_ptr<const MapPoint> behind;
    for (int i = 0; i < most && !(a->pattern == b.pattern) && !path_.cancelled(); ++i) {
      const auto change = change_between(*a, b);
      if (!change) return;
      append_change(a->pattern, *change, events);
      behind = change->behind;
      a = behind.get();
    }
  }

  static void append_change(const ContactPattern& before, const Change& change,
                            std::vector<PlacedEvent>& events) {
    using enum SpecialPointType;
    const ContactPattern& behind = change.behind->pattern;
    const auto type = before.slips != behind.slips         ? slip
                      : before.passages != behind.passages ? grazing
                                                           : stick;
    // A motion in which all contacts stick is smooth up to the first slip.
    const PointOnCurve at = type == slip && before.slips ? change.behind : change.before;
    // Contacts of a symmetric structure touch together, which rounding separates.
    constexpr double together = 1e-8;
    if (!events.empty() && events.back().type == type &&
        std::abs(events.back().value - change.value) <= together * std::abs(change.value))
      return;
    events.push_back({type, at, change.value});
  }

  // Where what contacts do is no more what it was, between two points.
  std::optional<Change> change_between(const MapPoint& a, const MapPoint& b) const {
    constexpr double resolved = 1e-9;  // of the way
    double low = 0.0, high = 1.0, value = a.value;
    while (high - low > resolved) {
      const double middle = 0.5 * (low + high);
      const auto found = path_.pattern_between(a, b, middle);
      if (!found) return std::nullopt;
      value = found->first;
      (found->second == a.pattern ? low : high) = middle;
    }
    // At this distance rounding may decide: the reported motions are on either side.
    const auto nearest = [&](double share, double away, bool before) {
      std::shared_ptr<const MapPoint> point;
      do {
        share = std::clamp(share, 0.0, 1.0);
        point = std::static_pointer_cast<const MapPoint>(path_.between(a, b, share, a.slope * b.slope < 0.0));
        share += away;
        away *= 4.0;
      } while (point && share > 0.0 && share < 1.0 && (point->pattern == a.pattern) != before);
      return point;
    };
    Change change{value, nearest(low, -resolved, true), nearest(high, resolved, false)};
    if (!change.before || !change.behind) return std::nullopt;
    return change;
  }

  double operations_of(const CurvePoint&) const override { return path_.take_operations(); }

  bool same_unknowns(const CurvePoint& a, const CurvePoint& b) const override {
    return static_cast<const MapPoint&>(a).pattern == static_cast<const MapPoint&>(b).pattern;
  }

  MapPath& path_;
  int failures_ = 0;
};

// A body that nothing holds may be elsewhere, and the motion still comes back.
bool is_undetermined(const MapPoint& point) {
  constexpr double rounding = 1e-9;
  const Eigen::VectorXcd& all = point.slopes.multipliers;
  return std::any_of(all.begin(), all.end(),
                     [](std::complex<double> one) { return std::abs(one - 1.0) < rounding; });
}

}  // namespace

ExactCurve map_curve(const ProblemFamily& family, const ExactSolution& first,
                     const ExactCurveOptions& options) {
  ExactCurve curve;
  MapPath path(family, first, options);
  const auto start = path.first(options.from, first, options.to > options.from ? 1.0 : -1.0);
  if (path.cancelled()) curve.status = SweepStatus::cancelled;
  if (start && is_undetermined(*start))
    curve.start = ExactStatus::undetermined;
  else if (start)
    MapTracer(path, curve, start).run();
  else
    curve.start = ExactStatus::not_found;
  return curve;
}

}  // namespace wavebalance::solvers::detail

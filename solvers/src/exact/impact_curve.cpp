#include "exact/impact_curve.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "exact/curve_tracer.hpp"
#include "exact/impact_switch.hpp"
#include "linalg/index.hpp"
#include "wavebalance/solvers/flow/attractor_motion.hpp"

namespace wavebalance::solvers::detail {
namespace {

/// A motion of a curve of impacts. CurvePoint::displacement has its unknowns, by their arc lengths.
struct ImpactOnCurve : CurvePoint {
  ImpactPlace at;
};

std::vector<int> contacts_of(const std::vector<Impact>& impacts) {
  std::vector<int> contacts;
  for (const Impact& impact : impacts) contacts.push_back(impact.contact);
  return contacts;
}

/// The points with the same impacts, of which one tracer goes over to the next.
class ImpactCurvePath : public CurvePath {
 public:
  ImpactCurvePath(const ProblemFamily& family, const ExactSolution& first, const ExactCurveOptions& options,
                  int periods)
      : CurvePath(family, first, options), scales{periods, 1.0, parameter_scale()} {}

  PointOnCurve between(const CurvePoint& a, const CurvePoint& b, double share, bool) const override {
    const ImpactPoint &from = static_cast<const ImpactOnCurve&>(a).at.point,
                      &to = static_cast<const ImpactOnCurve&>(b).at.point;
    const double step = now->inner(ImpactPath::chord(from, to), from);
    const std::optional<ImpactPlace> place = now->ahead(from, share * step);
    return place ? point_at(*place, a.place + share * (b.place - a.place)) : nullptr;
  }

  std::shared_ptr<ImpactOnCurve> point_at(ImpactPlace place, double along) const {
    auto point = std::make_shared<ImpactOnCurve>();
    point->value = place.point.parameter;
    point->place = along;
    point->slope = place.point.parameter_tangent;
    point->displacement = now->lengths(place.point.displacement);
    point->vibration = 1.0;
    point->agrees = place.solution.converged();
    point->motion = motion_of(std::make_shared<const ImpactSolution>(place.solution));
    point->at = std::move(place);
    return point;
  }

  /// Begins at a value with these impacts.
  void begin(double value, const std::vector<Impact>& impacts) {
    scales.impulse = impulse_scale_of(ImpactModel(over_periods(family().at(value), scales.periods)));
    now = std::make_unique<ImpactPath>(family(), scales, contacts_of(impacts));
  }

  ImpactPathScales scales;
  std::unique_ptr<ImpactPath> now;
};

// Difference between both halves of the period.
Eigen::VectorXd difference_of_halves(const ImpactPoint& at) {
  const Index half = at.displacement.size() / 4;
  Eigen::VectorXd difference(2 * half);
  difference << at.displacement.segment(half, half) - at.displacement.head(half),
      at.displacement.tail(half) - at.displacement.segment(2 * half, half);
  difference.head(half).array() -= 0.5;
  return difference;
}

class ImpactTracer : public CurveTracer {
 public:
  ImpactTracer(ImpactCurvePath& path, ExactCurve& curve, PointOnCurve first)
      : CurveTracer(path, curve, std::move(first)), path_(path) {}

 private:
  const ImpactPlace& last() const { return static_cast<const ImpactOnCurve&>(*points().back()).at; }

  void advance() override {
    constexpr int few = 4;
    int corrections = 0;
    const double step = step_;
    const std::optional<ImpactPlace> next = path_.now->ahead(last().point, step, &corrections);
    if (!next || turn_to(*next) > largest_turn || !follow(*next)) return shorten_step();
    if (corrections <= few && step_ == step) step_ = std::min(options().largest_step, 1.5 * step);
  }

  // The angle between the tangents of the last place and the next one, rad.
  double turn_to(const ImpactPlace& next) const {
    return std::acos(std::clamp(path_.now->inner(last().point, next.point), -1.0, 1.0));
  }

  // Takes a step to the next place or, where that is no motion of the structure, to the switch before it.
  bool follow(const ImpactPlace& next) {
    if (next.solution.converged()) {
      pass(path_.point_at(next, points().back()->place + step_));
      return true;
    }
    std::optional<ImpactSwitch> over =
        impact_switch({path_.family(), path_.scales, *path_.now, last(), next});
    if (!over) return false;
    if (within(over->place.point.parameter))
      go_over(std::move(*over));
    else if (!within(next.point.parameter))
      end_before(*path_.point_at(next, points().back()->place + step_));
    else
      return false;
    return true;
  }

  void pass(std::shared_ptr<ImpactOnCurve> next) {
    if (!within(next->value)) return end_before(*next);
    if (!meets_half(last().point, next->at.point)) return go_to(std::move(next));
    note_events(*next);
    std::erase(curve().unexplained, curve().points.size());  // one multiplier passes 1 as both halves meet
    curve().status = SweepStatus::ended;
  }

  void go_over(ImpactSwitch over) {
    constexpr std::size_t most_impacts = 40;  // in a period: where more appear they accumulate
    const bool turns = over.place.point.parameter_tangent * last().point.parameter_tangent < 0.0;
    const double along = points().back()->place;
    const std::size_t before = path_.now->contacts().size(), behind = over.path->contacts().size();
    path_.now = std::move(over.path);
    const auto next = path_.point_at(over.place, along);
    if (over.grazing) {
      note(SpecialPointType::grazing, *next);
      curve().events.back().turns = turns;
    }
    if (behind > most_impacts) curve().status = SweepStatus::lost;
    // With an impact more the multipliers are infinite there.
    go_on_from(next, behind < before ? multipliers_of(*next) : Eigen::VectorXcd());
    step_ = std::min(step_, options().first_step);
  }

  double operations_of(const CurvePoint& point) const override {
    return exact_point_operations(point.motion, path_.family().dynamics());
  }

  bool same_unknowns(const CurvePoint& a, const CurvePoint& b) const override {
    return contacts_of(a.motion.impacts) == contacts_of(b.motion.impacts);
  }

  // Whether motions of an even number of periods meet motions of half as many; beyond, they are shifted
  // copies.
  bool meets_half(const ImpactPoint& from, const ImpactPoint& to) const {
    return path_.scales.periods % 2 == 0 && from.displacement.size() % 4 == 0 &&
           difference_of_halves(from).dot(difference_of_halves(to)) < 0.0;
  }

  static constexpr double largest_turn = 0.35;
  ImpactCurvePath& path_;
};

// The first place, with its tangent towards options.to.
std::optional<ImpactPlace> first_place(ImpactCurvePath& path, const ExactSolution& first,
                                       const ExactCurveOptions& options) {
  std::optional<ImpactPlace> place = path.now->at_value(path.now->unknowns_of(first.impacts), options.from);
  if (!place || !place->solution.converged() ||
      !path.now->tangent_at(place->point, path.now->along_parameter(options.to > options.from)))
    return std::nullopt;
  return place;
}

// The motion over twice its period, one after the other.
std::vector<Impact> twice(const std::vector<Impact>& impacts) {
  std::vector<Impact> all;
  for (const double begin : {0.0, 0.5})
    for (Impact impact : impacts) {
      impact.time = begin + 0.5 * impact.time;
      all.push_back(impact);
    }
  return all;
}

// The forcing periods of a motion at a value; 0 if it does not belong to the family there.
int periods_of(const ProblemFamily& family, const ExactSolution& motion, double value) {
  constexpr double rounding = 1e-9;
  const double ratio = family.at(value).frequency / motion.frequency(), periods = std::round(ratio);
  return std::abs(ratio - periods) <= rounding * ratio ? int(periods) : 0;
}

}  // namespace

ExactCurve impact_curve(const ProblemFamily& family, const ExactSolution& first,
                        const ExactCurveOptions& options) {
  ExactCurve curve;
  const int periods = periods_of(family, first, options.from);
  ImpactCurvePath path(family, first, options, std::max(periods, 1));
  path.begin(options.from, first.impacts);
  std::optional<ImpactPlace> place;
  if (periods > 0) place = first_place(path, first, options);
  if (place)
    ImpactTracer(path, curve, path.point_at(std::move(*place), 0.0)).run();
  else
    curve.start = ExactStatus::not_found;
  return curve;
}

ExactCurve doubled_impacts(const ProblemFamily& family, const ExactEvent& event,
                           const ExactCurveOptions& options) {
  ImpactCurvePath path(family, event.motion, options, 2 * periods_of(family, event.motion, event.value));
  const std::vector<Impact> impacts = twice(event.motion.impacts);
  path.begin(event.value, impacts);
  ExactCurve curve;
  std::optional<ImpactPlace> place = path.now->at_value(path.now->unknowns_of(impacts), event.value);
  if (!place) return curve;
  place->point.displacement_tangent = path.now->curve().null_direction();
  place->point.parameter_tangent = 0.0;
  path.now->normalize(place->point);
  std::optional<ImpactPlace> first = path.now->ahead(place->point, options.first_step);
  if (first && first->solution.converged())
    ImpactTracer(path, curve, path.point_at(std::move(*first), 0.0)).run();
  return curve;
}

}  // namespace wavebalance::solvers::detail

#include "exact/curve_tracer.hpp"

#include <algorithm>
#include <cmath>

#include "collocation/collocation_refinement.hpp"
#include "linalg/multipliers.hpp"

namespace wavebalance::solvers::detail {

CurveTracer::CurveTracer(CurvePath& path, ExactCurve& curve, PointOnCurve first)
    : step_(path.options().first_step), path_(path), curve_(curve), first_(std::move(first)) {}

void CurveTracer::run() {
  accept(first_);
  while (curve_.status == SweepStatus::no_start) {
    if (static_cast<int>(curve_.points.size()) >= options().max_points ||
        operations_ > options().max_operations)
      curve_.status = SweepStatus::point_limit;
    else if (path_.goes_on(static_cast<int>(curve_.points.size()), points_.back()->value))
      advance();
    if (path_.cancelled()) curve_.status = SweepStatus::cancelled;
  }
  if (!turns_as_it_ends()) curve_.status = SweepStatus::lost;
}

// A curve that ends where it goes at first, or is closed, turns an even number of times, another one an odd
// one. Else a fold is missing.
bool CurveTracer::turns_as_it_ends() const {
  const auto turns = std::count_if(curve_.events.begin(), curve_.events.end(), [](const ExactEvent& event) {
    return event.type == SpecialPointType::fold || event.turns;
  });
  const bool back = (first_->slope > 0.0) != (options().to > options().from);
  if (curve_.status == SweepStatus::reached_end) return turns % 2 == (back ? 1 : 0);
  if (curve_.status == SweepStatus::returned) return turns % 2 == (back ? 0 : 1);
  return curve_.status != SweepStatus::closed || turns % 2 == 0;
}

bool CurveTracer::within(double value) const {
  return value >= std::min(behind(), options().to) && value <= std::max(behind(), options().to);
}

Eigen::VectorXcd CurveTracer::multipliers_of(const CurvePoint& point) const {
  return options().stability ? point.motion.multipliers() : Eigen::VectorXcd();
}

void CurveTracer::accept(PointOnCurve point) {
  constexpr std::size_t most = 4;
  ExactPoint& added = curve_.points.emplace_back();
  added.value = point->value;
  added.motion = point->motion;
  added.slope = point->slope;
  added.multipliers = multipliers_of(*point);
  added.unstable = count_outside(added.multipliers);
  multipliers_ = added.multipliers;
  operations_ += operations_of(*point);
  points_.push_back(std::move(point));
  if (points_.size() > most) points_.pop_front();
}

void CurveTracer::go_on_from(PointOnCurve point, Eigen::VectorXcd multipliers) {
  points_.assign(1, std::move(point));
  multipliers_ = std::move(multipliers);
}

void CurveTracer::append_changes(const CurvePoint&, std::vector<PlacedEvent>&) {}

void CurveTracer::note_events(const CurvePoint& next) {
  EventsBetween between = events_between(path_, *points_.back(), next, multipliers_, multipliers_of(next));
  append_changes(next, between.events);
  if (path_.cancelled()) return;  // some may be missing
  if (!between.explained) curve_.unexplained.push_back(curve_.points.size());
  std::stable_sort(
      between.events.begin(), between.events.end(),
      [](const PlacedEvent& a, const PlacedEvent& b) { return a.point->place < b.point->place; });
  for (const PlacedEvent& one : between.events)
    curve_.events.push_back({one.type, one.value, one.multiplier, one.point->motion, curve_.points.size()});
}

void CurveTracer::go_to(PointOnCurve next) {
  if (curve_.status == SweepStatus::closed) return;
  if (PointOnCurve again = first_between(*next)) {
    next = std::move(again);
    curve_.status = SweepStatus::closed;
  }
  note_events(*next);
  if (!path_.cancelled()) accept(std::move(next));
}

// The first point, where the curve comes back to it between its last point and the next one, which has the
// same unknowns.
PointOnCurve CurveTracer::first_between(const CurvePoint& next) const {
  constexpr double same = 1e-6;  // of the vibration; steps are longer
  constexpr std::size_t shortest = 4;
  const CurvePoint& last = *points_.back();
  const double before = last.value - first_->value, behind = next.value - first_->value;
  if (curve_.points.size() < shortest || before * behind > 0.0 || behind * first_->slope < 0.0 ||
      !same_unknowns(last, *first_))
    return nullptr;
  const auto away = [&](const CurvePoint& point) {
    return rms_of(point.displacement - first_->displacement);
  };
  if (away(last) > 2.0 * rms_of(next.displacement - last.displacement)) return nullptr;
  PointOnCurve again = zero_between(path_, last, next, last.slope * next.slope < 0.0,
                                    [this](const CurvePoint& point) { return point.value - first_->value; });
  if (!again || away(*again) > same * first_->vibration) return nullptr;
  return again;
}

void CurveTracer::note(SpecialPointType type, const CurvePoint& at) {
  const bool fold = type == SpecialPointType::fold;
  const auto multiplier =
      fold ? nearest(at.motion.multipliers(), 1.0) : std::complex<double>(missing, missing);
  curve_.events.push_back({type, at.value, multiplier, at.motion, curve_.points.size()});
}

SweepStatus CurveTracer::end_at(double value) const {
  return (value > behind()) == (options().to > options().from) && value != behind() ? SweepStatus::reached_end
                                                                                    : SweepStatus::returned;
}

void CurveTracer::end_before(const CurvePoint& next) {
  const SweepStatus status = end_at(next.value);
  const double limit = status == SweepStatus::reached_end ? options().to : behind();
  PointOnCurve last = zero_between(path_, *points_.back(), next, points_.back()->slope * next.slope < 0.0,
                                   [limit](const CurvePoint& point) { return point.value - limit; });
  curve_.status = last ? status : SweepStatus::lost;
  if (last) go_to(std::move(last));
}

bool CurveTracer::is_smooth() const {
  constexpr double sharper = 0.3;
  const std::size_t count = points_.size();
  return count > 1 && step_ > sharper * (points_[count - 1]->place - points_[count - 2]->place);
}

void CurveTracer::take(PointOnCurve next) {
  step_ = std::min(options().largest_step, step_ * growth_);
  if (within(next->value))
    go_to(std::move(next));
  else
    end_before(*next);
}

void CurveTracer::shorten_step() {
  step_ *= 0.5;
  if (step_ < options().smallest_step) curve_.status = SweepStatus::lost;
}

}  // namespace wavebalance::solvers::detail

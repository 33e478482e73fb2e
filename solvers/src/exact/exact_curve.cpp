#include "wavebalance/solvers/exact/exact_curve.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <stdexcept>
#include <string>

#include "exact/exact_events.hpp"
#include "exact/phase_switch.hpp"
#include "linalg/index.hpp"
#include "linalg/option_checks.hpp"
#include "phases/phase_motion_parts.hpp"
#include "phases/phase_newton.hpp"
#include "phases/phase_refinement.hpp"

namespace wavebalance::solvers {
namespace {

using detail::Held, detail::PathModel, detail::PathPoint, detail::Prediction, detail::Switch;

// Follows one curve: `points_` are the last ones with the same phases.
class Tracer {
 public:
  Tracer(PathModel& model, ExactCurve& curve, PathPoint first)
      : model_(model),
        options_(model.options()),
        curve_(curve),
        step_(options_.first_step),
        first_(std::move(first)) {}

  void run() {
    accept(first_);
    while (curve_.status == SweepStatus::no_start) {
      if (static_cast<int>(curve_.points.size()) >= options_.max_points ||
          operations_ > options_.max_operations)
        curve_.status = SweepStatus::point_limit;
      else if (model_.goes_on(static_cast<int>(curve_.points.size()), points_.back().value))
        advance();
      if (model_.cancelled()) curve_.status = SweepStatus::cancelled;
    }
    if (!turns_as_it_ends()) curve_.status = SweepStatus::lost;
  }

 private:
  // A curve that ends ahead or is closed turns an even number of times, one that returns an odd one. Else a
  // fold is missing.
  bool turns_as_it_ends() const {
    const auto folds = std::count_if(curve_.events.begin(), curve_.events.end(), [](const ExactEvent& event) {
      return event.type == SpecialPointType::fold;
    });
    if (curve_.status == SweepStatus::reached_end || curve_.status == SweepStatus::closed)
      return folds % 2 == 0;
    return curve_.status != SweepStatus::returned || folds % 2 == 1;
  }

  bool within(double value) const {
    return value >= std::min(behind(), options_.to) && value <= std::max(behind(), options_.to);
  }

  double behind() const { return options_.behind > 0.0 ? options_.behind : options_.from; }

  void advance() {
    std::optional<Switch> vanishes = detail::disappearance(model_, points_.back());
    if (vanishes && within(vanishes->grazing.value)) {
      go_over(std::move(*vanishes));
      return;
    }
    std::optional<PathPoint> next = corrected();
    if (next && !next->agrees) {
      if (std::optional<Switch> over = detail::appearance(model_, points_.back(), *next)) {
        if (within(over->grazing.value))
          go_over(std::move(*over));
        else
          end_before(over->grazing);
        return;
      }
      next.reset();
    }
    if (!next) {
      step_ *= 0.5;
      if (step_ < options_.smallest_step) curve_.status = SweepStatus::lost;
      return;
    }
    step_ = std::min(options_.largest_step, step_ * growth_);
    if (!within(next->value)) {
      end_before(*next);
      return;
    }
    go_to(std::move(*next));
  }

  // The next point, if it lies where it is expected.
  std::optional<PathPoint> corrected() {
    constexpr double sharper = 0.3;
    const PathPoint& last = points_.back();
    // Where the curve has become sharper than its last steps are long, their polynomial says nothing.
    if (points_.size() > 1 && step_ > sharper * (last.place - points_[points_.size() - 2].place)) {
      Prediction expected = detail::through(neighbours(), last.place + step_);
      if (last.passages() == 0 || model_.cosine(last, expected) > least_cosine)
        return near(std::move(expected));
    }
    // A tangent says how forces, instants and the parameter change, and not by how much the displacement
    // does.
    const double speed = model_.speed(last);
    std::optional<PathPoint> next = near(detail::along_tangent(last, step_, speed));
    if (!next && arc_ > step_) next = near(detail::along_tangent(last, step_ * step_ / arc_, speed));
    return next;
  }

  // The solution near a prediction. Sets arc_, its distance from the last point; 0 where there is none.
  std::optional<PathPoint> near(Prediction expected) {
    constexpr double close = 0.05, farthest = 0.25, longest = 2.5;
    const PathPoint& last = points_.back();
    arc_ = 0.0;
    if (!(expected.value > 0.0) || shrinks(last.iterate.layout, expected.iterate.layout)) return std::nullopt;
    const Held held = model_.fastest(last, true);
    if (held.kind != Held::Kind::force) expected.iterate = model_.coarser(last, std::move(expected.iterate));
    std::optional<PathPoint> next =
        model_.solve(expected.value, expected.iterate, held, model_.sign_of(last, held));
    if (!next) return std::nullopt;
    const double off = model_.distance(expected, *next);
    arc_ = model_.arc_length(last, *next);
    if (off > farthest * step_ || arc_ > longest * step_) return std::nullopt;
    // The unknown held says the direction where it changes all the way. The way itself says it always.
    const double ahead = next->passages() > 0 ? model_.cosine(last, *next) : 1.0;
    if (std::abs(ahead) < least_cosine) return std::nullopt;
    if (ahead < 0.0) next->direction = -next->direction;
    growth_ = off < close * step_ ? 1.5 : 1.0;
    next->place = last.place + arc_;
    return next;
  }

  // Whether an interval would lose more than half of its length.
  static bool shrinks(const detail::Layout& layout, const detail::Layout& next) {
    for (const detail::Interval& interval : detail::intervals_of(layout)) {
      const auto moved = [&](int i) {
        const auto at = static_cast<std::size_t>(i);
        return next.passages[at].time - layout.passages[at].time;
      };
      if (moved(interval.from) - moved(interval.to) > 0.5 * interval.length) return true;
    }
    return false;
  }

  std::vector<const PathPoint*> neighbours() const {
    std::vector<const PathPoint*> all;
    for (const PathPoint& point : points_) all.push_back(&point);
    return all;
  }

  Eigen::VectorXcd multipliers_of(const PathPoint& point) const {
    return options_.stability ? point.motion.multipliers() : Eigen::VectorXcd();
  }

  void accept(PathPoint point) {
    constexpr std::size_t most = 4;
    ExactPoint& added = curve_.points.emplace_back();
    added.value = point.value;
    added.motion = point.motion;
    added.slope = point.slope() / model_.speed(point);
    added.multipliers = multipliers_of(point);
    added.unstable = detail::unstable_of(added.multipliers);
    operations_ += exact_point_operations(point.motion, model_.family().dynamics());
    points_.push_back(std::move(point));
    if (points_.size() > most) points_.pop_front();
  }

  void note_events(const PathPoint& next) {
    detail::EventsBetween between = detail::events_between(
        model_, points_.back(), next, curve_.points.back().multipliers, multipliers_of(next));
    if (model_.cancelled()) return;  // some may be missing
    if (!between.explained) curve_.unexplained.push_back(curve_.points.size());
    for (ExactEvent& event : between.events) {
      event.next_point = curve_.points.size();
      curve_.events.push_back(std::move(event));
    }
  }

  void go_to(PathPoint next) {
    if (curve_.status == SweepStatus::closed) return;
    if (std::optional<PathPoint> again = first_between(next)) {
      next = std::move(*again);
      curve_.status = SweepStatus::closed;
    }
    note_events(next);
    if (!model_.cancelled()) accept(std::move(next));
  }

  // The first point, where the curve comes back to it between its last point and the next one, which has the
  // same phases.
  std::optional<PathPoint> first_between(const PathPoint& next) const {
    constexpr double same = 1e-6;  // of the vibration; steps are longer
    constexpr std::size_t shortest = 4;
    const PathPoint& last = points_.back();
    const double before = last.value - first_.value, behind = next.value - first_.value;
    if (curve_.points.size() < shortest || before * behind > 0.0 || behind * first_.slope() < 0.0 ||
        last.passages() != first_.passages())
      return std::nullopt;
    const auto away = [&](const PathPoint& point) {
      return detail::rms_of(point.displacement - first_.displacement);
    };
    if (away(last) > 2.0 * detail::rms_of(next.displacement - last.displacement)) return std::nullopt;
    std::optional<PathPoint> again =
        detail::zero_between(model_, last, next, model_.fastest(last, true),
                             [this](const PathPoint& point) { return point.value - first_.value; });
    if (!again || away(*again) > same * first_.vibration) return std::nullopt;
    return again;
  }

  void note(SpecialPointType type, const PathPoint& at) {
    const bool fold = type == SpecialPointType::fold;
    const auto multiplier =
        fold ? detail::nearest(at.motion.multipliers(), 1.0) : std::complex<double>(missing, missing);
    curve_.events.push_back({type, at.value, multiplier, at.motion, curve_.points.size()});
  }

  SweepStatus end_at(double value) const {
    return (value > behind()) == (options_.to > options_.from) && value != behind() ? SweepStatus::reached_end
                                                                                    : SweepStatus::returned;
  }

  void go_over(Switch over) {
    if (over.appears) {
      note_events(over.grazing);
      over.between.push_back(std::move(over.next));
      over.next = std::move(over.between.front());
      over.between.erase(over.between.begin());
    } else {
      for (PathPoint& point : over.between) go_to(std::move(point));
      over.between.clear();
    }
    if (model_.cancelled()) return;
    if (over.reverses && !over.appears) note(SpecialPointType::fold, over.grazing);
    note(SpecialPointType::grazing, over.grazing);
    if (over.reverses && over.appears) note(SpecialPointType::fold, over.grazing);
    points_.clear();
    step_ = std::min(step_, options_.first_step);
    accept(std::move(over.next));
    for (PathPoint& point : over.between) go_to(std::move(point));
  }

  void end_before(const PathPoint& next) {
    const SweepStatus status = end_at(next.value);
    const double limit = status == SweepStatus::reached_end ? options_.to : behind();
    std::optional<PathPoint> last =
        detail::zero_between(model_, points_.back(), next, model_.fastest(points_.back(), true),
                             [limit](const PathPoint& point) { return point.value - limit; });
    curve_.status = last ? status : SweepStatus::lost;
    if (last) go_to(std::move(*last));
  }

  // Of the angles between the directions of two points and the way from one to the other.
  static constexpr double least_cosine = 0.3;

  PathModel& model_;
  const ExactCurveOptions& options_;
  ExactCurve& curve_;
  double step_, growth_ = 1.5, arc_ = 0.0, operations_ = 0.0;
  const PathPoint first_;
  std::deque<PathPoint> points_;
};

}  // namespace

void ExactCurveOptions::validate() const {
  phases.validate();
  detail::require_positive("exact_curve", "from", from);
  detail::require_positive("exact_curve", "to", to);
  if (from == to) throw std::invalid_argument("exact_curve: from and to are the same");
  if (behind != 0.0) detail::require_positive("exact_curve", "behind", behind);
  if (behind != 0.0 && behind != from && (behind > from) == (to > from))
    throw std::invalid_argument("exact_curve: behind is on the side of to; it must be on the other one");
  if (!(parameter_scale >= 0.0)) detail::require_positive("exact_curve", "parameter_scale", parameter_scale);
  detail::require_positive("exact_curve", "first_step", first_step);
  detail::require_positive("exact_curve", "largest_step", largest_step);
  detail::require_positive("exact_curve", "smallest_step", smallest_step);
  detail::require_at_least("exact_curve", "max_points", max_points, 1);
  if (!(max_operations > 0.0))
    detail::reject("exact_curve", "max_operations", max_operations, "a number above 0");
}

double exact_point_operations(const PhaseMotion& motion, const ContactDynamics& dynamics) {
  constexpr double of_motion = 8.0, of_multipliers = 25.0;
  const double n = motion.unknowns, s = double(dynamics.poles().size());
  return of_motion * detail::step_operations(n, s) + of_multipliers * s * s * s;
}

ExactCurve exact_curve(const PhaseFamily& family, const PhaseMotion& first,
                       const ExactCurveOptions& options) {
  options.validate();
  if (first.parts == nullptr)
    throw std::invalid_argument("exact_curve: first has the status " + std::string(to_string(first.status)) +
                                "; it must be a motion");
  ExactCurve curve;
  PathModel model(family, first, options);
  std::optional<PathPoint> start =
      model.solve(options.from, first.parts->iterate, Held{}, options.to > options.from ? 1.0 : -1.0);
  if (model.cancelled()) curve.status = SweepStatus::cancelled;
  if (start && start->agrees)
    Tracer(model, curve, std::move(*start)).run();
  else
    curve.start = PhasesStatus::not_found;
  return curve;
}

}  // namespace wavebalance::solvers

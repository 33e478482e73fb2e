#include "wavebalance/solvers/exact/exact_curve.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "collocation/collocation_newton.hpp"
#include "collocation/collocation_refinement.hpp"
#include "collocation/exact_solution_parts.hpp"
#include "exact/curve_tracer.hpp"
#include "exact/impact_curve.hpp"
#include "exact/interval_switch.hpp"
#include "exact/map_curve.hpp"
#include "linalg/index.hpp"
#include "linalg/option_checks.hpp"

namespace wavebalance::solvers {
namespace {

using detail::CurvePoint, detail::Held, detail::PathModel, detail::PathPoint, detail::PointOnCurve,
    detail::Prediction, detail::Switch;

// Follows a curve by contact intervals.
class IntervalTracer : public detail::CurveTracer {
 public:
  IntervalTracer(PathModel& model, ExactCurve& curve, PathPoint first)
      : CurveTracer(model, curve, std::make_shared<PathPoint>(std::move(first))), model_(model) {}

 private:
  void advance() override {
    std::optional<Switch> vanishes = detail::disappearance(model_, last());
    if (vanishes && within(vanishes->grazing.value)) {
      go_over(std::move(*vanishes));
      return;
    }
    std::optional<PathPoint> next = corrected();
    if (next && !next->agrees) {
      if (std::optional<Switch> over = detail::appearance(model_, last(), *next)) {
        if (within(over->grazing.value))
          go_over(std::move(*over));
        else
          end_before(over->grazing);
        return;
      }
      next.reset();
    }
    if (!next) return shorten_step();
    take(shared(std::move(*next)));
  }

  double operations_of(const CurvePoint& point) const override {
    return exact_point_operations(point.motion, model_.family().dynamics());
  }

  bool same_unknowns(const CurvePoint& a, const CurvePoint& b) const override {
    return static_cast<const PathPoint&>(a).passages() == static_cast<const PathPoint&>(b).passages();
  }

  static PointOnCurve shared(PathPoint point) { return std::make_shared<PathPoint>(std::move(point)); }
  const PathPoint& last() { return static_cast<const PathPoint&>(*points().back()); }

  // The next point, if it lies where it is expected.
  std::optional<PathPoint> corrected() {
    const PathPoint& last = this->last();
    // Where the curve has become sharper than its last steps are long, their polynomial predicts nothing.
    if (is_smooth()) {
      Prediction expected = detail::through(neighbours(), last.place + step_);
      if (last.passages() == 0 || model_.cosine(last, expected) > least_cosine)
        return near(std::move(expected));
    }
    // A tangent has the changes of forces, instants and the parameter, not of the displacement.
    const double speed = model_.speed(last);
    std::optional<PathPoint> next = near(detail::along_tangent(last, step_, speed));
    if (!next && arc_ > step_) next = near(detail::along_tangent(last, step_ * step_ / arc_, speed));
    return next;
  }

  // The solution near a prediction. Sets arc_, its distance from the last point; 0 where there is none.
  std::optional<PathPoint> near(Prediction expected) {
    const PathPoint& last = this->last();
    arc_ = 0.0;
    if (!(expected.value > 0.0) || shrinks(last.iterate.layout, expected.iterate.layout)) return std::nullopt;
    const Held held = model_.fastest(last, true);
    if (held.kind != Held::Kind::force) expected.iterate = model_.coarser(last, std::move(expected.iterate));
    std::optional<PathPoint> next =
        model_.solve(expected.value, expected.iterate, held, model_.sign_of(last, held));
    if (!next) return std::nullopt;
    arc_ = model_.arc_length(last, *next);
    // The fixed unknown gives the direction if it changes monotonically. The secant always does.
    const double ahead = next->passages() > 0 ? model_.cosine(last, *next) : 1.0;
    if (!fits(*next, model_.distance(expected, *next), arc_, ahead)) return std::nullopt;
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

  std::vector<const PathPoint*> neighbours() {
    std::vector<const PathPoint*> all;
    for (const PointOnCurve& point : points()) all.push_back(static_cast<const PathPoint*>(point.get()));
    return all;
  }

  void go_over(Switch over) {
    if (over.appears) {
      note_events(over.grazing);
      over.between.push_back(std::move(over.next));
      over.next = std::move(over.between.front());
      over.between.erase(over.between.begin());
    } else {
      for (PathPoint& point : over.between) go_to(shared(std::move(point)));
      over.between.clear();
    }
    if (model_.cancelled()) return;
    if (over.reverses && !over.appears) note(SpecialPointType::fold, over.grazing);
    note(SpecialPointType::grazing, over.grazing);
    if (over.reverses && over.appears) note(SpecialPointType::fold, over.grazing);
    points().clear();
    step_ = std::min(step_, options().first_step);
    accept(shared(std::move(over.next)));
    for (PathPoint& point : over.between) go_to(shared(std::move(point)));
  }

  PathModel& model_;
  double arc_ = 0.0;
};

// Whether it is one of impact_motion().
bool is_of_impacts(const ProblemFamily& family, const ExactSolution& motion) {
  return motion.parts != nullptr && !motion.parts->start && motion.intervals.empty() &&
         family.laws().have_impacts_alone(family.dynamics().contacts());
}

}  // namespace

void ExactCurveOptions::validate() const {
  exact.validate();
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

double exact_point_operations(const ExactSolution& motion, const ContactDynamics& dynamics) {
  constexpr double of_motion = 8.0, of_multipliers = 25.0;
  const double n = motion.unknowns, s = double(dynamics.poles().size());
  return of_motion * detail::step_operations(n, s) + of_multipliers * s * s * s;
}

ExactCurve exact_curve(const ProblemFamily& family, const ExactSolution& first,
                       const ExactCurveOptions& options) {
  options.validate();
  if (first.parts == nullptr)
    throw std::invalid_argument("exact_curve: first has the status " + std::string(to_string(first.status)) +
                                "; it must be a motion");
  if (first.parts->start) return detail::map_curve(family, first, options);  // a motion of the flow
  if (is_of_impacts(family, first)) return detail::impact_curve(family, first, options);
  ExactCurve curve;
  PathModel model(family, first, options);
  std::optional<PathPoint> start =
      model.solve(options.from, first.parts->iterate, Held{}, options.to > options.from ? 1.0 : -1.0);
  if (model.cancelled()) curve.status = SweepStatus::cancelled;
  if (start && start->agrees)
    IntervalTracer(model, curve, std::move(*start)).run();
  else
    curve.start = ExactStatus::not_found;
  // A force of the velocity may vanish and begin anew within a contact, where the equations of collocation
  // have no switch.
  if (curve.status == SweepStatus::lost && family.laws().depend_on_velocity()) {
    ExactCurve other = detail::map_curve(family, first, options);
    if (!other.points.empty() && other.status != SweepStatus::lost) return other;
    if (other.status == SweepStatus::cancelled) curve.status = other.status;
  }
  return curve;
}

ExactCurve doubled_curve(const ProblemFamily& family, const ExactEvent& event,
                         const ExactCurveOptions& options) {
  options.validate();
  if (event.type != SpecialPointType::period_doubling || !is_of_impacts(family, event.motion))
    throw std::invalid_argument("doubled_curve: the event is no period doubling of motions of impacts alone");
  return detail::doubled_impacts(family, event, options);
}

}  // namespace wavebalance::solvers

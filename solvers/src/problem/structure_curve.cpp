#include "problem/structure_curve.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "wavebalance/solvers/problem/exact_along.hpp"

namespace wavebalance::solvers::detail {
namespace {

double relative_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() / std::max(b.norm(), 1e-300);
}

double vibration_of(const Eigen::MatrixXd& displacement) {
  return (displacement.colwise() - displacement.rowwise().mean()).norm();
}

// A motion of the structure from which a stretch is followed.
struct SegmentStart {
  double value = 0.0, direction = 1.0;
  ExactSolution motion;  // not converged where none was found

  bool exists() const { return motion.converged(); }
};

// How a curve has a motion between two of its points, to first order.
enum class Passing { never, along, against };

// Whether and how a curve passes a start: along or against its direction, which near a fold selects one
// branch. A static deflection does not make motions more alike.
Passing passing(const ExactCurve& curve, const SegmentStart& start) {
  constexpr double near = 0.1;
  if (!start.exists()) return Passing::never;
  const double value = start.value, rounding = 1e-9 * std::abs(value);
  const Eigen::MatrixXd there = start.motion.displacement(comparison_times());
  const double farthest = near * vibration_of(there);
  const auto beyond = [&](const ExactPoint& point) {
    return std::abs(point.value - value) > rounding ? point.value - value : 0.0;
  };
  Passing found = Passing::never;
  for (std::size_t i = 0; i + 1 < curve.points.size() && found != Passing::against; ++i) {
    const ExactPoint &a = curve.points[i], &b = curve.points[i + 1];
    if (beyond(a) * beyond(b) > 0.0 || a.value == b.value) continue;
    const double share = std::clamp((value - a.value) / (b.value - a.value), 0.0, 1.0);
    const Eigen::MatrixXd between = (1.0 - share) * a.motion.displacement(comparison_times()) +
                                    share * b.motion.displacement(comparison_times());
    if ((between - there).norm() < farthest)
      found = (b.value - a.value) * start.direction < 0.0 ? Passing::against : Passing::along;
  }
  return found;
}

bool has_multipliers(const ExactCurve& curve) {
  return std::all_of(curve.points.begin(), curve.points.end(),
                     [](const ExactPoint& point) { return point.unstable >= 0; });
}

// A curve along which the count of multipliers changes without a bifurcation or grazing point has more of
// these.
bool left_its_interval(const ExactCurve& curve) {
  return (curve.status == SweepStatus::reached_end || curve.status == SweepStatus::returned) &&
         curve.unexplained.empty();
}

}  // namespace

const Eigen::VectorXd& comparison_times() {
  static const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(64, 0.0, 1.0 - 1.0 / 64.0);
  return times;
}

bool is_same(const ExactEvent& a, const ExactEvent& b) {
  constexpr double of_value = 1e-7, of_motion = 1e-2;
  return a.type == b.type && std::abs(a.value - b.value) <= of_value * std::abs(b.value) &&
         relative_difference(a.motion.displacement(comparison_times()),
                             b.motion.displacement(comparison_times())) <= of_motion;
}

namespace {

// Events that are not there yet; `from_behind`: in the opposite order.
void add_events(std::vector<ExactEvent> more, bool from_behind, std::vector<ExactEvent>& events) {
  std::erase_if(more, [&](const ExactEvent& one) {
    return std::any_of(events.begin(), events.end(), [&](const auto& other) { return is_same(one, other); });
  });
  if (from_behind) std::reverse(more.begin(), more.end());
  std::move(more.begin(), more.end(), std::back_inserter(events));
}

// Follows the exact curve along one segment.
struct StructureCurve {
  ContactProblem& problem;
  const FrequencySweep& curve;
  const StructurePointsOptions& options;
  CurveEffort effort;
  const Observer& observer;

  // The motion near the first point of the curve from an end of the segment outwards that has one: near a
  // fold several points are beyond the exact fold.
  SegmentStart start_of(const CurveSegment& stretch, bool forwards) const {
    constexpr double clear = 0.02;  // of a step near zigzags of the samples
    ExactAlongOptions near;
    near.exact = options.exact;
    near.max_distance = options.max_distance;
    SegmentStart start;
    for (const std::size_t steps : {0, 1, 3, 6}) {
      if (forwards ? stretch.first < steps : stretch.last + steps >= curve.points.size()) break;
      const std::size_t at = forwards ? stretch.first - steps : stretch.last + steps;
      start.value = parameter_of(curve.points[at], curve.parameter);
      start.direction = direction_from(curve, at, forwards, clear * unit_of_parameter(options));
      const PeriodicResponse response = problem.response(curve, start.value, curve.points[at].unknown);
      start.motion = exact_near(problem, response, near).value().motion;
      if (start.motion.status != ExactStatus::not_found) break;  // elsewhere it needs as much
    }
    return start;
  }

  ExactCurve followed(ValueRange range, const SegmentStart& start) const {
    constexpr double fewest = 8.0;
    if (!start.exists() || effort.points < fewest) return {};
    const ContactDynamics& dynamics = *problem.dynamics();
    if (fewest * exact_point_operations(start.motion, dynamics) > effort.operations) return {};
    const double lowest = std::min(range.low, start.value), highest = std::max(range.high, start.value);
    ExactCurveOptions how;
    how.from = start.value;
    how.to = start.direction > 0.0 ? highest : lowest;
    how.behind = start.direction > 0.0 ? lowest : highest;
    if (how.to == start.value) return {};
    how.parameter_scale = unit_of_parameter(options);
    how.first_step = options.first_step;
    how.largest_step = options.largest_step;
    how.max_points = static_cast<int>(effort.points);
    how.max_operations = effort.operations;
    how.exact = options.exact;
    how.observer = observer;
    return exact_curve({problem.condensed(), problem.laws(), dynamics, curve.parameter}, start.motion, how);
  }

  // A little wider than the segment, because exact folds are shifted against the balance's.
  ValueRange wider(const CurveSegment& stretch) const {
    const auto [low, high] = values_on(curve, stretch.first, stretch.last);
    const double margin = std::max(high - low, unit_of_parameter(options));
    return {std::max(std::min(options.from, options.to), low - margin),
            std::min(std::max(options.from, options.to), high + margin)};
  }
};

}  // namespace

// A curve followed only from the first point is complete if it leaves the interval. Otherwise it has to
// pass the other end.
OnSegment structure_along(ContactProblem& problem, const FrequencySweep& curve, const CurveSegment& stretch,
                          bool whole, const StructurePointsOptions& options, CurveEffort effort,
                          const Observer& observer) {
  const StructureCurve structure{problem, curve, options, effort, observer};
  const ValueRange range =
      whole ? ValueRange{std::min(options.from, options.to), std::max(options.from, options.to)}
            : structure.wider(stretch);
  OnSegment result;
  const SegmentStart start = structure.start_of(stretch, true);
  const ExactCurve forwards = structure.followed(range, start);
  add_events(forwards.events, false, result.events);
  result.cancelled = forwards.status == SweepStatus::cancelled;
  result.exhausted = forwards.status == SweepStatus::point_limit;
  result.with_multipliers = !forwards.points.empty() && has_multipliers(forwards);
  if (result.cancelled) return result;
  const SegmentStart end = structure.start_of(stretch, false);
  const Passing of_end = passing(forwards, end);
  const bool first_left = whole && left_its_interval(forwards);
  result.complete = (of_end == Passing::against && forwards.unexplained.empty()) || first_left;
  if (of_end == Passing::against || (first_left && (!end.exists() || of_end == Passing::along)))
    return result;
  const ExactCurve backwards = structure.followed(range, end);
  add_events(backwards.events, true, result.events);
  result.cancelled = backwards.status == SweepStatus::cancelled;
  result.exhausted = result.exhausted || backwards.status == SweepStatus::point_limit;
  result.with_multipliers = result.with_multipliers && has_multipliers(backwards);
  const Passing of_start = passing(backwards, start);
  result.complete = result.complete || (of_start == Passing::against && left_its_interval(backwards));
  result.apart = first_left && left_its_interval(backwards) && of_start == Passing::never;
  return result;
}

bool lies_on(ContactProblem& problem, const FrequencySweep& curve, const ExactEvent& event, double scale,
             double reach) {
  const Eigen::MatrixXd there = event.motion.displacement(comparison_times());
  const double vibration = vibration_of(there);
  return std::any_of(curve.points.begin(), curve.points.end(), [&](const SweepPoint& point) {
    const double value = parameter_of(point, curve.parameter), off = (value - event.value) / scale;
    if (!(std::abs(off) <= reach)) return false;
    const PeriodicResponse response = problem.response(curve, value, point.unknown);
    const Eigen::MatrixXd here =
        problem.motion(response, static_cast<int>(comparison_times().size())).displacement;
    return std::hypot(off, (here - there).norm() / vibration) <= reach;
  });
}

}  // namespace wavebalance::solvers::detail

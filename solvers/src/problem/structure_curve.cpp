#include "problem/structure_curve.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "wavebalance/solvers/problem/phases_along.hpp"

namespace wavebalance::solvers::detail {
namespace {

double relative_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() / std::max(b.norm(), 1e-300);
}

double vibration_of(const Eigen::MatrixXd& displacement) {
  return (displacement.colwise() - displacement.rowwise().mean()).norm();
}

// How a curve has a motion between two of its points, to first order.
enum class Passing { never, along, against };

// How it has that of a start: along or against its direction, which beside a fold is that of one branch. A
// static deflection does not make motions more alike.
Passing passing(const ExactCurve& curve, const StretchStart& start) {
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

// A curve along which the count of multipliers changes without a special point has more of these.
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

void OnStretch::add(std::vector<ExactEvent> more, bool from_behind) {
  std::erase_if(more, [&](const ExactEvent& one) {
    return std::any_of(events.begin(), events.end(), [&](const auto& other) { return is_same(one, other); });
  });
  if (from_behind) std::reverse(more.begin(), more.end());
  std::move(more.begin(), more.end(), std::back_inserter(events));
}

OnStretch StructureCurve::along(const Stretch& stretch) const {
  return from_both_ends(stretch, wider(stretch), false);
}

OnStretch StructureCurve::along_whole(const Stretch& all) const {
  return from_both_ends(all, {std::min(options_.from, options_.to), std::max(options_.from, options_.to)},
                        true);
}

// `first_decides`: what is followed from the first point alone is complete where it leaves the interval.
// Otherwise it has to come past the other end.
OnStretch StructureCurve::from_both_ends(const Stretch& stretch, ValueRange range, bool first_decides) const {
  OnStretch result;
  const StretchStart start = start_of(stretch, true);
  const ExactCurve forwards = followed(range, start);
  result.add(forwards.events, false);
  result.cancelled = forwards.status == SweepStatus::cancelled;
  result.with_multipliers = !forwards.points.empty() && has_multipliers(forwards);
  if (result.cancelled) return result;
  const StretchStart end = start_of(stretch, false);
  const Passing of_end = passing(forwards, end);
  const bool first_left = first_decides && left_its_interval(forwards);
  result.complete = (of_end == Passing::against && forwards.unexplained.empty()) || first_left;
  if (of_end == Passing::against || (first_left && (!end.exists() || of_end == Passing::along)))
    return result;
  const ExactCurve backwards = followed(range, end);
  result.add(backwards.events, true);
  result.cancelled = backwards.status == SweepStatus::cancelled;
  result.with_multipliers = result.with_multipliers && has_multipliers(backwards);
  const Passing of_start = passing(backwards, start);
  result.complete = result.complete || (of_start == Passing::against && left_its_interval(backwards));
  result.apart = first_left && left_its_interval(backwards) && of_start == Passing::never;
  return result;
}

// The motion near the first point of the curve from an end of the stretch outwards that has one: near a fold
// several points lie beyond that of the structure.
StretchStart StructureCurve::start_of(const Stretch& stretch, bool forwards) const {
  constexpr double clear = 0.02;  // of a step beside zigzags of the samples
  CurvePhasesOptions near;
  near.phases = options_.phases;
  near.max_distance = options_.max_distance;
  StretchStart start;
  for (const std::size_t steps : {0, 1, 3, 6}) {
    if (forwards ? stretch.first < steps : stretch.last + steps >= curve_.points.size()) break;
    const std::size_t at = forwards ? stretch.first - steps : stretch.last + steps;
    start.value = parameter_of(curve_.points[at], curve_.parameter);
    start.direction = direction_from(curve_, at, forwards, clear * unit_of_parameter(options_));
    const PeriodicResponse response = problem_.response(curve_, start.value, curve_.points[at].unknown);
    start.motion = near_phases(problem_, response, near).value().motion;
    if (start.motion.status != PhasesStatus::not_found) break;  // elsewhere it takes as much
  }
  return start;
}

ExactCurve StructureCurve::followed(ValueRange range, const StretchStart& start) const {
  constexpr double fewest = 8.0;
  if (!start.exists() || effort_.points < fewest) return {};
  const ContactDynamics& dynamics = *problem_.dynamics();
  if (fewest * exact_point_operations(start.motion, dynamics) > effort_.operations) return {};
  const double lowest = std::min(range.low, start.value), highest = std::max(range.high, start.value);
  ExactCurveOptions options;
  options.from = start.value;
  options.to = start.direction > 0.0 ? highest : lowest;
  options.behind = start.direction > 0.0 ? lowest : highest;
  if (options.to == start.value) return {};
  options.parameter_scale = unit_of_parameter(options_);
  options.first_step = options_.first_step;
  options.largest_step = options_.largest_step;
  options.max_points = static_cast<int>(effort_.points);
  options.max_operations = effort_.operations;
  options.phases = options_.phases;
  options.observer = observer_;
  return exact_curve({problem_.condensed(), problem_.laws(), dynamics, curve_.parameter}, start.motion,
                     options);
}

// A little wider than the stretch, since the structure's folds lie beside those of the balance.
ValueRange StructureCurve::wider(const Stretch& stretch) const {
  const auto [low, high] = values_on(curve_, stretch.first, stretch.last);
  const double margin = std::max(high - low, unit_of_parameter(options_));
  return {std::max(std::min(options_.from, options_.to), low - margin),
          std::min(std::max(options_.from, options_.to), high + margin)};
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

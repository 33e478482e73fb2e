#include "problem/curve_segments.hpp"

#include <algorithm>
#include <cmath>

namespace wavebalance::solvers::detail {

CurveDistance::CurveDistance(const FrequencySweep& curve, double scale)
    : parameter_(curve.parameter), scale_(scale), largest_(0.0) {
  for (const SweepPoint& point : curve.points) largest_ = std::max(largest_, point.max_abs_displacement);
}

double CurveDistance::between(const SpecialPoint& a, double value, double max_abs_displacement) const {
  const double change = parameter_of(a, parameter_) - value;
  const double moved = a.max_abs_displacement - max_abs_displacement;
  return std::hypot(change / scale_, largest_ > 0.0 ? moved / largest_ : 0.0);
}

namespace {

constexpr std::size_t least_points_beside = 3;

CurveSegment segment_about(const FrequencySweep& curve, const SpecialPoint& point,
                           const CurveDistance& distance, double reach) {
  const std::size_t count = curve.points.size(), next = std::min(point.next_point, count - 1);
  CurveSegment stretch{next > 0 ? next - 1 : 0, next, {}};
  const auto ends = [&](std::size_t at, std::size_t steps) {
    const SweepPoint& there = curve.points[at];
    return steps >= least_points_beside &&
           distance.between(point, parameter_of(there, curve.parameter), there.max_abs_displacement) > reach;
  };
  for (std::size_t steps = 1; stretch.first > 0 && !ends(stretch.first, steps); ++steps) --stretch.first;
  for (std::size_t steps = 1; stretch.last + 1 < count && !ends(stretch.last, steps); ++steps) ++stretch.last;
  return stretch;
}

void leave_out(std::vector<CurveSegment>& stretches, const std::vector<SpecialPoint>& points,
               std::size_t most) {
  if (stretches.size() <= most) return;
  std::stable_partition(stretches.begin(), stretches.end(), [&](const CurveSegment& stretch) {
    return std::any_of(stretch.points.begin(), stretch.points.end(),
                       [&](std::size_t i) { return points[i].type != SpecialPointType::grazing; });
  });
  stretches.resize(most);
  std::sort(stretches.begin(), stretches.end(),
            [](const CurveSegment& a, const CurveSegment& b) { return a.first < b.first; });
}

}  // namespace

std::vector<CurveSegment> segments_about(const FrequencySweep& curve, const std::vector<SpecialPoint>& points,
                                         const CurveDistance& distance, double reach, std::size_t most,
                                         bool grazings) {
  std::vector<CurveSegment> all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!grazings && points[i].type == SpecialPointType::grazing) continue;
    all.push_back(segment_about(curve, points[i], distance, reach));
    all.back().points = {i};
  }
  std::sort(all.begin(), all.end(),
            [](const CurveSegment& a, const CurveSegment& b) { return a.first < b.first; });
  std::vector<CurveSegment> merged;
  for (CurveSegment& stretch : all) {
    if (merged.empty() || stretch.first > merged.back().last) {
      merged.push_back(std::move(stretch));
      continue;
    }
    merged.back().last = std::max(merged.back().last, stretch.last);
    merged.back().points.push_back(stretch.points.front());
  }
  leave_out(merged, points, most);
  return merged;
}

ValueRange values_on(const FrequencySweep& curve, std::size_t first, std::size_t last) {
  ValueRange range{parameter_of(curve.points[first], curve.parameter),
                   parameter_of(curve.points[first], curve.parameter)};
  for (std::size_t i = first; i <= last; ++i) {
    const double value = parameter_of(curve.points[i], curve.parameter);
    range = {std::min(range.low, value), std::max(range.high, value)};
  }
  return range;
}

double direction_from(const FrequencySweep& curve, std::size_t point, bool forwards, double least) {
  const double value = parameter_of(curve.points[point], curve.parameter);
  double change = 0.0;
  for (std::size_t i = point; std::abs(change) <= least;) {
    if (forwards ? i + 1 == curve.points.size() : i == 0) break;
    i = forwards ? i + 1 : i - 1;
    change = parameter_of(curve.points[i], curve.parameter) - value;
  }
  return change < 0.0 ? -1.0 : 1.0;
}

}  // namespace wavebalance::solvers::detail

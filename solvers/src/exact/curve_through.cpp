#include <algorithm>
#include <iterator>
#include <utility>

#include "response/both_ways.hpp"
#include "wavebalance/solvers/exact/exact_curve.hpp"

namespace wavebalance::solvers {
namespace {

// The same curve from its other end.
void reverse(ExactCurve& curve) {
  std::reverse(curve.points.begin(), curve.points.end());
  for (ExactPoint& point : curve.points) point.slope = -point.slope;
  std::reverse(curve.events.begin(), curve.events.end());
  for (ExactEvent& event : curve.events) event.next_point = curve.points.size() - event.next_point;
}

}  // namespace

ExactCurve exact_curve_through(const ProblemFamily& family, double value, const ExactSolution& motion,
                               const ExactCurveOptions& options) {
  options.validate();
  ExactCurveOptions one_way = options;
  one_way.from = value;
  one_way.behind = options.from;
  ExactCurve ahead = exact_curve(family, motion, one_way);
  if (ahead.points.empty() || ahead.status == SweepStatus::closed || ahead.status == SweepStatus::cancelled)
    return ahead;
  std::swap(one_way.behind, one_way.to);
  ExactCurve whole = exact_curve(family, motion, one_way);
  if (whole.points.empty()) return ahead;
  whole.status = detail::status_of_both(ahead.status, whole.status);
  reverse(whole);
  whole.points.pop_back();  // the first of both
  const std::size_t before = whole.points.size();
  for (ExactEvent& event : ahead.events) event.next_point += before;
  std::move(ahead.points.begin(), ahead.points.end(), std::back_inserter(whole.points));
  std::move(ahead.events.begin(), ahead.events.end(), std::back_inserter(whole.events));
  return whole;
}

}  // namespace wavebalance::solvers

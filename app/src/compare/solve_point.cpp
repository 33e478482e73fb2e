#include "wavebalance/app/compare/solve_point.hpp"

#include <iterator>

namespace wavebalance::app {

void mark_front(std::vector<SolvePoint>& points) {
  for (SolvePoint& point : points) {
    const auto beats = [&point](const SolvePoint& other) {
      return other.converged && other.seconds <= point.seconds && other.error <= point.error &&
             (other.seconds < point.seconds || other.error < point.error);
    };
    point.on_front = point.converged && std::ranges::none_of(points, beats);
  }
}

std::vector<SolvePoint> envelope(std::vector<SolvePoint> points) {
  mark_front(points);
  std::erase_if(points, [](const SolvePoint& point) { return !point.on_front; });
  std::ranges::sort(points, {}, &SolvePoint::seconds);
  return points;
}

std::vector<SolvePoint> points_of(const BasisPair& pair, const std::vector<SolvePoint>& points) {
  std::vector<SolvePoint> own;
  std::copy_if(points.begin(), points.end(), std::back_inserter(own), [&](const SolvePoint& point) {
    return point.method == (pair.is_exact() ? "phases" : "weighted_residual") && point.pair == pair;
  });
  return own;
}

}  // namespace wavebalance::app

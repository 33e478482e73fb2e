#include <algorithm>

#include "points.hpp"

namespace wavebalance::bench {

void mark_front(std::vector<Point>& points) {
  for (Point& point : points) {
    const auto beats = [&point](const Point& other) {
      return other.converged && other.seconds <= point.seconds && other.error <= point.error &&
             (other.seconds < point.seconds || other.error < point.error);
    };
    point.on_front = point.converged && std::none_of(points.begin(), points.end(), beats);
  }
}

std::vector<Point> envelope(std::vector<Point> points) {
  mark_front(points);
  std::erase_if(points, [](const Point& point) { return !point.on_front; });
  std::sort(points.begin(), points.end(),
            [](const Point& a, const Point& b) { return a.seconds < b.seconds; });
  return points;
}

}  // namespace wavebalance::bench

#include "plot/plot_parts.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace wavebalance::app {
namespace {

/// Distance of point i from the segment between points a and b.
double distance(const std::vector<double>& x, const std::vector<double>& y, std::size_t i, std::size_t a,
                std::size_t b) {
  const double dx = x[b] - x[a], dy = y[b] - y[a];
  const double square = dx * dx + dy * dy;
  const double along = square > 0.0 ? ((x[i] - x[a]) * dx + (y[i] - y[a]) * dy) / square : 0.0;
  const double share = std::clamp(along, 0.0, 1.0);
  return std::hypot(x[i] - x[a] - share * dx, y[i] - y[a] - share * dy);
}

/// Marks what is kept of the finite points first..last.
void keep(const std::vector<double>& x, const std::vector<double>& y, double tolerance, std::size_t first,
          std::size_t last, std::vector<bool>& kept) {
  kept[first] = kept[last] = true;
  std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
  while (!open.empty()) {
    const auto [a, b] = open.back();
    open.pop_back();
    std::size_t furthest = a;
    double largest = tolerance;
    for (std::size_t i = a + 1; i < b; ++i)
      if (const double d = distance(x, y, i, a, b); d > largest) {
        largest = d;
        furthest = i;
      }
    if (furthest == a) continue;
    kept[furthest] = true;
    open.push_back({a, furthest});
    open.push_back({furthest, b});
  }
}

}  // namespace

std::vector<std::size_t> kept_points(const std::vector<double>& x, const std::vector<double>& y,
                                     double tolerance) {
  std::vector<bool> kept(x.size(), false);
  const auto finite = [&](std::size_t i) { return std::isfinite(x[i]) && std::isfinite(y[i]); };
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!finite(i)) {
      kept[i] = i == 0 || finite(i - 1);
      continue;
    }
    const std::size_t first = i;
    while (i + 1 < x.size() && finite(i + 1)) ++i;
    keep(x, y, tolerance, first, i, kept);
  }
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < kept.size(); ++i)
    if (kept[i]) numbers.push_back(i);
  return numbers;
}

Series extremes_of_runs(const Series& series) {
  constexpr std::size_t runs = 2048;
  const std::size_t size = series.x.size();
  if (size <= 4 * runs) return series;
  Series result = series;
  result.x.clear();
  result.y.clear();
  for (std::size_t run = 0; run < runs; ++run) {
    const auto begin = series.y.begin() + static_cast<std::ptrdiff_t>(run * size / runs);
    const auto end = series.y.begin() + static_cast<std::ptrdiff_t>((run + 1) * size / runs);
    const auto [lowest, highest] = std::minmax_element(begin, end);
    const std::set kept{begin, std::min(lowest, highest), std::max(lowest, highest), end - 1};
    for (const auto at : kept) {
      result.x.push_back(series.x[static_cast<std::size_t>(at - series.y.begin())]);
      result.y.push_back(*at);
    }
  }
  return result;
}

}  // namespace wavebalance::app

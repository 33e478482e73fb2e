#include "outputs/peaks.hpp"

#include "wavebalance/solvers/response/curve_peak.hpp"

namespace wavebalance::app {
namespace {

/// The value at `at` of the polynomial through points, by Neville's scheme.
double interpolated(const std::vector<double>& lengths, std::span<const double> values, double at) {
  std::vector<double> table(values.begin(), values.end());
  for (std::size_t order = 1; order < table.size(); ++order)
    for (std::size_t i = 0; i + order < table.size(); ++i)
      table[i] = ((at - lengths[i + order]) * table[i] + (lengths[i] - at) * table[i + 1]) /
                 (lengths[i] - lengths[i + order]);
  return table.front();
}

double extent(std::span<const double> values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return std::max(*high - *low, 1e-300);
}

}  // namespace

std::optional<PolynomialPeak> polynomial_peak(std::span<const double> places, std::span<const double> heights,
                                              std::size_t index, std::size_t neighbours) {
  if (index < neighbours || index + neighbours >= places.size()) return std::nullopt;
  const auto x = places.subspan(index - neighbours, 2 * neighbours + 1),
             y = heights.subspan(index - neighbours, 2 * neighbours + 1);
  if (!std::ranges::all_of(y, [](double one) { return std::isfinite(one); })) return std::nullopt;
  std::vector<double> lengths{0.0};
  for (std::size_t i = 1; i < x.size(); ++i)
    lengths.push_back(lengths.back() +
                      std::hypot((x[i] - x[i - 1]) / extent(x), (y[i] - y[i - 1]) / extent(y)));
  // Heights relative to the point, in their range: absolute heights near a peak differ only by rounding.
  std::vector<double> above;
  for (const double one : y) above.push_back((one - heights[index]) / extent(y));
  constexpr double tolerance = 1e-6;
  const solvers::Maximum best = solvers::maximum_between(
      [&](double at) { return interpolated(lengths, above, at); }, lengths[neighbours - 1],
      lengths[neighbours], lengths[neighbours + 1], tolerance);
  if (!best.complete) return std::nullopt;
  return PolynomialPeak{interpolated(lengths, x, best.at), heights[index] + extent(y) * best.value};
}

}  // namespace wavebalance::app

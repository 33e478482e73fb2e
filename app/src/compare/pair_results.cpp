#include <fmt/format.h>

#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compare/comparison.hpp"

namespace wavebalance::app {
namespace {

/// Points over functions, rounded: an odd number of functions has as many points as the next even one.
int points_per_function(const SolvePoint& point) {
  return point.points / (point.functions + point.functions % 2);
}

/// The order of the last four errors above `least`, or NaN for fewer than three. `points` rise in functions.
double order_of(const std::vector<SolvePoint>& points, double SolvePoint::*error, double least) {
  std::vector<double> sizes, errors;
  for (const SolvePoint& point : points)
    if (point.converged && point.*error > least) {
      sizes.push_back(point.functions);
      errors.push_back(point.*error);
    }
  constexpr std::size_t most = 4, fewest = 3;
  if (sizes.size() < fewest) return solvers::missing;
  const std::size_t first = sizes.size() - std::min(most, sizes.size());
  return observed_order(std::span(sizes).subspan(first), std::span(errors).subspan(first));
}

void note_orders(PairResult& result, const std::vector<SolvePoint>& own, double reference_error) {
  // An even number of Fourier functions is a separate series; the odd one has no Nyquist coefficient.
  std::map<int, std::vector<SolvePoint>> series;
  for (const SolvePoint& point : own)
    if (!result.pair.is_fourier() || point.functions % 2 == 1)
      series[points_per_function(point)].push_back(point);
  const double least = std::max(2.0 * reference_error, 1e-12);
  for (auto at = series.rbegin(); at != series.rend() && !std::isfinite(result.order); ++at) {
    result.order = order_of(at->second, &SolvePoint::displacement_error, least);
    result.force_order = order_of(at->second, &SolvePoint::force_error, least);
    result.order_points_per_function = at->first;
  }
}

/// "2 stalled (4 to 8 functions)", by status.
std::string failures_of(const std::vector<SolvePoint>& own) {
  struct Failure {
    int count = 0, least = 0, most = 0;
  };
  std::map<std::string, Failure> failures;
  for (const SolvePoint& point : own) {
    if (point.converged) continue;
    Failure& one = failures[point.status];
    one.least = one.count == 0 ? point.functions : std::min(one.least, point.functions);
    one.most = std::max(one.most, point.functions);
    ++one.count;
  }
  std::string text;
  for (const auto& [status, one] : failures) {
    const std::string range =
        one.least == one.most ? std::to_string(one.most) : fmt::format("{} to {}", one.least, one.most);
    text += fmt::format("{}{} {} ({} functions)", text.empty() ? "" : ", ", one.count, status, range);
  }
  return text;
}

PairResult result_of(const BasisPair& pair, const std::vector<SolvePoint>& own, double reference_error) {
  PairResult result;
  result.pair = pair;
  for (const SolvePoint& point : own) {
    ++result.solves;
    result.largest_functions = std::max(result.largest_functions, point.functions);
    if (!point.converged) continue;
    ++result.converged;
    result.smallest_error = std::fmin(result.smallest_error, point.error);
  }
  if (!pair.is_exact()) note_orders(result, own, reference_error);
  result.failures = failures_of(own);
  return result;
}

}  // namespace

SplitPairs split_pairs(const Scene& scene, const ComparisonOptions& options) {
  if (!options.pairs.empty()) return {options.pairs, {}};
  SplitPairs split;
  for (const BasisPair& pair : common_pairs()) {
    const auto found = admissibility_of(pair, scene);
    if (found.admissible)
      split.admissible.push_back(pair);
    else
      split.others.push_back({.pair = pair, .inadmissible = found.reason});
  }
  return split;
}

std::vector<PairResult> pair_results(const std::vector<BasisPair>& pairs,
                                     const std::vector<SolvePoint>& points, double reference_error) {
  std::vector<PairResult> results;
  for (const BasisPair& pair : pairs) {
    std::vector<SolvePoint> own = points_of(pair, points);
    std::erase_if(own, [](const SolvePoint& point) { return point.status == "not_run"; });
    results.push_back(result_of(pair, own, reference_error));
  }
  return results;
}

}  // namespace wavebalance::app

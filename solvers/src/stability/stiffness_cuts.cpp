#include "stability/stiffness_cuts.hpp"

#include <algorithm>
#include <iterator>

namespace wavebalance::solvers::detail {
namespace {

constexpr std::ptrdiff_t most_cuts = 64;

// The levels of the curve at the breakpoints, ascending; in the force form those of v = u + flexibility f.
std::vector<double> levels(const ContactAlong& along) {
  const std::vector<double> all = along.law.breakpoints(), kinks = along.law.kinks();
  std::vector<double> result;
  std::set_difference(all.begin(), all.end(), kinks.begin(), kinks.end(), std::back_inserter(result));
  if (along.flexibility > 0.0)
    for (double& level : result) level += along.flexibility * along.law.force(level);
  return result;
}

}  // namespace

std::vector<double> cut_times(const ContactAlong& along) {
  const std::vector<double> at = levels(along);
  std::vector<double> times;
  if (at.empty()) return times;
  const Eigen::VectorXd& samples = along.curve.samples();
  const Eigen::Index count = samples.size();
  for (Eigen::Index l = 0; l < count; ++l) {
    const auto [low, high] = std::minmax(samples[l], samples[(l + 1) % count]);
    const auto first = std::lower_bound(at.begin(), at.end(), low);
    const auto last = std::lower_bound(first, at.end(), high);
    if (std::distance(first, last) + std::ptrdiff_t(times.size()) > most_cuts) return {};
    for (auto level = first; level != last; ++level) times.push_back(crossing(along.curve, *level, l));
  }
  return times;
}

}  // namespace wavebalance::solvers::detail

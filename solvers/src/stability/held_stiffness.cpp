#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "stability/smooth_pieces.hpp"

namespace wavebalance::solvers {
namespace {

// The intervals of one contact and those between them, by begin.
std::vector<ContactInterval> whole_period(int contact, std::vector<ContactInterval> own) {
  if (own.empty()) return {{contact, 0.0, 1.0}};
  const std::size_t count = own.size();
  for (std::size_t i = 0; i < count; ++i) {
    const double open = own[i].end, close = i + 1 < count ? own[i + 1].begin : own[0].begin + 1.0;
    if (close > open) own.push_back({contact, open - std::floor(open), close - std::floor(open)});
  }
  std::sort(own.begin(), own.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  return own;
}

}  // namespace

PeriodicStiffness held_stiffness(const PeriodicStiffness& stiffness, int contacts, double kappa) {
  if (kappa == 0.0 || stiffness.held || stiffness.status != StabilityStatus::converged) return stiffness;
  PeriodicStiffness held;
  held.held = true;
  held.cuts = stiffness.cuts;
  if (stiffness.needs_map()) {
    held.status =
        StabilityStatus::effort_limit;  // not of laws that depend on the velocity or of several rows
    return held;
  }
  for (int c = 0; c < contacts; ++c) {
    std::vector<ContactInterval> own;
    for (const ContactInterval& interval : stiffness.intervals)
      if (interval.contact == c) own.push_back(interval);
    for (const ContactInterval& interval : whole_period(c, std::move(own)))
      held.intervals.push_back(interval);
  }
  held.tangent = [stiffness, kappa](int contact, double time) {
    for (const ContactInterval& interval : stiffness.intervals)
      if (interval.contact == contact && lies_in(interval, time))
        return stiffness.tangent(contact, time) - kappa;
    return -kappa;
  };
  return held;
}

}  // namespace wavebalance::solvers

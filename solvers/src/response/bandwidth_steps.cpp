#include "response/bandwidth_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "structure/modal_form.hpp"

namespace wavebalance::solvers::detail {

std::optional<BandwidthSteps> BandwidthSteps::make(const CondensedProblem& problem, double interval) {
  constexpr int few = 400;                // degrees of freedom
  constexpr double shortest = 1.0 / 320;  // of the interval
  if (problem.structure().size() > few) return std::nullopt;
  const auto form = modal_form(problem.structure());
  if (!form) return std::nullopt;
  BandwidthSteps steps(shortest * interval);
  for (Eigen::Index k = 0; k < form->mass.size(); ++k) {
    const double m = form->mass[k], c = form->damping[k], stiffness = form->stiffness[k];
    if (!(m > 0.0 && c > 0.0 && stiffness > 0.0)) continue;
    steps.modes_.push_back(
        {std::sqrt(stiffness / m) / (2.0 * std::numbers::pi), 0.5 * c / std::sqrt(m * stiffness)});
  }
  return steps;
}

void BandwidthSteps::begin_at(double frequency, bool in_contact) {
  begin_ = frequency;
  longest_ = std::numeric_limits<double>::infinity();
  if (!in_contact) return;
  double least = std::numeric_limits<double>::infinity();
  for (const Mode& mode : modes_)
    if (mode.frequency >= frequency) least = std::min(least, mode.damping_ratio);
  constexpr double share = 0.5;  // of the bandwidth
  longest_ = std::max(least_, share * 2.0 * least * frequency);
}

bool BandwidthSteps::contains(double p) const {
  return frequency_.contains(p) && std::abs(p - begin_) <= longest_;
}

}  // namespace wavebalance::solvers::detail

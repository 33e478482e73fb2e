#include "period/repetition.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace wavebalance::solvers {
namespace {

constexpr int steady_periods = 16;

}  // namespace

void RepetitionRule::add_distances(std::vector<double> distances) {
  distances_.push_front(std::move(distances));
  const auto most = static_cast<std::size_t>(steady_periods + 2 * longest_);
  if (distances_.size() > most) distances_.pop_back();
  ++count_;
}

double RepetitionRule::change() const {
  if (distances_.empty() || distances_.front().empty()) return std::numeric_limits<double>::infinity();
  return distances_.front().front();
}

// Between any two of as many successive periods, the last of which was `before` periods ago.
double RepetitionRule::least_distance(int periods, int before) const {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < periods; ++i) {
    const std::vector<double>& distances = distances_[static_cast<std::size_t>(before + i)];
    for (int lag = 1; i + lag < periods; ++lag)
      least = std::min(least, distances[static_cast<std::size_t>(lag - 1)]);
  }
  return least;
}

// Whether the last of so many periods, which differ, are steady.
std::optional<Repetition> RepetitionRule::steady(int periods) const {
  constexpr int transient = 50;
  constexpr double apart = 100.0, steady = 1e-3;
  const int before = periods * ((steady_periods + periods - 1) / periods);
  if (count_ <= std::max(transient, before + periods)) return std::nullopt;
  const double now = least_distance(periods, 0), then = least_distance(periods, before),
               back = distances_.front()[static_cast<std::size_t>(periods - 1)];
  if (!(now > apart * back) || !(std::abs(now - then) <= steady * now)) return std::nullopt;
  return Repetition{periods, now};
}

Repetition RepetitionRule::found() const {
  if (distances_.empty()) return {};
  const std::vector<double>& last = distances_.front();
  for (int periods = 1; periods <= static_cast<int>(last.size()); ++periods) {
    if (!(last[static_cast<std::size_t>(periods - 1)] <= tolerance_)) continue;
    if (periods == 1) return {.periods = 1};
    if (const auto repeats = steady(periods)) return *repeats;
  }
  return {};
}

}  // namespace wavebalance::solvers

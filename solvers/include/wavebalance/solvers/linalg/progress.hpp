#pragma once
#include <functional>
#include <string_view>

#include "wavebalance/solvers/linalg/missing.hpp"

namespace wavebalance::solvers {

/// State of a long computation.
struct Progress {
  std::string_view phase;         ///< what is done: "Newton", "lowering the obstacle", "frequency sweep"
  int step = 0;                   ///< steps of this phase so far
  double value = missing;         ///< NaN when the phase has none
  std::string_view measure = {};  ///< what `value` is: "relative residual", "Hz"; empty when there is none
  /// Share of the whole work, 0..1; NaN when unknown.
  double done = missing;
};

/// Called repeatedly during long work; the texts live as long as the call. Returns false to stop the work,
/// whose status is then `cancelled`. An empty observer stops nothing.
using Observer = std::function<bool(const Progress&)>;

/// False when there is an observer and it returns false.
inline bool goes_on(const Observer& observer, const Progress& progress) {
  return !observer || observer(progress);
}

}  // namespace wavebalance::solvers

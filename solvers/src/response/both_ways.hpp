#pragma once
#include "wavebalance/solvers/response/frequency_sweep.hpp"

namespace wavebalance::solvers::detail {

inline bool left_interval(SweepStatus status) {
  return status == SweepStatus::reached_end || status == SweepStatus::returned;
}

/// A curve that was followed both ways from one point: ahead to the end of the interval, and behind to its
/// beginning.
inline SweepStatus status_of_both(SweepStatus ahead, SweepStatus behind) {
  if (!left_interval(ahead)) return ahead;
  if (!left_interval(behind)) return behind;
  return ahead == behind ? SweepStatus::reached_end : SweepStatus::returned;
}

}  // namespace wavebalance::solvers::detail

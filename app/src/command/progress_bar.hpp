#pragma once
#include <chrono>

#include "wavebalance/app/analysis/response.hpp"

namespace wavebalance::app {

/// Shows progress on standard error: one line that is overwritten on a terminal, a line at intervals
/// elsewhere. Work that is done within half a second shows nothing.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  void show(const Progress& progress);
  /// Clears the line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  bool terminal_;
  bool visible_ = false;
  Clock::time_point next_;
};

}  // namespace wavebalance::app

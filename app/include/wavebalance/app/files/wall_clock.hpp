#pragma once
#include <chrono>

namespace wavebalance::app {

/// Wall time since it was made, s.
class WallClock {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

}  // namespace wavebalance::app

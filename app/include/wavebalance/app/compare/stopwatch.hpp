#pragma once
#include <functional>

#include "wavebalance/app/files/wall_clock.hpp"

namespace wavebalance::app {

/// Processor seconds that this thread has used. Measured work runs in one thread, so other programs and
/// threads hardly affect it.
double processor_seconds();

struct Repetition {
  double budget = 0.02;      ///< s, no further call is started after it
  int least = 2;             ///< calls at least, unless the first takes more than `max_seconds`
  double max_seconds = 0.5;  ///< s
};

/// The least processor seconds of one call of `work` among those that fit into the budget.
double least_seconds(const std::function<void()>& work, const Repetition& repetition = {});

/// Decides from the times so far whether the next of a series of doubling sizes is run.
class TimeLimit {
 public:
  explicit TimeLimit(double limit) : limit_(limit) {}
  void took(double seconds);
  /// Whether a size `growth` times the last is expected to stay within the limit: from the last two points,
  /// as something between proportional to the size and its third power.
  bool allows(double growth = 2.0) const;

 private:
  double limit_;
  double last_ = 0.0, before_ = 0.0;
};

}  // namespace wavebalance::app

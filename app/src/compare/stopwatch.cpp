#include "wavebalance/app/compare/solve_point.hpp"

#include <time.h>

namespace wavebalance::app {

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

double least_seconds(const std::function<void()>& work, const Repetition& repetition) {
  double least = std::numeric_limits<double>::infinity(), total = 0.0;
  for (int calls = 0; total < repetition.budget || calls < repetition.least; ++calls) {
    if (calls > 0 && total > repetition.max_seconds) break;
    const double start = processor_seconds();
    work();
    const double seconds = processor_seconds() - start;
    least = std::min(least, seconds);
    total += seconds;
  }
  return least;
}

void TimeLimit::took(double seconds) {
  before_ = last_;
  last_ = seconds;
}

bool TimeLimit::allows(double growth) const {
  const double ratio = before_ > 0.0 ? last_ / before_ : growth;
  return last_ * std::clamp(ratio, growth, growth * growth * growth) <= limit_;
}

}  // namespace wavebalance::app

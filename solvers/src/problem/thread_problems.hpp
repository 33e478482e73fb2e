#pragma once
#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/problem/exact_along.hpp"

namespace wavebalance::solvers::detail {

/// The same problem once per thread for so many places; fewer than `threads` (0: one per core) if a thread
/// would have too few places to repay making a problem.
std::vector<ContactProblem> thread_problems(const ProblemMaker& make, std::size_t places, int threads);

/// Tells of work at many places, from any thread; remembers that the observer returned false.
class PlacesProgress {
 public:
  PlacesProgress(const Observer& observer, std::string_view phase, std::string_view unit)
      : observer_(observer), phase_(phase), unit_(unit) {}

  bool tell(double value, int done, double share) {
    if (!cancelled_ && !goes_on(observer_, {phase_, done, value, unit_, share})) cancelled_ = true;
    return !cancelled_;
  }
  bool cancelled() const { return cancelled_; }

 private:
  const Observer& observer_;
  std::string_view phase_, unit_;
  std::atomic<bool> cancelled_{false};
};

/// Work at one of many places, with an observer. Returns the value to report when it is done, if any.
using WorkAtPlace = std::function<std::optional<double>(ContactProblem& problem, std::size_t place,
                                                        const Observer& observer)>;

/// Does the work at each of so many places on the threads of the problems until it is stopped. The caller's
/// thread reports its work.
void at_places(std::vector<ContactProblem>& problems, std::size_t places, PlacesProgress& progress,
               const WorkAtPlace& work);

}  // namespace wavebalance::solvers::detail

#pragma once
#include <atomic>
#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/problem/exact_along.hpp"

namespace wavebalance::solvers::detail {

/// The same problem once for each thread that takes some of so many places, fewer than `threads` (0: one per
/// core) where a thread would have fewer places than making a problem is worth.
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

/// What is done at one of many places, with an observer for what happens there. Returns the value to tell
/// when it is done, if any.
using WorkAtPlace = std::function<std::optional<double>(ContactProblem& problem, std::size_t place,
                                                        const Observer& observer)>;

/// Does it at each of so many places on the threads of the problems until it is stopped. What the caller's
/// thread does is told.
void at_places(std::vector<ContactProblem>& problems, std::size_t places, PlacesProgress& progress,
               const WorkAtPlace& work);

}  // namespace wavebalance::solvers::detail

#include "problem/thread_problems.hpp"

#include <algorithm>

#include "wavebalance/solvers/linalg/parallel_for.hpp"

namespace wavebalance::solvers::detail {

std::vector<ContactProblem> thread_problems(const ProblemMaker& make, std::size_t places, int threads) {
  constexpr std::size_t least_places_of_thread = 4;
  const std::size_t most = std::max<std::size_t>(1, places / least_places_of_thread);
  const std::size_t workers = std::min<std::size_t>(static_cast<std::size_t>(thread_count(threads)), most);
  std::vector<ContactProblem> problems;
  problems.reserve(workers);
  for (std::size_t i = 0; i < workers; ++i) problems.push_back(make());
  if (workers > 1)
    for (ContactProblem& problem : problems) problem.condensed().set_threads(1);
  return problems;
}

void at_places(std::vector<ContactProblem>& problems, std::size_t places, PlacesProgress& progress,
               const WorkAtPlace& work) {
  std::atomic<int> done{0};
  const auto tell = [&](double value) {
    const int count = done;
    return progress.tell(value, count, double(count) / double(places));
  };
  const auto at = [&](int worker, Eigen::Index index) {
    if (progress.cancelled()) return;
    const Observer observer = [&](const Progress& within) {
      return worker == 0 ? tell(within.value) : !progress.cancelled();
    };
    const auto value =
        work(problems[static_cast<std::size_t>(worker)], static_cast<std::size_t>(index), observer);
    ++done;
    if (value && worker == 0) tell(*value);
  };
  parallel_for(static_cast<int>(problems.size()), static_cast<Eigen::Index>(places), at,
               [&] { tell(missing); });
}

}  // namespace wavebalance::solvers::detail

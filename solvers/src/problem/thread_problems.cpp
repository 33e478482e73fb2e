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

}  // namespace wavebalance::solvers::detail

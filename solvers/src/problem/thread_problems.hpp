#pragma once
#include <cstddef>
#include <vector>

#include "wavebalance/solvers/problem/phases_along.hpp"

namespace wavebalance::solvers::detail {

/// The same problem once for each thread that takes some of so many places, fewer than `threads` (0: one per
/// core) where a thread would have fewer places than making a problem is worth.
std::vector<ContactProblem> thread_problems(const ProblemMaker& make, std::size_t places, int threads);

}  // namespace wavebalance::solvers::detail

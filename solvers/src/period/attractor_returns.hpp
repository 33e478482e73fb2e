#pragma once
#include <functional>

#include "wavebalance/solvers/period/attractor_integration.hpp"

namespace wavebalance::solvers {

/// Is called with each of AttractorMotion::returns as it is found, and with AttractorMotion::start. If it
/// returns true, the search ends.
using TakesReturn = std::function<bool(const Motion& piece, double start)>;

/// settle() that reports its returns one by one, because finding the next one may take long.
AttractorMotion settle(const CondensedProblem& problem, const ContactLaws& laws,
                       const AttractorOptions& options, const TakesReturn& takes);

}  // namespace wavebalance::solvers

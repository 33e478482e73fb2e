#pragma once
#include <functional>

#include "wavebalance/solvers/period/settling.hpp"

namespace wavebalance::solvers {

/// Is called with each of SettledMotion::returns as it is found, and with SettledMotion::start. Where it
/// answers true no more are sought.
using TakesReturn = std::function<bool(const Motion& piece, double start)>;

/// settle() that hands its returns on one by one, since to find the next one may take long.
SettledMotion settle(const CondensedProblem& problem, const ContactLaws& laws, const SettlingOptions& options,
                     const TakesReturn& takes);

}  // namespace wavebalance::solvers

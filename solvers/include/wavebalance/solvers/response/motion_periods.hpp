#pragma once
#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/response/periodic_response.hpp"

namespace wavebalance::solvers {

/// ||u(t + p T) - u(t)|| / ||u - mean of u|| over all contacts, for p = `periods` periods T of the load; 0 of
/// a motion at rest. O(C N).
/// Throws std::invalid_argument for a number of periods below 1.
double change_after(const CondensedProblem& problem, const PeriodicResponse& response, int periods);

/// Largest change_after() of a motion that repeats. If the points of a problem are no multiple of its
/// load_periods(), the periods have different samples, and a motion repeats up to their error.
inline constexpr double largest_change = 1e-3;

/// The period of a motion in periods of the load: the least divisor p of load_periods() with change_after()
/// at most `tolerance`.
int motion_periods(const CondensedProblem& problem, const PeriodicResponse& response,
                   double tolerance = largest_change);

}  // namespace wavebalance::solvers

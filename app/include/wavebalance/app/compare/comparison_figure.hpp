#pragma once
#include <vector>

#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/compare/sweep_comparison.hpp"
#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {

/// Pareto front of a pair in time and error, styled.
Series best_of(const BasisPair& pair, const std::vector<SolvePoint>& points);
/// The Pareto front over everything, as a grey band.
Series pareto_front(const std::vector<SolvePoint>& points);

/// Fourier:Fourier where it is among `pairs`, then those with the most points on the front, `most` at most.
std::vector<BasisPair> leading_pairs(std::vector<BasisPair> pairs, const std::vector<SolvePoint>& points,
                                     std::size_t most);

/// Errors over solve times, with the front, and over functions: for each number the smallest error of all
/// numbers of points; over times of the six leading pairs and the exact solution. The dotted line is the
/// error of the reference. Points that have not converged are not drawn.
Figure error_over_time(const Comparison& comparison);
Figure error_over_functions(const Comparison& comparison);

/// The curve of most functions of each pair that reached its end, largest displacements over frequencies, and
/// the distances from the finest curve over functions.
Figure curves_figure(const SweepComparison& comparison);

}  // namespace wavebalance::app

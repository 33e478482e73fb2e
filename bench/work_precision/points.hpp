#pragma once
#include <vector>

#include "study.hpp"
#include "wavebalance/app/compare/solve_point.hpp"

namespace wavebalance::bench {

using Point = app::SolvePoint;

/// Fourier functions through the assembled system of all unknowns.
std::vector<Point> dense_points(const Study& study, const std::vector<int>& functions, double max_seconds);
/// Collocation on contact intervals to each tolerance, with their balance of 63 functions, from nothing. The
/// first row has the tolerance 1e-6, by which exact_study() chooses a balance.
std::vector<Point> collocation_points(const Study& study, const std::vector<double>& tolerances);
/// Time stepping to each tolerance on the difference of two periods.
std::vector<Point> time_stepping_points(const Study& study, const std::vector<double>& tolerances);

}  // namespace wavebalance::bench

#pragma once
#include <vector>

#include "study.hpp"
#include "wavebalance/app/compare/solve_point.hpp"

namespace wavebalance::bench {

using Point = app::SolvePoint;

/// Fourier functions through the assembled system of all unknowns.
std::vector<Point> dense_points(const Study& study, const std::vector<int>& functions, double max_seconds);
/// Time stepping to each tolerance on the difference of two periods, and shooting to each on its steps.
std::vector<Point> time_stepping_points(const Study& study, const std::vector<double>& tolerances);
std::vector<Point> shooting_points(const Study& study, const std::vector<double>& tolerances);

}  // namespace wavebalance::bench

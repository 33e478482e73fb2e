#pragma once
#include "wavebalance/solvers/exact/exact_curve.hpp"

namespace wavebalance::solvers::detail {

/// exact_curve() by the map of a period of the flow, with laws of all kinds together.
ExactCurve map_curve(const ProblemFamily& family, const ExactSolution& first,
                     const ExactCurveOptions& options);

}  // namespace wavebalance::solvers::detail

#pragma once
#include "wavebalance/solvers/exact/exact_curve.hpp"

namespace wavebalance::solvers::detail {

/// exact_curve() by the map of a period of the flow, with laws of all kinds side by side.
ExactCurve map_curve(const PhaseFamily& family, const PhaseMotion& first, const ExactCurveOptions& options);

}  // namespace wavebalance::solvers::detail

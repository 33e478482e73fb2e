#pragma once
#include <limits>
#include <string>

#include "wavebalance/reproduce/analysis.hpp"

namespace wavebalance::reproduce {

inline constexpr double missing = std::numeric_limits<double>::quiet_NaN();

/// The fields that open every summary.
Summary opening(bool converged, const std::string& status, double residual, int iterations, int unknowns,
                double wall_seconds);

/// The fields of one motion of the tip; missing values when `samples` are empty.
void append_motion(Summary& summary, const solvers::PeriodSamples& samples);

}  // namespace wavebalance::reproduce

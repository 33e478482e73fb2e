#pragma once
#include "report/arguments.hpp"

namespace wavebalance::app {

/// Compares pairs of bases on a scene and writes the results. Returns as run_scene(): solved, not_converged
/// without a reference or a curve, interrupted + signal with what was measured so far. Throws as run_scene().
int compare_scene(const CompareArguments& arguments);

}  // namespace wavebalance::app

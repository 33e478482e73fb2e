#pragma once
#include <string>

#include "command/commands.hpp"

namespace wavebalance::app {

struct CompareArguments {
  RunArguments run;      ///< scene, its changes, output and quiet
  std::string pairs;     ///< "fourier:fourier,haar:fourier"; empty: every admissible common one
  std::string error;     ///< "displacement", "force" or "both"; empty: ComparisonOptions::measure
  double budget = 10.0;  ///< s
};

/// Compares pairs of bases on a scene and writes the results. Returns as run_scene(): solved, not_converged
/// without a reference or a curve, interrupted + signal with what was measured so far. Throws as run_scene().
int compare_scene(const CompareArguments& arguments);

}  // namespace wavebalance::app

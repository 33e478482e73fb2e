#pragma once
#include "wavebalance/app/analysis/response.hpp"

namespace wavebalance::app {

/// Solves a scene with time.tolerance. Sets all of `result` except motions and wall_seconds. Throws
/// solvers::SingularSystem.
solvers::RefinementResult solve_to_tolerance(const Scene& scene, const StructureModel& model,
                                             const solvers::ContactLaws& laws, const ResponseOptions& options,
                                             Response& result);

}  // namespace wavebalance::app

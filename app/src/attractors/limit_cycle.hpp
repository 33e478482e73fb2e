#pragma once
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/analysis/start_motion.hpp"
#include "wavebalance/solvers/attractors/limit_cycle.hpp"

namespace wavebalance::app {

/// The limit cycle of a scene as a response at its own frequency.
struct LimitCycleResponse {
  Response response;
  double frequency = solvers::missing;  ///< Hz; missing without a motion
  solvers::LimitCycle found;            ///< without its motion, which the response has
};

/// solvers::limit_cycle() of a scene with analysis.type = "limit_cycle", from a cycle nearby first unless
/// that is empty.
LimitCycleResponse limit_cycle_response(const Scene& scene, const StructureModel& model,
                                        const StartMotion& start, const ResponseOptions& options);

}  // namespace wavebalance::app

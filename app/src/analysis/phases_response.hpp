#pragma once
#include <optional>

#include "wavebalance/app/analysis/response.hpp"

namespace wavebalance::app {

/// phases_response() of a scene with time.tolerance, from its coarse balances alone; nothing where the
/// tolerance is not met, or where a refined balance is cheaper, or in a pair of bases that the scene names.
std::optional<Response> phases_to_tolerance(const Scene& scene, const StructureModel& model,
                                            const ResponseOptions& options);

}  // namespace wavebalance::app

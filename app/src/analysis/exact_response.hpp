#pragma once
#include <optional>

#include "wavebalance/app/analysis/response.hpp"

namespace wavebalance::app {

/// The scene as a balance with so many Fourier functions, from which phases of contact are sought.
Scene balance_of(Scene scene, int functions);
/// The first of exact_starts with as many harmonics as the load of the scene.
int least_start_functions(const Scene& scene);

/// exact_response() of a scene with time.tolerance, from its coarse balances alone; nothing where the
/// tolerance is not met, or where a refined balance is cheaper, or in a pair of bases that the scene names.
std::optional<Response> exact_to_tolerance(const Scene& scene, const StructureModel& model,
                                           const ResponseOptions& options);

}  // namespace wavebalance::app

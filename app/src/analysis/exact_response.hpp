#pragma once
#include <optional>

#include "wavebalance/app/analysis/response.hpp"

namespace wavebalance::app {

/// The scene as a harmonic balance with so many Fourier functions, a start for exact solutions.
Scene balance_of(Scene scene, int functions);
/// The first of exact_starts with as many harmonics as the load of the scene.
int least_start_functions(const Scene& scene);

/// exact_response() of a scene with time.tolerance, from its coarse harmonic balances only; nothing if the
/// tolerance is not met, a refined balance is cheaper, or the scene names a pair of bases.
std::optional<Response> exact_to_tolerance(const Scene& scene, const StructureModel& model,
                                           const ResponseOptions& options);

}  // namespace wavebalance::app

#pragma once
#include <cstddef>
#include <optional>
#include <vector>

#include "wavebalance/app/outputs/output_measures.hpp"

namespace wavebalance::app {

/// The point with the largest vibration of an output, or with its largest modulus; nothing where none was
/// measured.
std::optional<std::size_t> highest(const std::vector<MeasuredPoint>& points, std::size_t output,
                                   bool vibration = true);

/// Sets SweepOutputs::peaks and largest of what was measured along a sweep of the scene. About ten solutions
/// each, and along an exact curve some twenty motions.
void solve_for_peaks(const Scene& scene, const StructureModel& model, SweepOutputs& found, const Sweep& sweep,
                     const Observer& observer);

}  // namespace wavebalance::app

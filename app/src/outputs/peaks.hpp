#pragma once

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

/// Where the polynomial through a point of a curve and so many neighbours on each side is highest, over the
/// length of the curve through them, of which places and heights have the range of these points as units.
struct PolynomialPeak {
  double place, height;
};
/// Nothing near an end of the curve, next to unknown points, and where the polynomial is highest beyond the
/// two neighbours.
std::optional<PolynomialPeak> polynomial_peak(std::span<const double> places, std::span<const double> heights,
                                              std::size_t index, std::size_t neighbours);

}  // namespace wavebalance::app

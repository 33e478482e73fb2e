#pragma once
#include <span>
#include <vector>

#include "wavebalance/app/analysis/curve_motions.hpp"
#include "wavebalance/app/outputs/output_measures.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The record of a curve over frequency or amplitude, with what was measured of its outputs and the motions
/// of analysis.motion_at.
Record sweep_record(const Scene& scene, const StructureModel& model, const Sweep& sweep,
                    const SweepOutputs& outputs, const std::vector<CurveMotion>& motions);

/// Leaves the share of the period out at all points where a spring acts everywhere: it is never open, so
/// that the fraction is 1.
void leave_out_contact_fractions(const Scene& scene, Sweep& sweep);

/// The errors of a point and the status of its phases.
void append_exact(Summary& row, const ExactAlongSweep::Point& point);

/// How well the points of a curve resolve the highest of them.
struct PeakResolution {
  double value = 0.0;  ///< by how much the parabola through it and its neighbours is higher, over its height
  double place = 0.0;  ///< how far from it the parabola is highest, in the unit of `places`
};

/// At the point `index` of a curve; zeros at the ends of the curve.
PeakResolution peak_resolution(std::span<const double> places, std::span<const double> values,
                               std::size_t index);

}  // namespace wavebalance::app

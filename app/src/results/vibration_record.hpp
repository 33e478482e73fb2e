#pragma once
#include <span>

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/files/summary.hpp"

namespace wavebalance::app {

/// How well the points of a curve resolve the highest of them.
struct PeakResolution {
  double value = 0.0;  ///< by how much the parabola through it and its neighbours is higher, over its height
  double place = 0.0;  ///< how far from it the parabola is highest, in the unit of `places`
};

/// Of the point `index` of a curve; zeros at an end of the curve, which is where it is.
PeakResolution peak_resolution(std::span<const double> places, std::span<const double> values,
                               std::size_t index);

/// The largest vibration of the contacts along a sweep, where it is, how well the points resolve it, and its
/// error against the motion of the structure near the peak.
void append_vibration(Summary& summary, const Scene& scene, const Sweep& sweep);

/// The largest shares of the period in which contacts with friction slip and are open along a sweep.
void append_friction_along(Summary& summary, const Sweep& sweep);

/// Leaves the share of the period out at all points where a spring acts everywhere: it is never open, so that
/// the share says nothing.
void leave_out_contact_fractions(const Scene& scene, Sweep& sweep);

}  // namespace wavebalance::app

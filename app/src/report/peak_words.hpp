#pragma once
#include <string>

#include "wavebalance/app/analysis/sweep.hpp"

namespace wavebalance::app {

/// A peak's value with the digits that the points of its curve determine.
std::string rounded_quantity(double value, const std::string& unit, double resolution);

/// "at 10.09 Hz", with the digits that the points of the curve determine.
std::string place_text(double place, double resolution, const SweepAxis& axis);

/// "791 µm (half peak to peak), at 10.09 Hz".
std::string peak_text(double vibration, const std::string& unit, double resolution, double place,
                      double place_resolution, const SweepAxis& axis);

}  // namespace wavebalance::app

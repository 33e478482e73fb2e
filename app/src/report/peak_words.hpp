#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/files/table.hpp"

namespace wavebalance::app {

/// A peak's value with the digits that the points of its curve determine.
std::string rounded_quantity(double value, const std::string& unit, double resolution);

/// "at 10.09 Hz", with the digits that the points of the curve determine.
std::string place_text(double place, double resolution, const SweepAxis& axis);

/// "791 µm (half peak to peak), at 10.09 Hz".
std::string peak_text(double vibration, const std::string& unit, double resolution, double place,
                      double place_resolution, const SweepAxis& axis);

/// How the output of a row of the summary's table vibrates, in the digits that its curve and its error leave.
void append_output(std::vector<std::string>& sentences, const Table& outputs, std::size_t row,
                   const SweepAxis& axis);

/// How many digits of a peak that was solved for are determined, and by what; nothing where none was.
void append_digits(std::vector<std::string>& sentences, const Table& outputs, std::size_t row,
                   bool exact_curve);

}  // namespace wavebalance::app

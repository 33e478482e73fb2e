#pragma once
#include <optional>
#include <string>

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/files/table.hpp"

namespace wavebalance::app {

/// What a sweep varies, in words, columns and units.
struct SweepAxis {
  std::string quantity;  ///< "frequency" or "amplitude"
  std::string unit;      ///< "Hz", "N", "m" or "m/s^2"
  std::string suffix;    ///< the unit at the end of a column's name

  std::string column() const { return quantity + "_" + suffix; }
  std::string label() const;  ///< "Frequency (Hz)"
};

SweepAxis sweep_axis(const Sweep& sweep);
/// That of which a table has the column; empty for other tables.
std::optional<SweepAxis> axis_of(const Table& table);

}  // namespace wavebalance::app

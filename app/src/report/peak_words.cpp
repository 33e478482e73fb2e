#include "report/peak_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "files/number_text.hpp"
#include "plot/unit_prefix.hpp"

namespace wavebalance::app {
namespace {

/// So many digits of a number as the points of a curve determine: at least two, at most `most`.
int digits_of(double value, double resolution, int most) {
  if (!(resolution > 0.0)) return most;
  return std::clamp(static_cast<int>(std::ceil(std::log10(std::abs(value) / resolution))), 2, most);
}

}  // namespace

std::string rounded_quantity(double value, const std::string& unit, double resolution) {
  constexpr int most = 4;
  return quantity(rounded(value, digits_of(1.0, resolution, most)), unit);
}

std::string place_text(double place, double resolution, const SweepAxis& axis) {
  constexpr int most = 5;
  const double at = rounded(place, digits_of(place, resolution, most));
  return "at " + (axis.quantity == "frequency" ? fmt::format("{:.10g} {}", at, axis.unit)
                                               : "an amplitude of " + quantity(at, axis.unit));
}

std::string peak_text(double vibration, const std::string& unit, double resolution, double place,
                      double place_resolution, const SweepAxis& axis) {
  return rounded_quantity(vibration, unit, resolution) + " (half peak to peak), " +
         place_text(place, place_resolution, axis);
}

}  // namespace wavebalance::app

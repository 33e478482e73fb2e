#include "plot/unit_prefix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "files/number_text.hpp"

namespace wavebalance::app {
namespace {

struct Prefix {
  double size;     // of the unit with the prefix
  double inverse;  // 1 / size, exact where it is a whole number
  const char* sign;
};

constexpr std::array<Prefix, 8> prefixes{{{1e9, 1e-9, "G"},
                                          {1e6, 1e-6, "M"},
                                          {1e3, 1e-3, "k"},
                                          {1.0, 1.0, ""},
                                          {1e-3, 1e3, "m"},
                                          {1e-6, 1e6, "µ"},
                                          {1e-9, 1e9, "n"},
                                          {1e-12, 1e12, "p"}}};

/// The largest prefix up to `most` that `magnitude` reaches, else the one of the size `least`.
const Prefix& prefix_for(double magnitude, double least, double most) {
  return *std::find_if(prefixes.begin(), prefixes.end(), [&](const Prefix& one) {
    return one.size <= least || (one.size <= most && magnitude >= one.size);
  });
}

}  // namespace

Scale axis_scale(double largest) {
  if (!(largest > 0.0)) return {};
  const Prefix& prefix = prefix_for(largest, 1e-9, 1e9);
  return {prefix.inverse, prefix.sign};
}

Scale take_to_scale(std::vector<double>& values) {
  double largest = 0.0;
  for (const double one : values) largest = std::max(largest, std::abs(one));
  Scale scale = axis_scale(largest);
  for (double& one : values) one *= scale.factor;
  return scale;
}

bool takes_prefix(std::string_view unit) {
  constexpr std::array fixed{"",     "kg m",  "mm",     "µm",      "mrad", "deg",
                             "mm/s", "deg/s", "mm/s^2", "deg/s^2", "g"};
  return std::find(fixed.begin(), fixed.end(), unit) == fixed.end();
}

Scale axis_scale(double largest, std::string_view unit) {
  if (!takes_prefix(unit)) return {};
  const bool length = unit == "m" || unit == "rad";
  return axis_scale(length ? largest : std::min(largest, 1.0));
}

std::string quantity(double value, const std::string& unit) {
  if (!std::isfinite(value)) return "not known";
  if (unit.empty()) return fmt::format("{:.4g}", value);
  const double least = unit == "Hz" ? 1.0 : 1e-12;
  const double magnitude = rounded(std::abs(value), 4);  // "1 mm" for 999.99 µm
  if (!takes_prefix(unit) || magnitude < least || magnitude == 0.0)
    return fmt::format("{:.4g} {}", value, unit);
  const Prefix& prefix = prefix_for(magnitude, least, unit == "N" ? 1e9 : 1.0);
  return fmt::format("{:.4g} {}{}", value / prefix.size, prefix.sign, unit);
}

}  // namespace wavebalance::app

#pragma once
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wavebalance::app {

/// A factor on values of an axis, and the prefix of its unit.
struct Scale {
  double factor = 1.0;
  std::string prefix;
};

/// The scale that makes numbers up to `largest` readable, from nano to giga; none if all are zero.
Scale axis_scale(double largest);

/// Whether values in a unit may have another prefix: not in a requested unit such as "mm", and no ratio.
bool takes_prefix(std::string_view unit);
/// The scale of values in a unit, where only lengths and angles have prefixes above one.
Scale axis_scale(double largest, std::string_view unit);

/// axis_scale() of the largest of the values, which are multiplied by its factor.
Scale take_to_scale(std::vector<double>& values);

// Numbers for readers: the one format of terminal, reports and pages. Files have all digits
// (number_text.hpp).

/// `value` with so many significant digits, "1.23·10⁻⁵" where that is shorter; "not known" for NaN.
std::string short_number(double value, int digits = 4);

/// "0.5, 12.25": short_number() of each.
std::string short_numbers(std::span<const double> values, int digits);

/// "1, 4 to 6, 8" of ascending numbers.
std::string number_ranges(std::span<const int> numbers);

/// `fraction` as "12.3 %", or "less than 0.001 %".
std::string percentage(double fraction, int digits = 3);

/// "1.02 mm", "79.2 kN": with a prefix from pico to giga. Only forces and bytes have prefixes above one, and
/// frequencies have none.
std::string quantity(double value, const std::string& unit, int digits = 4);

}  // namespace wavebalance::app

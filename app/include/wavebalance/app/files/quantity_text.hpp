#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace wavebalance::app {

/// A factor on values of an axis, and the prefix of its unit that belongs to it.
struct Scale {
  double factor = 1.0;
  std::string prefix;
};

/// That which makes numbers up to `largest` readable, from nano to giga; none for numbers that are all zero.
Scale axis_scale(double largest);

/// Whether values in a unit may be told with another prefix: not in one that was asked for, as "mm", nor a
/// ratio.
bool takes_prefix(std::string_view unit);
/// The same of values in a unit, of which lengths and angles alone take prefixes above one.
Scale axis_scale(double largest, std::string_view unit);

/// axis_scale() of the largest of the values, by whose factor they are multiplied.
Scale take_to_scale(std::vector<double>& values);

/// "1.02 mm", "79.2 kN": four digits with a prefix from pico to giga, of which only forces take those above
/// one, and frequencies none; "not known" for NaN.
std::string quantity(double value, const std::string& unit);

}  // namespace wavebalance::app

#pragma once
#include <string>
#include <vector>

namespace wavebalance::app {

/// A factor on values of an axis, and the prefix of its unit that belongs to it.
struct Scale {
  double factor = 1.0;
  std::string prefix;
};

/// That which makes numbers up to `largest` readable, from nano to giga; none for numbers that are all zero.
Scale axis_scale(double largest);

/// axis_scale() of the largest of the values, by whose factor they are multiplied.
Scale take_to_scale(std::vector<double>& values);

/// "1.02 mm", "79.2 kN": four digits with a prefix from pico to giga, of which only forces take those above
/// one, and frequencies none; "not known" for NaN.
std::string quantity(double value, const std::string& unit);

}  // namespace wavebalance::app

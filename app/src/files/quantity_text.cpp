#include "wavebalance/app/files/quantity_text.hpp"

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
  return *std::ranges::find_if(prefixes, [&](const Prefix& one) {
    return one.size <= least || (one.size <= most && magnitude >= one.size);
  });
}

std::string superscript(int exponent) {
  static constexpr std::array digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text;
  for (const char c : std::to_string(exponent))
    text += c == '-' ? "⁻" : digits[static_cast<std::size_t>(c - '0')];
  return text;
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
                             "mm/s", "deg/s", "mm/s^2", "deg/s^2", "g",    "m3"};
  return std::ranges::find(fixed, unit) == fixed.end();
}

Scale axis_scale(double largest, std::string_view unit) {
  if (!takes_prefix(unit)) return {};
  const bool length = unit == "m" || unit == "rad";
  return axis_scale(length ? largest : std::min(largest, 1.0));
}

std::string short_number(double value, int digits) {
  if (!std::isfinite(value)) return "not known";
  constexpr int written_out = 5;  // digits before the point
  const double shown = rounded(value, digits), rounding = 1e-12;
  const int exponent = shown == 0.0 ? 0 : int(std::floor(std::log10(std::abs(shown)) + rounding));
  if (exponent >= -3 && exponent < std::max(digits, written_out))
    return fmt::format("{:.{}g}", shown, std::max(digits, written_out));
  const std::string mantissa = fmt::format("{:.{}g}", shown / std::pow(10.0, exponent), digits),
                    power = "10" + superscript(exponent);
  return mantissa == "1" ? power : mantissa == "-1" ? "-" + power : mantissa + "·" + power;
}

std::string short_numbers(std::span<const double> values, int digits) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : ", ") + short_number(value, digits);
  return text;
}

std::string number_ranges(std::span<const int> numbers) {
  std::string text;
  for (std::size_t first = 0, next = 0; first < numbers.size(); first = next) {
    while (next < numbers.size() && numbers[next] - numbers[first] == int(next - first)) ++next;
    const std::string begin = std::to_string(numbers[first]), end = std::to_string(numbers[next - 1]);
    const bool few = next - first < 3;
    text += text.empty() ? "" : ", ";
    text += next - first == 1 ? begin : begin + (few ? ", " : " to ") + end;
  }
  return text;
}

std::string percentage(double fraction, int digits) {
  constexpr double least = 1e-5;
  const double size = std::abs(fraction);
  if (size > 0.0 && size < least) return "less than 0.001 %";
  return short_number(100.0 * fraction, digits) + " %";
}

std::string quantity(double value, const std::string& unit, int digits) {
  if (!std::isfinite(value)) return "not known";
  if (unit.empty()) return short_number(value, digits);
  const double least = unit == "Hz" ? 1.0 : 1e-12;
  const double magnitude = rounded(std::abs(value), digits);  // "1 mm" for 999.99 µm
  if (!takes_prefix(unit) || magnitude < least || magnitude == 0.0)
    return short_number(value, digits) + " " + unit;
  const Prefix& prefix = prefix_for(magnitude, least, unit == "N" || unit == "B" ? 1e9 : 1.0);
  return short_number(value / prefix.size, digits) + " " + prefix.sign + unit;
}

}  // namespace wavebalance::app

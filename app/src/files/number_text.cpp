#include "files/number_text.hpp"

#include <fmt/format.h>
#include <algorithm>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>

namespace wavebalance::app {

std::string number_text(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  std::array<char, 32> buffer;
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  std::string text(buffer.data(), end);
  const auto exponent = text.find('e');
  if (exponent == std::string::npos) return text;
  // 7e+10 and 1e-04 read better as 7e10 and 1e-4.
  if (text[exponent + 1] == '+') text.erase(exponent + 1, 1);
  const auto digits = exponent + (text[exponent + 1] == '-' ? 2 : 1);
  if (text[digits] == '0') text.erase(digits, 1);
  return text;
}

std::string spaced_words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

double rounded(double value, int digits) {
  if (!std::isfinite(value)) return value;
  const std::string text = fmt::format("{:.{}g}", value, digits);
  return std::strtod(text.c_str(), nullptr) + 0.0;  // stod refuses subnormals
}

std::string count_text(std::int64_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace wavebalance::app

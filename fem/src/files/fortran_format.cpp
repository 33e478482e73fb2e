#include "text_parts.hpp"

namespace wavebalance::fem::detail {
namespace {

constexpr int longest_field = 200;

bool is_digit(char letter) { return letter >= '0' && letter <= '9'; }

/// The whole number at the front of a text, which is taken from it.
std::optional<int> take_integer(std::string_view& text) {
  std::string_view digits = text;
  if (digits.size() > 1 && digits[0] == '+') digits.remove_prefix(1);
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return value;
}

/// The text in lower case without blanks and the outer parentheses.
std::optional<std::string> inside(std::string_view text) {
  std::string result = lower(trimmed(text));
  std::erase_if(result, [](char letter) { return letter == ' ' || letter == '\t'; });
  if (result.size() < 3 || result.front() != '(' || result.back() != ')') return std::nullopt;
  return result.substr(1, result.size() - 2);
}

/// Takes "kP" and a comma after it.
void take_scale(std::string_view& text, FortranFormat& format) {
  std::string_view rest = text;
  const auto power = take_integer(rest);
  if (!power || rest.empty() || rest[0] != 'p') return;
  rest.remove_prefix(1);
  if (!rest.empty() && rest[0] == ',') rest.remove_prefix(1);
  format.scale_power = *power;
  text = rest;
}

/// Takes ".decimals", and the width of the exponent after a letter e.
bool take_decimals(std::string_view& text, FortranFormat& format) {
  if (text.empty() || text[0] != '.') return !format.real() && text.empty();
  text.remove_prefix(1);
  const auto decimals = take_integer(text);
  if (!decimals) return false;
  format.decimals = *decimals;
  if (!text.empty() && text[0] == 'e') {
    text.remove_prefix(1);
    if (!take_integer(text)) return false;
  }
  return text.empty() && format.decimals >= 0 && format.decimals < format.width;
}

/// Where the exponent opens: at its letter, or at a sign that follows a digit or the point.
std::size_t exponent_place(std::string_view number) {
  for (std::size_t i = 1; i < number.size(); ++i) {
    const char letter = number[i];
    if (letter == 'e' || letter == 'E' || letter == 'd' || letter == 'D') return i;
    if ((letter == '+' || letter == '-') && (is_digit(number[i - 1]) || number[i - 1] == '.')) return i;
  }
  return std::string_view::npos;
}

/// The power of ten of an exponent such as D+02, E5 or -101.
std::optional<int> exponent_of(std::string_view text) {
  if (!is_digit(text[0]) && text[0] != '+' && text[0] != '-') text.remove_prefix(1);
  const auto power = take_integer(text);
  return power && text.empty() && std::abs(*power) < 10'000 ? power : std::nullopt;
}

}  // namespace

std::optional<FortranFormat> fortran_format(std::string_view text) {
  const auto content = inside(text);
  if (!content) return std::nullopt;
  std::string_view rest = *content;
  FortranFormat format;
  take_scale(rest, format);
  if (const auto repeat = take_integer(rest)) format.repeat = *repeat;
  constexpr std::string_view letters = "iedfg";
  if (rest.empty() || letters.find(rest[0]) == std::string_view::npos) return std::nullopt;
  format.letter = rest[0];
  rest.remove_prefix(1);
  const auto width = take_integer(rest);
  if (!width || *width < 1 || *width > longest_field || format.repeat < 1) return std::nullopt;
  format.width = *width;
  if (!format.real() && (rest.empty() || rest[0] == '.')) return format;  // I10.4 pads when it is written
  return take_decimals(rest, format) ? std::optional(format) : std::nullopt;
}

std::optional<double> fortran_real(std::string_view field, const FortranFormat& format) {
  std::string_view number = trimmed(field);
  if (number.size() > 1 && number[0] == '+') number.remove_prefix(1);
  if (number.empty()) return std::nullopt;
  const std::size_t place = exponent_place(number);
  std::optional<int> power = -format.scale_power;
  if (place != std::string_view::npos) power = exponent_of(number.substr(place));
  if (!power) return std::nullopt;
  std::string text(number.substr(0, place));
  if (text.find('.') == std::string::npos) *power -= format.decimals;
  if (text.find_first_not_of("+-.0123456789") != std::string::npos) return std::nullopt;
  text += "e" + std::to_string(*power);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = end == text.data() + text.size();
  if (whole && error == std::errc::result_out_of_range && *power < 0) return 0.0;  // smaller than any double
  return whole && error == std::errc() && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::string_view next_parentheses(std::string_view& line) {
  const std::size_t open = line.find('('), close = line.find(')', open);
  if (open == std::string_view::npos || close == std::string_view::npos) return {};
  const std::string_view found = line.substr(open, close - open + 1);
  line.remove_prefix(close + 1);
  return found;
}

}  // namespace wavebalance::fem::detail

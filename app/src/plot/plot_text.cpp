#include "plot/plot_parts.hpp"

#include <cctype>
#include <cmath>

#include "files/number_text.hpp"

namespace wavebalance::app {

std::string capitalised(std::string text) {
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'')
      result += "\u2019";
    else
      result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
  }
  return result + "'";
}

std::array<const char*, 5> map_colours(const HeatMap& map) {
  if (map.from_zero) return {"#FFFFFF", "#ADD8F0", "#56B4E9", "#0072B2", "#062A4E"};
  return {"#0072B2", "#7FB8D8", "#FFFFFF", "#EAAE7F", "#D55E00"};
}

std::string colour_code(Colour colour) {
  // In the order of the enumeration; names without a colour are black.
  constexpr std::array codes{"#000000", "#000000", "#E69F00", "#56B4E9", "#009E73",
                             "#0072B2", "#D55E00", "#CC79A7", "#777777"};
  return codes[static_cast<std::size_t>(colour)];
}

Colour automatic_colour(std::size_t index) {
  constexpr std::array<Colour, 7> order{Colour::blue,   Colour::vermillion, Colour::green, Colour::purple,
                                        Colour::orange, Colour::sky_blue,   Colour::black};
  return order[index % order.size()];
}

std::string symbol_text(std::size_t number, double size) {
  // gnuplot's filled shapes, then the open ones
  constexpr std::array<int, 8> order{7, 5, 9, 13, 11, 6, 4, 8};
  return " pt " + std::to_string(order[number % order.size()]) + " ps " + number_text(0.7 * size);
}

std::string coordinate(double value) { return std::isfinite(value) ? number_text(value) : "NaN"; }

}  // namespace wavebalance::app

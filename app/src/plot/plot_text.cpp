#include "plot/plot_text.hpp"

#include <array>
#include <cmath>

#include "files/number_text.hpp"

namespace wavebalance::app {

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
  switch (colour) {
    case Colour::orange:
      return "#E69F00";
    case Colour::sky_blue:
      return "#56B4E9";
    case Colour::green:
      return "#009E73";
    case Colour::blue:
      return "#0072B2";
    case Colour::vermillion:
      return "#D55E00";
    case Colour::purple:
      return "#CC79A7";
    case Colour::grey:
      return "#777777";
    case Colour::black:
    case Colour::automatic:
      break;
  }
  return "#000000";
}

Colour automatic_colour(std::size_t index) {
  constexpr std::array<Colour, 7> order{Colour::blue,   Colour::vermillion, Colour::green, Colour::purple,
                                        Colour::orange, Colour::sky_blue,   Colour::black};
  return order[index % order.size()];
}

std::string symbol_text(std::size_t number) {
  // gnuplot's filled shapes, then the open ones
  constexpr std::array<int, 8> order{7, 5, 9, 13, 11, 6, 4, 8};
  return " pt " + std::to_string(order[number % order.size()]) + " ps 0.7";
}

std::string coordinate(double value) { return std::isfinite(value) ? number_text(value) : "NaN"; }

}  // namespace wavebalance::app

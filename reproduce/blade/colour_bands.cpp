#include "colour_bands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "files/number_text.hpp"
#include "plot/plot_parts.hpp"

namespace wavebalance::blade {
namespace {

using app::number_text;

struct Rgb {
  double red, green, blue;
};

int packed(const Rgb& colour) {
  const auto byte = [](double value) { return static_cast<int>(std::lround(value)); };
  return (byte(colour.red) << 16) + (byte(colour.green) << 8) + byte(colour.blue);
}

/// Linear between stops, uniform over 0..1: white to dark blue.
Rgb colour_at(double share) {
  constexpr std::array<Rgb, 5> stops{
      {{247, 251, 255}, {173, 216, 240}, {86, 180, 233}, {0, 114, 178}, {6, 42, 78}}};
  const double place = share * static_cast<double>(stops.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double rest = place - static_cast<double>(low);
  const Rgb &a = stops[low], &b = stops[low + 1];
  return {a.red + rest * (b.red - a.red), a.green + rest * (b.green - a.green),
          a.blue + rest * (b.blue - a.blue)};
}

std::string hexadecimal(int colour) {
  constexpr const char* digits = "0123456789abcdef";
  std::string text = "#";
  for (int shift = 20; shift >= 0; shift -= 4) text += digits[(colour >> shift) & 15];
  return text;
}

/// Four digits: levels are divisions of a range, with rounding errors behind.
std::string short_text(double value) { return fmt::format("{:.4g}", value); }

std::string rectangle(double bottom, double top, const std::string& style) {
  return fmt::format("set object rectangle from graph 1.04,graph {} to graph 1.09,graph {} noclip front {}\n",
                     number_text(bottom), number_text(top), style);
}

}  // namespace

int band_of(const ColourBands& colours, double value) {
  const double place = (value - colours.lower) / (colours.upper - colours.lower) * colours.bands;
  return std::clamp(static_cast<int>(std::floor(place)), 0, colours.bands - 1);
}

double level_of(const ColourBands& colours, int band) {
  return colours.lower + (colours.upper - colours.lower) * band / colours.bands;
}

int band_colour(const ColourBands& colours, int band) {
  return packed(colour_at(static_cast<double>(band) / (colours.bands - 1)));
}

int grey(double brightness) { return packed({brightness, brightness, brightness}); }

std::string colour_bar_text(const ColourBands& colours) {
  constexpr double bottom = 0.06, height = 0.88;  // shares of the panel's height
  const auto place = [&](int band) { return bottom + height * band / colours.bands; };
  std::string text = "set rmargin 11\n";
  for (int band = 0; band < colours.bands; ++band)
    text += rectangle(place(band), place(band + 1),
                      "fc rgb '" + hexadecimal(band_colour(colours, band)) + "' fs solid noborder");
  text += rectangle(bottom, bottom + height, "fs empty border lc rgb '#222222' lw 0.8");
  const int step = (colours.bands + 5) / 6;  // at most seven levels are written
  for (int band = 0; band <= colours.bands; band += step)
    text += "set label '" + short_text(level_of(colours, band)) + "' at graph 1.09,graph " +
            number_text(place(band)) + " left offset 0.5,0\n";
  return text + "set label " + app::quoted(colours.label) +
         " at graph 1.09,graph 0.5 center rotate by 90 offset 6,0\n";
}

}  // namespace wavebalance::blade

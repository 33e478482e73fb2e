#pragma once
#include <string>

#include "surface.hpp"

namespace wavebalance::blade {

/// The band of a value, 0..bands - 1.
int band_of(const ColourBands& colours, double value);

/// Its lower end.
double level_of(const ColourBands& colours, int band);

/// Its colour, 0xRRGGBB.
int band_colour(const ColourBands& colours, int band);

/// brightness 0..255 as 0xRRGGBB.
int grey(double brightness);

/// Commands that draw the bands with their levels to the right of a panel. gnuplot's bar needs ten times
/// the space in an SVG.
std::string colour_bar_text(const ColourBands& colours);

}  // namespace wavebalance::blade

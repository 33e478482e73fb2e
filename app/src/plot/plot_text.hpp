#pragma once
#include <array>
#include <string>

#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {

/// The text with a capital letter first.
std::string capitalised(std::string text);

/// A gnuplot string in single quotes, in which gnuplot runs no commands. The only escape there is the doubled
/// quote, which gnuplot 5.4 misreads at the start of a string, so that an apostrophe is written in its
/// typographic form.
std::string quoted(const std::string& text);

/// "#E69F00"
std::string colour_code(Colour colour);

/// The colour of the index-th series of a panel without an explicit colour, from 0.
Colour automatic_colour(std::size_t index);

/// The colours of a map, at equal steps from its least value to its largest.
std::array<const char*, 5> map_colours(const HeatMap& map);

/// " pt 7 ps 0.7": the number-th symbol, from 0.
std::string symbol_text(std::size_t number, double size = 1.0);

/// A number, or NaN for what is not finite.
std::string coordinate(double value);

}  // namespace wavebalance::app

#pragma once
#include <string>

#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {

/// A gnuplot string. In single quotes gnuplot runs no commands and knows no escapes but the doubled quote,
/// which it misreads at the start: an apostrophe takes its typographic form instead.
std::string quoted(const std::string& text);

/// "#E69F00"
std::string colour_code(Colour colour);

/// " pt 7 ps 0.7": the number-th symbol, from 0.
std::string symbol_text(std::size_t number);

/// A number, or NaN for what is not finite.
std::string coordinate(double value);

}  // namespace wavebalance::app

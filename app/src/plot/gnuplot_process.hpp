#pragma once
#include <string>

namespace wavebalance::app {

/// Runs gnuplot on `script` and returns what it writes to its standard output. No shell, no file name and
/// no start-up file of the user is used. Throws PlotError with gnuplot's message if it fails or complains.
std::string run_gnuplot(const std::string& script);

}  // namespace wavebalance::app

#pragma once
#include <string>
#include <vector>

#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/files/summary.hpp"

namespace wavebalance::app {

/// What came out of time stepping that did not repeat, with the errors of its statistics; empty for other
/// records.
std::vector<std::string> recorded_sentences(const Summary& summary);

/// What came out of a bifurcation diagram; empty for other records.
std::vector<std::string> diagram_sentences(const Summary& summary, const SweepAxis& axis);

}  // namespace wavebalance::app

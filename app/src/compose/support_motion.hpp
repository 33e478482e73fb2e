#pragma once
#include "wavebalance/app/compose/outputs.hpp"

namespace wavebalance::app {

/// Sets the motions of supports that take an output to the frame of its words, and over which it is a ratio,
/// and of a ratio its derivative. Throws std::invalid_argument where the loads of the scene have no such
/// frame.
void set_frame(Output& output, const OutputWords& words, const Scene& scene);

}  // namespace wavebalance::app

#pragma once
#include "wavebalance/app/compose/outputs.hpp"

namespace wavebalance::app {

/// Sets the motions of supports that are added to an output for its frame of reference, and the support
/// motion that a transmissibility divides by, with its derivative. Throws std::invalid_argument where the
/// loads of the scene have no such frame.
void set_frame(Output& output, const OutputWords& words, const Scene& scene);

}  // namespace wavebalance::app

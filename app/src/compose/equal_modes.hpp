#pragma once
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {

/// Turns modes of equal frequency into those combinations that move the contacts most, in descending order.
/// Their frequencies become those of the combinations, which differ by less than equal_frequencies.
void separate_equal_modes(StructureModes& modes);

}  // namespace wavebalance::app

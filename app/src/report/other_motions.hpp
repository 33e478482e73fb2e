#pragma once
#include <string>

#include "wavebalance/app/files/summary.hpp"

namespace wavebalance::app {

/// Whether other motions than the record's were searched for, for curves at which frequencies, and the
/// result; empty if not applicable.
std::string other_motions_sentence(const Summary& summary, bool curve);

}  // namespace wavebalance::app

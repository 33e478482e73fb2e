#pragma once
#include <string>

#include "wavebalance/app/files/summary.hpp"

namespace wavebalance::app {

/// Whether motions beside those of a record were sought, and of a curve where and what was found; empty where
/// there are none to seek.
std::string other_motions_sentence(const Summary& summary, bool curve);

}  // namespace wavebalance::app

#pragma once
#include <string>

namespace wavebalance::app {

/// A sentence on why an exact solution was not found, by its status; empty for other statuses.
std::string exact_sentence(const std::string& status);

}  // namespace wavebalance::app

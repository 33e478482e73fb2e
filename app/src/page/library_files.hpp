#pragma once

#include "wavebalance/app/page/assets.hpp"

namespace wavebalance::app {

/// The style and the scripts of a library that is available, in the order in which a page loads them.
std::vector<std::filesystem::path> library_files(Library library);

}  // namespace wavebalance::app

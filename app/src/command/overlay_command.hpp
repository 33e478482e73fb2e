#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace wavebalance::app {

struct OverlayArguments {
  std::vector<std::filesystem::path> folders;  ///< results of earlier runs
  std::filesystem::path output;
  std::string quantity = "max";  ///< see overlay_quantity()
  bool quiet = false;
};

/// Draws the curves of earlier results over each other and writes picture, page and data. Returns solved.
/// Throws SceneError, IoError and std::invalid_argument.
int overlay_results(const OverlayArguments& arguments);

}  // namespace wavebalance::app

#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace wavebalance::app {

/// The keys of a scene's file that do not belong to an analysis of the type `type`, each "section.key", or
/// "forcing.terms" for all of its terms: those that have no meaning in it, of a nonlinear mode without
/// friction dampings and loads too. Of overrides those of type, law and method count. Throws SceneError for a
/// file that cannot be read or is not TOML.
std::vector<std::string> keys_beside_analysis(const std::filesystem::path& file, const std::string& type,
                                              const std::vector<std::string>& overrides = {});

}  // namespace wavebalance::app

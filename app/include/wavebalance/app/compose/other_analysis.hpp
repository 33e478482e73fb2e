#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// The keys of a scene's file that do not belong to an analysis of the type `type`, each "section.key", or
/// "forcing.terms" for all of its terms: without meaning in it, for a nonlinear mode without friction also
/// dampings and loads. Other keys of the structure are kept, because they define it: the analysis refuses
/// them. Only overrides of type, law and method count. Throws SceneError for a file that cannot be read or
/// is not TOML.
std::vector<std::string> keys_beside_analysis(const std::filesystem::path& file, const std::string& type,
                                              const std::vector<std::string>& overrides = {});

/// A change of a scene as `--analysis`, `--set` and `--unset` make it, and tables that are added to its file.
struct SceneChange {
  std::string analysis = {};            ///< another analysis.type; empty: the same
  std::vector<std::string> set = {};    ///< each "section.key=value"
  std::vector<std::string> unset = {};  ///< each "section.key"
  std::string added = {};               ///< TOML, as "[[forcing.terms]]\nharmonic = 0"
};

/// The scene as a forced response, with usual bases and sizes where it has none; impacts have none.
SceneChange as_response(const Scene& scene);

/// The scene with this change, if it passes the rules of a file. Keys that the change does not name and that
/// do not belong to the changed scene are left out, but not keys of the structure that are set. Matrices are
/// not read again, unless kept_modes is what changes.
std::optional<Scene> changed_scene(const Scene& scene, const SceneChange& change);
/// Whether there is one.
bool accepts(const Scene& scene, const SceneChange& change);

}  // namespace wavebalance::app

#pragma once

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::python {

/// Where a scene comes from, and its changes.
struct SceneSource {
  std::string text;  ///< TOML; empty: read from the file `name`
  std::string name;  ///< of the file, in messages too; its paths are relative to that folder
  std::vector<std::string> overrides;  ///< "section.key=value"
  std::vector<std::string> removed;    ///< "section.key"
  bool temporary = false;              ///< it names files that are gone once it has been used
};

/// The scene, complete and within range. Throws app::SceneError.
app::Scene scene_of(const SceneSource& source);

}  // namespace wavebalance::python

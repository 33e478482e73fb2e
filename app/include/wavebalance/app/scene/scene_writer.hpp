#pragma once
#include <filesystem>
#include <functional>
#include <string>

#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// `scene` as the text of a scene file with units as comments; loading it gives an equal scene. Keys that are
/// not allowed for the scene's contact law or analysis are left out.
std::string write_scene(const Scene& scene);

/// `scene` with each name of a file that it reads replaced by `renamed(name)`.
Scene with_files(Scene scene, const std::function<std::string(const std::string&)>& renamed);

/// `scene` for a file in `folder`: names of files become relative to `folder` where both lie in the parent
/// folder of `home` or below, so that they can be moved together. Others stay as they are.
Scene relative_to(const Scene& scene, const std::filesystem::path& folder, const std::filesystem::path& home);

}  // namespace wavebalance::app

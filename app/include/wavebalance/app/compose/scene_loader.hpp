#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/app/scene/scene_error.hpp"
#include "wavebalance/app/scene/scene_writer.hpp"

namespace wavebalance::app {

/// Reads the scene in `file`, drops the keys in `removed`, each "section.key", and applies `overrides`, each
/// "section.key=value" with a TOML value (text may go without its quotes), before anything is checked. The
/// result is complete and within range: every key that has a default is filled in. Throws SceneError when the
/// file cannot be read, is not TOML, or is not a scene.
Scene load_scene(const std::filesystem::path& file, std::span<const std::string> overrides = {},
                 std::span<const std::string> removed = {});

/// The same for `text`, which messages call `name`. Files of matrices that `earlier` has read, too, are not
/// read again.
Scene parse_scene(std::string_view text, const std::string& name, std::span<const std::string> overrides = {},
                  std::span<const std::string> removed = {}, const Scene* earlier = nullptr);

/// `scene`, built or changed in a program, with the defaults that derive from other keys filled in where they
/// are unset. Throws SceneError if it could not have been loaded from a file.
Scene complete_scene(const Scene& scene);

}  // namespace wavebalance::app

#pragma once
#include <string>

#include "scene/scene_document.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {

/// Throws SceneError at the place of `entry`.
[[noreturn]] void fail_at(const Document& document, const DocumentEntry& entry, std::string allowed);

/// The absolute path of a file that the document names relative to its own.
std::string path_in(const Document& document, const std::string& name);

/// The value of `entry` if the key allows it. Throws SceneError.
SceneValue checked_value(const Document& document, const DocumentEntry& entry, const SceneKey& key);

/// The scene that `document` describes: each key is known, in range and allowed in the scene; defaults are
/// filled in. The rules between keys are not checked here. Throws SceneError.
Scene read_scene(const Document& document);

/// Whether a basis or size of the file is left over from the analysis that an override has replaced. Such a
/// key is left out where it does not belong.
bool is_of_former_analysis(const Document& document, const DocumentEntry& entry);

}  // namespace wavebalance::app

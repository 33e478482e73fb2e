#pragma once

#include "scene/scene_document.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {

/// Throws SceneError at the place of `entry`.
[[noreturn]] void fail_at(const Document& document, const DocumentEntry& entry, std::string allowed);

/// Throws SceneError at a section that lacks a key.
[[noreturn]] void fail_missing(const Document& document, const std::string& section, std::string_view name,
                               const std::string& expected);

/// The absolute path of a file that the document names relative to its own.
std::string path_in(const Document& document, const std::string& name);

/// Sets a key of one of the tables of a scene as `section` of the document has it, or to its default.
void take_key(const Document& document, const std::string& section, const SceneKey& key, Scene& scene);

/// The scene that `document` describes: each key is known, in range and allowed in the scene; defaults are
/// filled in. The rules between keys are not checked here. Throws SceneError.
Scene read_scene(const Document& document);

/// Whether a basis or size of the file is left over from the analysis that an override has replaced. Such a
/// key is left out where it does not belong.
bool is_of_former_analysis(const Document& document, const DocumentEntry& entry);

}  // namespace wavebalance::app

#pragma once
#include <initializer_list>
#include <string>
#include <string_view>

#include "scene/scene_document.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// Blames the first of `names` that the scene holds; if there is none, the first one's section.
[[noreturn]] void fail_rule(const Document& document, std::initializer_list<std::string_view> names,
                            const std::string& rule);

/// Holds a scene's structure to the rules between its keys, and to its files, which are then read and kept in
/// the scene. Throws SceneError.
void check_structure_rules(const Document& document, Scene& scene);

/// Holds a scene, whose keys are right one by one, to the rules between them: sizes of wavelet bases,
/// quadrature, admissible pairs, sweeps, sizes of time stepping, the structure's. Throws SceneError at the
/// key to blame.
void check_scene_rules(const Document& document, Scene& scene);

}  // namespace wavebalance::app

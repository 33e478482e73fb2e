#pragma once
#include <string>

#include "scene_document.hpp"
#include "wavebalance/reproduce/scene.hpp"

namespace wavebalance::reproduce {

/// Throws SceneError at the place of `entry`.
[[noreturn]] void fail_at(const Document& document, const DocumentEntry& entry, std::string allowed);

/// Holds a scene, whose keys are right one by one, to the rules between them: sizes of wavelet bases,
/// quadrature, admissible pairs, sweeps, sizes of time stepping. Throws SceneError at the key to blame.
void check_scene_rules(const Document& document, const Scene& scene);

}  // namespace wavebalance::reproduce

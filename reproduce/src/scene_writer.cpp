#include "wavebalance/reproduce/scene_keys.hpp"
#include "wavebalance/reproduce/scene_loader.hpp"

namespace wavebalance::reproduce {
namespace {

/// A key that was never given and has no default stays out: time stepping needs no bases.
bool is_unset(const SceneKey& key, const Scene& scene) {
  return !key.needed.holds(scene) && key.get(scene) == key.get(Scene{});
}

std::string line_of(const SceneKey& key, const Scene& scene) {
  std::string line = std::string(key.name) + " = " + toml_text(key.get(scene));
  if (!key.unit.empty()) line += "  # " + std::string(key.unit);
  return line + "\n";
}

}  // namespace

std::string write_scene(const Scene& scene) {
  std::string text;
  std::string_view section;
  for (const SceneKey& key : scene_keys()) {
    if (!key.belongs.holds(scene) || is_unset(key, scene)) continue;
    // The derived number of quadrature points has nothing to derive from when no functions are given.
    if (key.fallback == SceneKey::Default::derived && key.get(scene) == key.get(Scene{})) continue;
    if (key.section != section) text += (text.empty() ? "[" : "\n[") + std::string(key.section) + "]\n";
    section = key.section;
    text += line_of(key, scene);
  }
  return text;
}

}  // namespace wavebalance::reproduce

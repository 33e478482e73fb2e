
#include "wavebalance/app/scene/scene_keys.hpp"
#include "wavebalance/app/scene/scene_writer.hpp"

namespace wavebalance::app {
namespace {

using Renamed = std::function<std::string(const std::string&)>;

void rename_in(Scene& scene, std::span<const SceneKey> keys, const Renamed& renamed) {
  for (const SceneKey& key : keys) {
    if (key.type != SceneKey::Type::path) continue;
    const SceneValue value = key.get(scene);
    const auto* name = std::get_if<std::string>(&value);
    if (name != nullptr && !name->empty()) key.set(scene, renamed(*name));
  }
}

/// Whether a path lies in a folder or below it.
bool lies_in(const std::filesystem::path& path, const std::filesystem::path& folder) {
  const auto inner = path.lexically_relative(folder);
  return !inner.empty() && *inner.begin() != ".." && inner.is_relative();
}

std::filesystem::path absolute_folder(const std::filesystem::path& folder) {
  auto path = std::filesystem::absolute(folder).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

}  // namespace

Scene with_files(Scene scene, const Renamed& renamed) {
  rename_in(scene, scene_keys(), renamed);
  for (std::size_t i = 0; i < scene.contact.pairs.size(); ++i) rename_in(scene, pair_keys(i), renamed);
  for (std::size_t i = 0; i < scene.forcing.terms.size(); ++i) rename_in(scene, term_keys(i), renamed);
  return scene;
}

Scene relative_to(const Scene& scene, const std::filesystem::path& folder,
                  const std::filesystem::path& home) {
  const auto from = absolute_folder(folder), inner = absolute_folder(home), outer = inner.parent_path();
  const auto& project = outer == outer.root_path() ? inner : outer;
  return with_files(scene, [&](const std::string& name) {
    const std::filesystem::path path(name);
    if (!path.is_absolute() || !lies_in(path, project) || !lies_in(from, project)) return name;
    return path.lexically_relative(from).generic_string();
  });
}

}  // namespace wavebalance::app

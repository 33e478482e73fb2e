#include "wavebalance/app/compose/compose.hpp"

#include "compose/compose_parts.hpp"
#include "matrices/dof_names.hpp"
#include "scene/scene_document.hpp"
#include "scene/scene_reader.hpp"
#include "scene/toml_text.hpp"

namespace wavebalance::app {
namespace {

constexpr std::size_t max_scene_bytes = std::size_t{1} << 20;

Scene checked_scene(const Document& given, const Scene* earlier = nullptr) {
  const Document document = with_rows_for_names(given);
  Scene scene = read_scene(document);
  if (earlier != nullptr) scene.structure.matrices.files = earlier->structure.matrices.files;
  check_scene_rules(document, scene);
  return scene;
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name, std::span<const std::string> overrides,
                  std::span<const std::string> removed, const Scene* earlier) {
  Document document = parse_document(text, name);
  remove_entries(document, removed);
  apply_overrides(document, overrides);
  return checked_scene(document, earlier);
}

Scene load_scene(const std::filesystem::path& file, std::span<const std::string> overrides,
                 std::span<const std::string> removed) {
  return parse_scene(read_toml(file, max_scene_bytes), file.string(), overrides, removed);
}

Scene complete_scene(const Scene& scene) { return checked_scene(document_of(scene, "scene")); }

}  // namespace wavebalance::app

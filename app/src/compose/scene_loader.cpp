#include "wavebalance/app/compose/scene_loader.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "compose/scene_rules.hpp"
#include "scene/scene_document.hpp"
#include "scene/scene_reader.hpp"

namespace wavebalance::app {
namespace {

std::string read_text(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& reason) {
    throw SceneError({file.string(), 0, "", "", "", "cannot be read: " + reason});
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) fail("it is a directory");
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  if (!stream) fail(std::strerror(errno));
  std::ostringstream text;
  text << stream.rdbuf();
  if (stream.bad()) fail(std::strerror(errno));
  return text.str();
}

}  // namespace

Scene parse_scene(std::string_view text, const std::string& name, std::span<const std::string> overrides) {
  Document document = parse_document(text, name);
  apply_overrides(document, overrides);
  Scene scene = read_scene(document);
  check_scene_rules(document, scene);
  return scene;
}

Scene load_scene(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return parse_scene(read_text(file), file.string(), overrides);
}

Scene complete_scene(const Scene& scene) { return parse_scene(write_scene(scene), "scene"); }

}  // namespace wavebalance::app

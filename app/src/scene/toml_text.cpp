#include "scene/toml_text.hpp"

#include <algorithm>
#include <sstream>

#include "scene/toml_nesting.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/scene/scene_error.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {

std::string long_key_text() {
  return "a key has more than " + std::to_string(max_key_parts) +
         " parts between dots; expected section.key or [section]";
}

toml::table parse_toml(std::string_view text, const std::string& name) {
  if (const int line = line_of_long_key(text, max_key_parts); line > 0)
    throw SceneError({name, line, "", "", "", long_key_text()});
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw SceneError({name, static_cast<int>(error.source().begin.line), "", "", "",
                      "not valid TOML: " + std::string(error.description())});
  }
}

std::string read_toml(const std::filesystem::path& file, std::size_t max_bytes) {
  try {
    return read_file(file, max_bytes);
  } catch (const IoError& error) {
    throw SceneError({file.string(), 0, "", "", "", error.reason()});
  }
}

std::string shortened(std::string text) {
  constexpr std::size_t longest_found = 60;
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.size() <= longest_found ? text : text.substr(0, longest_found - 3) + "...";
}

std::string found_text(const toml::node& node) {
  if (node.is_integer()) return toml_text(node.as_integer()->get());
  if (node.is_floating_point()) return toml_text(node.as_floating_point()->get());
  if (node.is_string()) return shortened(toml_text(node.as_string()->get()));
  if (node.is_table()) return "a table";
  std::ostringstream text;
  node.visit([&](const auto& concrete) { text << concrete; });
  return shortened(text.str());
}

}  // namespace wavebalance::app

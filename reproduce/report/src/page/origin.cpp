#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <thread>

#include "page/page_parts.hpp"
#include "wavebalance/app/page/html.hpp"

namespace wavebalance::report {
namespace {

constexpr std::size_t most_commands = 12;

/// An argument quoted for a shell.
std::string argument(const std::string& text) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string_view("_.=+-/,:").find(c) != std::string_view::npos;
  };
  return std::all_of(text.begin(), text.end(), plain) ? text : "'" + text + "'";
}

std::string run_command(const std::string& scene, const std::vector<std::string>& overrides) {
  std::string text = "wavebalance run " + scene;
  for (const auto& one : overrides) text += (one.starts_with("--") ? " " : " --set ") + argument(one);
  return text + " --output DIR\n";
}

/// "time.functions = 8, 16, 32": every key that is overridden, with its values in order of appearance.
std::string override_values(const SceneUse& use) {
  std::vector<std::pair<std::string, std::vector<std::string>>> keys;
  for (const auto& overrides : use.overrides)
    for (const auto& one : overrides) {
      const std::size_t equals = std::min(one.find('='), one.size());
      const std::string key = one.substr(0, equals), value = one.substr(std::min(equals + 1, one.size()));
      auto entry =
          std::find_if(keys.begin(), keys.end(), [&](const auto& other) { return other.first == key; });
      if (entry == keys.end()) entry = keys.insert(keys.end(), {key, {}});
      auto& values = entry->second;
      if (std::find(values.begin(), values.end(), value) == values.end()) values.push_back(value);
    }
  std::string text;
  for (const auto& [key, values] : keys) text += fmt::format("  {} = {}\n", key, fmt::join(values, ", "));
  return text;
}

std::string scene_commands(const SceneUse& use, const std::string& path) {
  if (use.overrides.empty()) return run_command(path, {});
  std::string text;
  if (use.overrides.size() <= most_commands) {
    for (const auto& overrides : use.overrides) text += run_command(path, overrides);
    return text;
  }
  return run_command(path, use.overrides.front()) +
         fmt::format("# {} runs of this scene, with --set of\n", use.overrides.size()) + override_values(use);
}

std::string scenes_html(const Record& record, const Place& place) {
  std::string links, commands;
  for (const SceneUse& use : record.scenes) {
    const std::string copy = "scenes/" + use.name;
    const std::string name = app::escaped(use.name);
    links += links.empty() ? "" : ", ";
    links += place.section.files.count(copy)
                 ? fmt::format("<a href=\"{}{}\">{}</a>", place.folder, app::escaped(copy), name)
                 : name;
    commands += scene_commands(use, "reproduce/scenes/" + record.identity.paper + "/" + use.name);
  }
  if (links.empty()) return "";
  return fmt::format("<p>Single runs of the {} {}:</p>\n<pre><code>{}</code></pre>\n",
                     record.scenes.size() == 1 ? "scene" : "scenes", links, app::with_options(commands));
}

std::string files_html(const Record& record, const Place& place) {
  std::string text = "<ul>\n";
  for (const auto& file : record.files) {
    const auto data = std::find_if(record.data.begin(), record.data.end(),
                                   [&](const DataFile& one) { return one.name == file; });
    std::string remarks;
    if (data != record.data.end()) {
      remarks = data->units.empty() ? "" : ": " + data->units;
      for (const auto& note : data->notes) remarks += "; " + note;
    }
    text += fmt::format("<li><a href=\"{}{}\">{}</a>{}</li>\n", place.folder, app::escaped(file),
                        app::escaped(file), app::with_formulas(remarks));
  }
  return text + "</ul>\n";
}

}  // namespace

std::string this_machine() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t name = line.find_first_not_of(": \t", line.find(':'));
    const unsigned cores = std::thread::hardware_concurrency();
    if (name == line.npos) break;
    return fmt::format("{}, {} {}", line.substr(name), cores, cores == 1 ? "core" : "cores");
  }
  return "unknown";
}

std::string origin_html(const Record& record, const Place& place) {
  std::string text =
      "<details class=\"origin\"><summary>Data, commands and origin</summary>\n" + files_html(record, place);
  if (!record.program.empty())
    text += fmt::format("<p>All of it again:</p>\n<pre><code>{}</code></pre>\n",
                        app::with_options(record.program + " --output results/" + record.identity.paper));
  text += scenes_html(record, place);
  return text +
         fmt::format(
             "<p class=\"quiet\">Computed in {:.2g} s by Wavebalance {}. Page made at commit {}. Compiler {}. "
             "Machine {}.</p>\n</details>\n",
             record.wall_seconds, app::escaped(record.version), app::escaped(place.origin.commit),
             app::escaped(place.origin.compiler), app::escaped(place.origin.machine));
}

}  // namespace wavebalance::report

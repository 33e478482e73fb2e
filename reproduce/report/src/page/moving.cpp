#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "page/body_script.hpp"
#include "page/page_parts.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/page/html.hpp"

namespace wavebalance::report {
namespace {

/// "case1" of "motion_case1.motion.js", or "".
std::string case_of(const std::string& file, const std::string& suffix) {
  const std::string beginning = "motion_";
  if (!file.starts_with(beginning) || !file.ends_with(suffix)) return "";
  return file.substr(beginning.size(), file.size() - beginning.size() - suffix.size());
}

/// The first record of the section whose stem ends as the motion of a bar does shows that motion.
std::string bar_script(const Record& record, const Section& section) {
  for (const auto& [file, bytes] : section.files) {
    const std::string name = case_of(file, ".motion.js");
    if (name.empty()) continue;
    const auto shows = [&](const Record& one) {
      return one.identity.stem.starts_with("fig") && one.identity.stem.ends_with("_" + name);
    };
    const auto first = std::find_if(section.records.begin(), section.records.end(), shows);
    if (first != section.records.end() && first->identity.stem == record.identity.stem) return file;
  }
  return "";
}

std::string script_of_series(const std::string& pvd) { return pvd.substr(0, pvd.size() - 4) + ".body.js"; }

double last_number(const std::string& file) {
  const std::size_t bar = file.rfind('_');
  return bar == file.npos ? 0.0 : std::strtod(file.c_str() + bar + 1, nullptr);
}

/// The scripts of the series of a record that have been written, by the number at the end of their names.
std::vector<std::string> body_scripts(const Record& record, const Section& section) {
  std::vector<std::string> scripts;
  for (const auto& file : record.files)
    if (file.ends_with(".pvd") && section.files.count(script_of_series(file)) > 0)
      scripts.push_back(script_of_series(file));
  std::stable_sort(scripts.begin(), scripts.end(), [](const std::string& a, const std::string& b) {
    return last_number(a) < last_number(b);
  });
  return scripts;
}

}  // namespace

std::string moving_html(const Record& record, const Place& place) {
  std::string text;
  const std::string bar = bar_script(record, place.section);
  if (!bar.empty())
    text +=
        fmt::format("<div class=\"motion\" data-motion=\"{}{}\"></div>\n", place.folder, app::escaped(bar));
  std::string bodies;
  for (const auto& script : body_scripts(record, place.section))
    bodies += (bodies.empty() ? "" : " ") + place.folder + app::escaped(script);
  if (!bodies.empty() && app::available(app::Library::three))
    text +=
        fmt::format("<div class=\"body-motion\" data-library=\"{}three.min.js\" data-bodies=\"{}\"></div>\n",
                    place.assets, bodies);
  return text;
}

void write_moving(const std::filesystem::path& folder, const std::vector<Record>& records) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::string name = case_of(entry.path().filename().string(), ".json");
    if (name.empty()) continue;
    const std::string text = app::read_file(entry.path());
    if (!nlohmann::json::accept(text)) throw app::IoError(entry.path(), "is not JSON");
    app::write_file(
        folder / ("motion_" + name + ".motion.js"),
        "((window.wavebalance ?\?= {}).motions ?\?= {})[\"motion_" + name + "\"] = " + text + ";\n");
  }
  for (const Record& record : records)
    for (const auto& file : record.files)
      if (file.ends_with(".pvd"))
        app::write_file(folder / script_of_series(file), body_script(folder / file));
}

}  // namespace wavebalance::report

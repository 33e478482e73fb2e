#include <fmt/format.h>

#include <algorithm>

#include "page/page_parts.hpp"
#include "wavebalance/app/page/html.hpp"

namespace wavebalance::report {
namespace {

double last_number(const std::string& file) {
  const std::size_t bar = file.rfind('_');
  return bar == file.npos ? 0.0 : std::strtod(file.c_str() + bar + 1, nullptr);
}

/// The scripts of the series of a record, by the number at the end of their names.
std::vector<std::string> body_scripts(const Record& record, const Section& section) {
  std::vector<std::string> scripts;
  for (const auto& file : record.files) {
    const std::string script = file.substr(0, file.rfind('.')) + ".body.js";
    if (file.ends_with(".pvd") && section.files.count(script) > 0) scripts.push_back(script);
  }
  std::stable_sort(scripts.begin(), scripts.end(), [](const std::string& a, const std::string& b) {
    return last_number(a) < last_number(b);
  });
  return scripts;
}

}  // namespace

std::string moving_html(const Record& record, const Place& place) {
  std::string text, bodies;
  const std::string bar = record.identity.stem + ".motion.js";
  if (place.section.files.count(bar) > 0)
    text +=
        fmt::format("<div class=\"motion\" data-motion=\"{}{}\"></div>\n", place.folder, app::escaped(bar));
  for (const auto& script : body_scripts(record, place.section))
    bodies += (bodies.empty() ? "" : " ") + place.folder + app::escaped(script);
  if (!bodies.empty() && app::available(app::Library::three))
    text +=
        fmt::format("<div class=\"body-motion\" data-library=\"{}three.min.js\" data-bodies=\"{}\"></div>\n",
                    place.assets, bodies);
  return text;
}

}  // namespace wavebalance::report

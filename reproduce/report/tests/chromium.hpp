#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "wavebalance/app/files/output.hpp"

namespace wavebalance::report {

/// What `script`, a file, writes as JSON into the element "found" of a page that it runs in. `pages` are
/// files; the script finds their addresses in the list of that name. `log` has the browser's messages. Throws
/// std::runtime_error if chromium fails or finds nothing.
inline nlohmann::json found_by(const std::filesystem::path& script,
                               const std::vector<std::filesystem::path>& pages,
                               const std::filesystem::path& folder, std::string& log) {
  std::string names;
  for (const auto& page : pages) names += "\"file://" + page.string() + "\",";
  app::write_file(folder / "probe.html", "<!DOCTYPE html><title>probe</title><body><script>const pages = [" +
                                             names + "];</script><script src=\"probe.js\"></script></body>");
  app::write_file(folder / "probe.js", app::read_file(script));
  const std::string command =
      "'" WAVEBALANCE_CHROMIUM
      "' --headless=new --no-sandbox --disable-gpu --allow-file-access-from-files "
      "--enable-logging=stderr --window-size=1600,1100 --virtual-time-budget=600000 --user-data-dir='" +
      (folder / "profile").string() + "' --dump-dom 'file://" + (folder / "probe.html").string() + "' > '" +
      (folder / "dom").string() + "' 2> '" + (folder / "log").string() + "'";
  const int status = std::system(("timeout 150 " + command).c_str());
  log = app::read_file(folder / "log");
  const std::string dom = app::read_file(folder / "dom");
  const std::string begin = "<pre id=\"found\">";
  const std::size_t first = dom.find(begin);
  if (status != 0 || first == dom.npos)
    throw std::runtime_error("chromium ended with status " + std::to_string(WEXITSTATUS(status)) + "\n" +
                             log + dom);
  std::string text = dom.substr(first + begin.size(), dom.find("</pre>", first) - first - begin.size());
  for (const auto& [entity, sign] : {std::pair{"&amp;", "&"}, {"&lt;", "<"}, {"&gt;", ">"}})
    for (std::size_t at = text.find(entity); at != text.npos; at = text.find(entity, at + 1))
      text.replace(at, std::string(entity).size(), sign);
  return nlohmann::json::parse(text);
}

class NeedsChromium : public testing::Test {
 protected:
  void SetUp() override {
    if (std::string(WAVEBALANCE_CHROMIUM).empty())
      GTEST_SKIP() << "chromium is not installed (setup installs it)";
  }
};

}  // namespace wavebalance::report

// Any text loads to a scene that survives being written and read, or gives a SceneError. Lines that start
// with "--set " are overrides, those with "--unset " keys to be left out.
#include "wavebalance/app/compose/compose.hpp"

#include <string>
#include <string_view>
#include <vector>

#include "fuzz.hpp"

namespace {

using namespace wavebalance::app;

struct Input {
  std::string text;
  std::vector<std::string> overrides;
  std::vector<std::string> removed;
};

/// The text after `mark` on a line that starts with it goes to `list`.
bool take(std::string_view line, std::string_view mark, std::vector<std::string>& list) {
  if (!line.starts_with(mark)) return false;
  list.emplace_back(line.substr(mark.size(), line.find('\n') - mark.size()));
  return true;
}

Input split(std::string_view all) {
  Input input;
  while (!all.empty()) {
    const auto end = std::min(all.find('\n'), all.size() - 1) + 1;
    const std::string_view line = all.substr(0, end);
    if (!take(line, "--set ", input.overrides) && !take(line, "--unset ", input.removed)) input.text += line;
    all.remove_prefix(end);
  }
  return input;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Input input = split({reinterpret_cast<const char*>(data), size});
  try {
    const Scene scene = parse_scene(input.text, "fuzz", input.overrides, input.removed);
    const std::string written = write_scene(scene);
    try {
      require(parse_scene(written, "written") == scene, "a written scene loads back equal");
    } catch (const SceneError& error) {
      std::fprintf(stderr, "%s\n", error.what());
      require(false, "a written scene loads");
    }
  } catch (const SceneError& error) {
    require(*error.what() != '\0', "an error says something");
  }
  return 0;
}

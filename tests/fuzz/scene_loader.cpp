// Any text loads to a scene that survives being written and read, or gives a SceneError. Lines that start
// with
// "--set " are overrides.
#include "wavebalance/app/compose/scene_loader.hpp"

#include <string>
#include <string_view>
#include <vector>

#include "fuzz.hpp"

namespace {

using namespace wavebalance::app;

struct Input {
  std::string text;
  std::vector<std::string> overrides;
};

Input split(std::string_view all) {
  constexpr std::string_view mark = "--set ";
  Input input;
  while (!all.empty()) {
    const auto end = std::min(all.find('\n'), all.size() - 1) + 1;
    const std::string_view line = all.substr(0, end);
    if (line.starts_with(mark))
      input.overrides.emplace_back(line.substr(mark.size(), line.find('\n') - mark.size()));
    else
      input.text += line;
    all.remove_prefix(end);
  }
  return input;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const Input input = split({reinterpret_cast<const char*>(data), size});
  try {
    const Scene scene = parse_scene(input.text, "fuzz", input.overrides);
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

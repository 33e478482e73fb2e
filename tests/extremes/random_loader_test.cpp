#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "random_scenes.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace {

using namespace wavebalance::app;

RC_GTEST_PROP(RandomTexts, LoadCompleteAndInRangeOrNameWhatIsWrong, ()) {
  const RandomText drawn =
      random_text(*rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint64_t>()));
  RC_LOG() << drawn.text;
  try {
    const Scene scene = parse_scene(drawn.text, "random");
    RC_ASSERT(!drawn.invalid);
    for (const SceneKey& key : scene_keys())
      if (const SceneValue value = key.get(scene); const auto* number = std::get_if<double>(&value))
        RC_ASSERT(!key.belongs.holds(scene) || !key.needed.holds(scene) || std::isfinite(*number));
    RC_ASSERT(parse_scene(write_scene(scene), "written") == scene);
    RC_TAG("loaded");
  } catch (const SceneError& error) {
    RC_ASSERT(!error.details().key.empty() || error.details().line > 0);
    RC_ASSERT(!error.details().allowed.empty());
    RC_TAG("refused");
  }
}

}  // namespace

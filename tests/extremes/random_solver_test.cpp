#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "judge.hpp"
#include "random_scenes.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace {

using namespace wavebalance;

/// Nothing converges with a number that is none, or with an equation that does not hold.
RC_GTEST_PROP(RandomScenes, ConvergeToWhatHoldsOrSayWhyNot, ()) {
  app::Scene scene =
      random_scene(*rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint64_t>()));
  try {
    scene = app::complete_scene(scene);
  } catch (const app::SceneError& error) {
    RC_TAG("refused");
    return;
  }
  RC_LOG() << app::write_scene(scene);
  const extremes::Verdict verdict = extremes::judge(scene, 0);
  RC_LOG() << to_string(verdict.outcome) << ": " << verdict.text << "\nmotion " << verdict.residuals.motion
           << "\nits rounding " << verdict.residuals.motion_rounding << "\ncomplementarity "
           << verdict.residuals.complementarity << "\nseconds " << verdict.seconds << "\n";
  RC_ASSERT(verdict.outcome != extremes::Outcome::wrong);
  RC_ASSERT(verdict.outcome == extremes::Outcome::solved || !verdict.text.empty());
  RC_TAG(to_string(verdict.outcome));
}

}  // namespace

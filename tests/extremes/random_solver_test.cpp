#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "check_residuals.hpp"
#include "random_scenes.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace {

using namespace wavebalance;
using extremes::Outcome;

struct Counts {
  int solved = 0;
  int due = 0;  ///< scenes with a solution: accepted by the loader and not singular
};

/// No solution is due at an undamped resonance.
bool solution_is_due(const extremes::CheckResult& result) {
  return result.outcome != Outcome::not_converged || result.text.find("singular") == std::string::npos;
}

void check_scene(std::uint64_t seed, Counts& counts) {
  app::Scene scene = random_scene(seed);
  try {
    scene = app::complete_scene(scene);
  } catch (const app::SceneError& error) {
    RC_TAG("refused");
    return;
  }
  RC_LOG() << app::write_scene(scene);
  const extremes::CheckResult result = extremes::check_residuals(scene, 0);
  RC_LOG() << to_string(result.outcome) << ": " << result.text << "\nmotion " << result.residuals.motion
           << "\nits rounding " << result.residuals.motion_rounding << "\ncomplementarity "
           << result.residuals.complementarity << "\n";
  counts.solved += result.outcome == Outcome::solved ? 1 : 0;
  counts.due += solution_is_due(result) ? 1 : 0;
  RC_ASSERT(result.outcome != Outcome::wrong);
  RC_ASSERT(result.outcome == Outcome::solved || !result.text.empty());
  RC_TAG(to_string(result.outcome));
}

TEST(RandomScenes, ConvergeToWhatHoldsOrSayWhyNotAndNearlyAllConverge) {
  Counts counts;
  const bool holds = rc::check([&counts] {
    check_scene(*rc::gen::resize(rc::kNominalSize, rc::gen::arbitrary<std::uint64_t>()), counts);
  });
  EXPECT_TRUE(holds);
  EXPECT_GT(counts.due, 0);
  EXPECT_GE(counts.solved, 0.95 * counts.due) << counts.solved << " of " << counts.due;
}

}  // namespace

// Scenes with numbers of any size: each solves with residuals that hold, or says why it does not.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <optional>

#include "campaign.hpp"
#include "check_residuals.hpp"
#include "random_scenes.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace {

using namespace wavebalance;
using extremes::Outcome;

/// The scene of a seed with its defaults, if the loader accepts it.
std::optional<app::Scene> accepted_scene(std::uint64_t seed) {
  try {
    return app::complete_scene(random_scene(seed));
  } catch (const app::SceneError&) {
    return std::nullopt;
  }
}

/// No solution is due at an undamped resonance.
bool solution_is_due(const extremes::CheckResult& result) {
  return result.outcome != Outcome::not_converged || result.text.find("singular") == std::string::npos;
}

TEST(RandomScenes, ConvergeToWhatHoldsOrSayWhyNotAndNearlyAllConverge) {
  const int count = campaign_seeds(150, 2000);
  int solved = 0, due = 0;
  for (int seed = 1; seed <= count; ++seed) {
    const auto scene = accepted_scene(static_cast<std::uint64_t>(seed));
    if (!scene) continue;
    const extremes::CheckResult result = extremes::check_residuals(*scene, 0);
    solved += result.outcome == Outcome::solved ? 1 : 0;
    due += solution_is_due(result) ? 1 : 0;
    EXPECT_TRUE(result.outcome == Outcome::solved ||
                (result.outcome != Outcome::wrong && !result.text.empty()))
        << "seed " << seed << ", " << to_string(result.outcome) << ": " << result.text << "\nmotion "
        << result.residuals.motion << "\nits rounding " << result.residuals.motion_rounding
        << "\ncomplementarity " << result.residuals.complementarity << "\n"
        << app::write_scene(*scene);
  }
  std::printf("%d scenes, %d with a solution due, %d solved\n", count, due, solved);
  EXPECT_GE(due, count / 4) << "too few scenes are accepted and regular";
  EXPECT_GE(solved, 0.95 * due) << solved << " of " << due;
}

}  // namespace

// The whole structure in the motion of time.method = "exact". The rest:
// tests/analyses/phases_method_test.py.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/bar_scene.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace wavebalance::app {
namespace {

TEST(PhasesMethod, HasTheWholeStructureNearThatOfAFineBalance) {
  const ResponseOptions options{.structure_points = 64};
  const Response phases = phases_response(
      parse_scene(
          bar_scene, "case.toml", std::vector<std::string>{"time.method=exact"},
          std::vector<std::string>{"time.trial", "time.weight", "time.functions", "time.quadrature_points"}),
      options);
  const Response balance =
      weighted_residual_response(scene_of({"time.functions=1023", "time.quadrature_points=8192"}), options);
  ASSERT_EQ(phases.structure.displacement.rows(), balance.structure.displacement.rows());
  EXPECT_LT((phases.structure.displacement - balance.structure.displacement).norm(),
            1e-5 * balance.structure.displacement.norm());
  EXPECT_LT((phases.structure.velocity - balance.structure.velocity).norm(),
            1e-3 * balance.structure.velocity.norm());
  EXPECT_LE(phases.structure_left_out, 1e-9);
}

}  // namespace
}  // namespace wavebalance::app

// Each strategy of the solvers solves a case that those before it do not.
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "support/summary_value.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {
namespace {

struct StrategyCase {
  std::string strategy;
  std::string scene;  // below reproduce/scenes
  std::vector<std::string> overrides;
};

void PrintTo(const StrategyCase& one, std::ostream* out) { *out << one.strategy << ": " << one.scene; }

class StrategyOf : public ::testing::TestWithParam<StrategyCase> {};

TEST_P(StrategyOf, TheSceneIsTheFirstThatSolvesIt) {
  const auto& [strategy, scene, overrides] = GetParam();
  const Response response = weighted_residual_response(load_scene(WAVEBALANCE_SCENES "/" + scene, overrides));
  EXPECT_TRUE(response.converged) << response.status;
  EXPECT_EQ(response.strategy, strategy);
}

// From rest this chain settles to a motion of the load's period, which 31 functions have no solution near.
TEST(StalledBalance, SaysThatTheStructureSettlesToAMotionOfThisPeriod) {
  const std::vector<std::string> overrides{"contact.law=exponential", "contact.constant=1e5",
                                           "contact.exponent=1e3", "contact.gap=-1e-3",
                                           "forcing.frequency=45"},
      removed{"contact.stiffness"};
  const Record record = analyse(load_scene(WAVEBALANCE_SCENES "/extremes/chain.toml", overrides, removed));
  EXPECT_FALSE(record.converged);
  EXPECT_EQ(value_of<std::int64_t>(record.summary, "attractor_periods"), 1);
  EXPECT_TRUE(warns(record, "settles to a motion of this period"));
}

const std::string chain = "extremes/chain.toml", rigid_bar = "jones_legrand_2014/case1_rigid.toml";

INSTANTIATE_TEST_SUITE_P(
    Scenes, StrategyOf,
    ::testing::Values(StrategyCase{"newton", chain, {"contact.stiffness=1e5"}},
                      StrategyCase{"gap_continuation", chain, {}},
                      StrategyCase{"settling", chain, {"contact.gap=-3e-3", "contact.stiffness=1e7"}},
                      StrategyCase{
                          "residual_homotopy", rigid_bar, {"time.trial=haar", "time.weight=fourier"}}),
    [](const auto& one) { return one.param.strategy; });

}  // namespace
}  // namespace wavebalance::app

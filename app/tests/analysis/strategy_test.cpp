// Each strategy of the solvers solves a case that those before it do not.
#include <gtest/gtest.h>

#include <ostream>
#include <string>
#include <vector>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace wavebalance::app {
namespace {

struct StrategyCase {
  std::string strategy;
  std::string stiffness, gap;  // N/m and m, of both stops of the chain of masses
};

void PrintTo(const StrategyCase& one, std::ostream* out) {
  *out << one.strategy << ": " << one.stiffness << " N/m, " << one.gap << " m";
}

class StrategyOf : public ::testing::TestWithParam<StrategyCase> {};

TEST_P(StrategyOf, TheChainIsTheOneThatItsStopsNeed) {
  const auto& [strategy, stiffness, gap] = GetParam();
  const std::vector<std::string> overrides{"contact.stiffness=" + stiffness, "contact.gap=" + gap};
  const Response response =
      weighted_residual_response(load_scene(WAVEBALANCE_SCENES "/extremes/chain.toml", overrides));
  EXPECT_TRUE(response.converged) << response.status;
  EXPECT_EQ(response.strategy, strategy);
}

INSTANTIATE_TEST_SUITE_P(Stops, StrategyOf,
                         ::testing::Values(StrategyCase{"soft_obstacle", "1e7", "1e-4"},
                                           StrategyCase{"long_segments", "1e7", "-1e-4"},
                                           StrategyCase{"small_factors", "1e9", "-1e-4"},
                                           StrategyCase{"fixed_factor", "1e7", "0"},
                                           StrategyCase{"stiff_obstacle", "1e9", "1e-4"}),
                         [](const auto& one) { return one.param.strategy; });

}  // namespace
}  // namespace wavebalance::app

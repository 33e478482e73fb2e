// The sweep of [JL14, Fig. 12] with the Nyquist coefficient dropped, in every pair, number of functions and
// length of step.

#include "pairs.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"

namespace wavebalance::pairs {
namespace {

solvers::FrequencySweep case_2_sweep(const Pair& pair, int functions, double largest_step) {
  solvers::TimePairOptions how = paper_options(pair, functions);
  how.nyquist = solvers::NyquistCoefficient::drop;
  const Case& scene = cases[1];
  solvers::CondensedProblem problem(time_pair(pair, functions, how), scene.structure(),
                                    Eigen::Vector2cd(0.0, 1.0));
  solvers::FrequencySweepOptions options;
  options.from = 1100.0;
  options.to = 1700.0;
  options.output_points = 64;
  auto& arc = options.arc_length;
  arc.parameter_scale = 30.0;
  arc.max_step = largest_step / arc.parameter_scale;
  arc.initial_step = 0.5 * arc.max_step;
  return solvers::frequency_sweep(problem, scene.law(), options);
}

struct Size {
  Pair pair;
  int functions;
};

class SweepSteps : public ::testing::TestWithParam<Size> {};

TEST_P(SweepSteps, DoNotChangeTheTurningPoints) {
  const auto& [pair, functions] = GetParam();
  const solvers::FrequencySweep finest = case_2_sweep(pair, functions, 1.0);
  ASSERT_EQ(finest.status, solvers::SweepStatus::reached_end);
  ASSERT_GE(finest.turning_points.size(), 2u);
  for (const double step : {2.0, 5.0, 10.0}) {
    const solvers::FrequencySweep sweep = case_2_sweep(pair, functions, step);
    EXPECT_EQ(sweep.status, solvers::SweepStatus::reached_end) << step;
    ASSERT_EQ(sweep.turning_points.size(), finest.turning_points.size()) << step;
    for (std::size_t i = 0; i < finest.turning_points.size(); ++i)
      EXPECT_NEAR(sweep.turning_points[i].frequency, finest.turning_points[i].frequency, 0.1) << step;
  }
}

std::vector<Size> sizes() {
  std::vector<Size> all;
  for (const Pair& pair : table_2)
    for (const int functions : {32, 64}) all.push_back({pair, functions});
  all.push_back({table_2[0], 63});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Paper, SweepSteps, ::testing::ValuesIn(sizes()), [](const auto& one) {
  return std::string(one.param.pair.name) + "_" + std::to_string(one.param.functions);
});

}  // namespace
}  // namespace wavebalance::pairs

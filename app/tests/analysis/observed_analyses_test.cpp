// Calls of an observer, and records after an observer stopped the analysis.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/bar_scene.hpp"
#include "support/stop_scene.hpp"
#include "support/summary_value.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {
namespace {

Record record_of(const std::vector<std::string>& overrides, const Observer& observer) {
  return analyse(parse_scene(stop_scene, "stop.toml", overrides), observer);
}

// Stopped for good at the first step of a phase.
Observer stop_at(const std::string& phase) {
  return [phase, stopped = false](const solvers::Progress& progress) mutable {
    stopped = stopped || progress.phase == phase;
    return !stopped;
  };
}

TEST(ObservedAnalysis, IsToldOfPeriods) {
  int calls = 0;
  double last = 0.0;
  analyse(scene_of({"analysis.type=time_stepping", "analysis.tolerance=1e-3"}),
          [&](const Progress& progress) {
            ++calls;
            last = progress.done;
            EXPECT_EQ(progress.phase, "time stepping");
            return true;
          });
  EXPECT_GE(calls, 2);
  EXPECT_EQ(last, 1.0);
}

TEST(InterruptedSweep, HoldsThePointsSoFar) {
  int points = 0;
  const Record record = analyse(scene_of(sweep_overrides), [&](const Progress& progress) {
    points += progress.phase == "frequency sweep" ? 1 : 0;
    return points < 3;
  });
  EXPECT_TRUE(record.interrupted);
  EXPECT_FALSE(record.converged);
  EXPECT_EQ(record.status, "interrupted");
  EXPECT_EQ(record.sweep.rows(), 3u);
  EXPECT_EQ(value_of<std::string>(record.summary, "status"), "interrupted");
}

TEST(InterruptedSweep, HasNotConvergedWhereverTheInterruptionCame) {
  for (const std::string phase : {"frequency sweep", "stability", "motions"}) {
    const Record record = record_of({"analysis.motion_at=[\"peak\", 0.18, 0.24]"}, stop_at(phase));
    EXPECT_TRUE(record.interrupted) << phase;
    EXPECT_FALSE(record.converged) << phase;
    EXPECT_EQ(record.status, "interrupted") << phase;
    EXPECT_TRUE(warns(record, "before these motions were computed: peak, 0.18Hz, 0.24Hz.")) << phase;
  }
}

TEST(InterruptedSweep, SaysSoOnABranch) {
  bool main_is_done = false;
  const std::vector<std::string> doublings{
      "structure.stiffness_damping=0.1", "contact.stiffness=10.0",     "contact.gap=0.1",
      "forcing.amplitude=0.8",           "time.quadrature_points=512", "analysis.frequency_from=0.33",
      "analysis.frequency_to=0.5",       "analysis.branches=true"};
  const Record record = record_of(doublings, [&](const Progress& progress) {
    main_is_done = main_is_done || progress.phase == "stability";
    return !(main_is_done && progress.phase == "frequency sweep");
  });
  EXPECT_TRUE(record.interrupted);
  EXPECT_EQ(value_of<Table>(record.summary, "branches").texts("end"),
            std::vector<std::string>{"interrupted"});
}

TEST(InterruptedSweep, MarksThePointsWithoutExactSolutions) {
  int calls = 0;
  AnalysisOptions how;
  how.threads = 1;
  how.observer = [&](const Progress& progress) { return progress.phase != "exact solution" || ++calls < 5; };
  const Record record =
      analyse(parse_scene(stop_scene, "stop.toml",
                          std::vector<std::string>{"analysis.phases=true", "time.functions=31"}),
              how);
  EXPECT_EQ(calls, 5);
  EXPECT_TRUE(record.interrupted);
  EXPECT_FALSE(record.converged);
  EXPECT_EQ(record.status, "interrupted");
  EXPECT_EQ(record.sweep.texts("phases_status").back(), "not_computed");
  EXPECT_EQ(record.sweep.texts("stability_by").back(), "balance");
}

TEST(InterruptedExactSweep, HasItsPointsSoFar) {
  const Record record = record_of({"analysis.exact=true"}, [](const solvers::Progress& progress) {
    return progress.phase != "exact curve" || progress.step < 9;
  });
  EXPECT_FALSE(record.converged);
  EXPECT_TRUE(record.interrupted);
  EXPECT_EQ(record.status, "interrupted");
  EXPECT_GT(record.sweep.rows(), 5u);
}

TEST(InterruptedExactSweep, SaysSoAtOnceWhateverItHas) {
  const Record record = record_of({"analysis.frequency_from=0.18", "analysis.exact=true"},
                                  [](const solvers::Progress&) { return false; });
  EXPECT_EQ(record.status, "interrupted");
  EXPECT_LE(record.sweep.rows(), 1u);
}

}  // namespace
}  // namespace wavebalance::app

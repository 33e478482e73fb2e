// The sweep of a blade with many contacts, by steps and through every grazing event.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {
namespace {

/// The scene with fewer elements, loaded by 1.5 times its force, about its resonance, with 640 samples.
Scene blade_scene() {
  return load_scene(std::string(WAVEBALANCE_SCENES) + "/blade/sweep.toml",
                    std::vector<std::string>{"structure.chord_elements=3", "structure.span_elements=6",
                                             "forcing.amplitude=30", "analysis.frequency_from=590",
                                             "analysis.frequency_to=670", "analysis.output_points=64",
                                             "time.quadrature_points=80"});
}

solvers::FrequencySweep sweep_of(const StructureModel& model, const Scene& scene,
                                 solvers::GrazingEvents events) {
  solvers::FrequencySweepOptions options;
  options.from = scene.analysis.frequency_from;
  options.to = scene.analysis.frequency_to;
  options.output_points = scene.analysis.output_points;
  options.arc_length.grazing_events = events;
  return compose_problem(scene, model).sweep(options);
}

double largest_displacement(const solvers::FrequencySweep& sweep) {
  double largest = 0.0;
  for (const solvers::SweepPoint& point : sweep.points) largest = std::max(largest, point.max_displacement);
  return largest;
}

// 640 samples are more than those whose grazing events are all solved for.
TEST(BladeSweepOfManySamples, HasThePeakAndTheFoldsOfTheOneThroughEveryGrazingEvent) {
  const Scene scene = blade_scene();
  const StructureModel model = make_model(scene);
  const solvers::FrequencySweep steps = sweep_of(model, scene, solvers::GrazingEvents::automatic),
                                events = sweep_of(model, scene, solvers::GrazingEvents::all);
  ASSERT_EQ(steps.status, solvers::SweepStatus::reached_end);
  ASSERT_EQ(events.status, solvers::SweepStatus::reached_end);
  EXPECT_LT(3 * steps.points.size(), events.points.size());
  EXPECT_NEAR(largest_displacement(steps), largest_displacement(events), 1e-3 * largest_displacement(events));
  ASSERT_EQ(steps.turning_points.size(), events.turning_points.size());
  ASSERT_GE(steps.turning_points.size(), 2u);
  for (std::size_t i = 0; i < steps.turning_points.size(); ++i)
    EXPECT_NEAR(steps.turning_points[i].frequency, events.turning_points[i].frequency, 0.1);
}

}  // namespace
}  // namespace wavebalance::app

// The sweep of a blade with many contacts, in pairs with an odd and an even number of functions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/scene_loader.hpp"

namespace wavebalance::app {
namespace {

struct Discretisation {
  const char *trial, *weight;
  int functions;
};

/// The scene with fewer elements, loaded by 1.5 times its force, about its resonance.
Scene blade_scene(const Discretisation& time) {
  return load_scene(std::string(WAVEBALANCE_SCENES) + "/blade/sweep.toml",
                    std::vector<std::string>{"structure.chord_elements=3", "structure.span_elements=6",
                                             "forcing.amplitude=30", "analysis.frequency_from=590",
                                             "analysis.frequency_to=670", "analysis.output_points=64",
                                             "time.trial=" + std::string(time.trial),
                                             "time.weight=" + std::string(time.weight),
                                             "time.functions=" + std::to_string(time.functions)});
}

/// Relative distance of a largest displacement from the nearest part of a curve at its frequency.
double distance_from(const std::vector<solvers::SweepPoint>& points, double frequency, double displacement) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < points.size(); ++i) {
    const auto &a = points[i - 1], &b = points[i];
    if ((a.frequency - frequency) * (b.frequency - frequency) > 0.0 || a.frequency == b.frequency) continue;
    const double share = (frequency - a.frequency) / (b.frequency - a.frequency);
    const double found = a.max_displacement + share * (b.max_displacement - a.max_displacement);
    least = std::min(least, std::abs(found - displacement) / displacement);
  }
  return least;
}

class BladeSweep : public ::testing::TestWithParam<Discretisation> {};

TEST_P(BladeSweep, ReachesItsEndThroughTheResponsesAtSingleFrequencies) {
  Scene scene = blade_scene(GetParam());
  const StructureModel model = make_model(scene);
  const Sweep sweep = frequency_sweep(scene, model);
  ASSERT_EQ(sweep.status(), "reached_end");
  EXPECT_GE(sweep.curve.turning_points.size(), 2u);
  scene.analysis.type = AnalysisType::forced_response;
  scene.analysis.motion_points = 0;
  for (const double frequency : {610.0, 635.0, 660.0}) {
    scene.forcing.frequency = frequency;
    const Response response = weighted_residual_response(scene, model, {});
    ASSERT_TRUE(response.converged) << frequency;
    const double largest = response.contacts.displacement.maxCoeff();
    EXPECT_LT(distance_from(sweep.curve.points, frequency, largest), 2e-3) << frequency;
  }
}

INSTANTIATE_TEST_SUITE_P(Pairs, BladeSweep,
                         ::testing::Values(Discretisation{"fourier", "fourier", 16},
                                           Discretisation{"haar", "fourier", 16}));

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
  Scene scene = blade_scene({"fourier", "fourier", 15});
  scene.time.quadrature_points = 80;
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

// Collocation on contact intervals as a reference that is stopped early, and from a balance of few functions.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "compare/exact_reference.hpp"
#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {
namespace {

constexpr int error_points = 1024;

Scene jones_legrand(const std::string& name) {
  return load_scene(WAVEBALANCE_SCENES "/jones_legrand_2014/" + name + ".toml");
}

TEST(ExactReference, IsCheckedByASecondMotionWhereverItIsStopped) {
  Scene scene = jones_legrand("case2");
  scene.analysis.output_points = error_points;
  const StructureModel model = make_model(scene);
  std::optional<Guide> guide = refined_guide(scene, model, 1e-3, {});
  ASSERT_TRUE(guide);
  const ExactReference whole = exact_reference(*guide, {});
  ASSERT_EQ(whole.missing_because, "");
  int known = 0, unknown = 0;
  for (int steps = 0; steps < 40; steps += 2) {
    int left = steps;
    const ExactReference found = exact_reference(*guide, [&left](const Progress&) { return left-- > 0; });
    if (!found.missing_because.empty()) {
      ++unknown;
      continue;
    }
    ++known;
    EXPECT_TRUE(std::isfinite(found.force_error)) << steps << " steps";
    EXPECT_LE(displacement_error(found.contacts, whole.contacts), found.error + whole.error)
        << steps << " steps";
  }
  EXPECT_GT(known, 0);
  EXPECT_GT(unknown, 0);
}

MeasuredScene measured_scene(const Scene& scene, const Reference& reference) {
  return {scene, make_model(scene), reference.motion, ErrorMeasure::both};
}

TEST(ExactStudy, FindsTheMotionFromABalanceOfThreeFunctions) {
  const Scene scene = jones_legrand("case1");
  constexpr double seconds = 5.0;
  const Reference reference = find_reference(scene, make_model(scene), error_points, seconds);
  EXPECT_TRUE(reference.stability.is_exact);
  ExactStudyOptions options;
  options.solve = {.budget = 0.0, .least = 1, .max_seconds = 0.0};
  options.tolerances = {1e-8};
  options.first_functions = 3;
  const std::vector<SolvePoint> points = exact_study(measured_scene(scene, reference), reference, options);
  ASSERT_GE(points.size(), 2u);  // how many lie between depends on rounding
  EXPECT_EQ(points.front().functions, 3);
  EXPECT_TRUE(points.front().converged);
  EXPECT_LT(points.front().displacement_error, 1e-5);
  EXPECT_EQ(points.back().tolerance, 1e-8);
  EXPECT_TRUE(points.back().converged);
}

}  // namespace
}  // namespace wavebalance::app

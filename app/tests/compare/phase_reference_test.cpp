#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "compare/phase_reference.hpp"
#include "period_oracle/rigid_reference.hpp"
#include "period_oracle/shooting.hpp"
#include "support/bar_scene.hpp"
#include "support/brief_comparison.hpp"
#include "support/chain_files.hpp"
#include "support/closed_stop.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/compare/comparison_figure.hpp"
#include "wavebalance/app/compare/phase_study.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {
namespace {

constexpr int error_points = 1024;

Scene jones_legrand(const std::string& name) {
  return load_scene(WAVEBALANCE_SCENES "/jones_legrand_2014/" + name + ".toml");
}

Reference reference_of(const Scene& scene, double seconds = 5.0) {
  return find_reference(scene, make_model(scene), error_points, seconds);
}

Scene chain(const TemporaryFolder& folder, const std::vector<std::string>& more = {}) {
  write_chain(folder);
  std::vector<std::string> changes{"forcing.frequency=30", "forcing.amplitude=300",
                                   "structure.modal_damping=0.1"};
  changes.insert(changes.end(), more.begin(), more.end());
  return load_scene(folder.write("chain.toml", chain_scene), changes);
}

class PhaseReferenceOfJonesLegrand : public testing::TestWithParam<const char*> {};

TEST_P(PhaseReferenceOfJonesLegrand, IsTheMotionThatShootingFinds) {
  const Scene scene = jones_legrand(GetParam());
  const Reference reference = reference_of(scene);
  ASSERT_TRUE(reference.converged);
  EXPECT_EQ(reference.kind, "phases");
  EXPECT_LE(reference.error, 1e-12);
  EXPECT_LT(reference.force_error, 1e-7);
  EXPECT_EQ(reference.stability.status, "stable");
  EXPECT_TRUE(reference.stability.by_phases);
  oracle::ShootingOptions options;
  options.output_points = error_points;
  const auto independent =
      oracle::shoot(make_model(scene).structure, make_law(scene.contact), scene.forcing.frequency, options);
  ASSERT_EQ(independent.status, oracle::ShootingStatus::converged);
  // The steps of shooting end on 1e-11.
  EXPECT_LT(displacement_error(independent.contacts, reference.motion), 1e-9);
  EXPECT_LT(force_error(independent.contacts, reference.motion), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(Cases, PhaseReferenceOfJonesLegrand, testing::Values("case1", "case2"),
                         [](const auto& one) { return std::string(one.param); });

class PhaseReferenceOfRigidBars : public testing::TestWithParam<const char*> {};

TEST_P(PhaseReferenceOfRigidBars, IsTheMotionOfFreeAndClosedBarInTurn) {
  const Scene scene = jones_legrand(GetParam());
  const Reference reference = reference_of(scene, 30.0);  // a bound for a machine with other work
  ASSERT_TRUE(reference.converged);
  EXPECT_EQ(reference.kind, "phases");
  EXPECT_EQ(reference.without_phases, "");
  EXPECT_LE(reference.error, 1e-12);
  EXPECT_LT(reference.force_error, 1e-9);
  EXPECT_EQ(reference.stability.status, "stable");
  constexpr double repeats = 1e-13;  // of a period
  const auto joined = oracle::rigid_reference(make_model(scene).structure, scene.contact.gap,
                                              scene.forcing.frequency, error_points, repeats);
  ASSERT_TRUE(joined.converged);
  // The instants of the flows are known to 2^-32 of a sample, and the force begins as steeply as 1 / sqrt(t).
  const solvers::Motion independent{joined.displacement.transpose(), {}, joined.contact_force.transpose()};
  EXPECT_LT(displacement_error(independent, reference.motion), 1e-10);
  EXPECT_LT(force_error(independent, reference.motion), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Cases, PhaseReferenceOfRigidBars, testing::Values("case1_rigid", "case2_rigid"),
                         [](const auto& one) { return std::string(one.param); });

/// Relative distance of the displacements from those of time stepping.
double distance_from_stepping(Scene scene, const Reference& reference) {
  scene.analysis.type = AnalysisType::time_stepping;
  scene.analysis.tolerance = 1e-8;
  scene.analysis.output_points = error_points;
  const Response stepped = time_stepping_response(scene);
  EXPECT_TRUE(stepped.converged) << stepped.status;
  return displacement_error(stepped.contacts, reference.motion);
}

TEST(PhaseReference, OfSeveralContactsIsTheMotionThatTimeSteppingFinds) {
  const TemporaryFolder folder;
  const Scene scene = chain(folder);
  const Reference reference = reference_of(scene);
  ASSERT_TRUE(reference.converged) << reference.status;
  EXPECT_EQ(reference.kind, "phases");
  EXPECT_LE(reference.error, 1e-11);
  EXPECT_LT(distance_from_stepping(scene, reference), 1e-6);
}

TEST(PhaseReference, OfForcesOfTheVelocityAndDampingThatCouplesIsTheMotionThatTimeSteppingFinds) {
  const TemporaryFolder folder;
  const Scene scene = closed_stop(folder);
  const Reference reference = reference_of(scene);
  ASSERT_TRUE(reference.converged) << reference.status;
  EXPECT_EQ(reference.kind, "phases");
  EXPECT_LE(reference.error, 1e-10);
  EXPECT_LT(distance_from_stepping(scene, reference), 1e-6);
}

TEST(PhaseReference, IsNoneOfALossFactorWhichHasTheRefinedBalanceAndTheReason) {
  const TemporaryFolder folder;
  const Reference reference = reference_of(chain(folder, {"structure.loss_factor=0.01"}));
  ASSERT_TRUE(reference.converged) << reference.status;
  EXPECT_EQ(reference.kind, "finer_balance");
  EXPECT_EQ(reference.without_phases, "a loss factor has no equation in time");
  EXPECT_LT(reference.error, 1e-4);
  // The last two levels of the balance.
  EXPECT_GT(reference.force_error, reference.error);
  EXPECT_LT(reference.force_error, 1e-1);
}

TEST(PhaseReference, IsCheckedByASecondMotionWhereverItIsStopped) {
  Scene scene = jones_legrand("case2");
  scene.analysis.output_points = error_points;
  const StructureModel model = make_model(scene);
  std::optional<Guide> guide = refined_guide(scene, model, 1e-3, {});
  ASSERT_TRUE(guide);
  const PhaseReference whole = phase_reference(*guide, {});
  ASSERT_EQ(whole.missing_because, "");
  int known = 0, unknown = 0;
  for (int steps = 0; steps < 40; steps += 2) {
    int left = steps;
    const PhaseReference found = phase_reference(*guide, [&left](const Progress&) { return left-- > 0; });
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

TEST(PhaseStudy, HasErrorsThatFallWithTheToleranceAndAreNotBelowThatOfTheReference) {
  const Scene scene = jones_legrand("case2");
  const Reference reference = reference_of(scene);
  ASSERT_EQ(reference.kind, "phases");
  PhaseStudyOptions options;
  options.solve = {.budget = 0.0, .least = 1, .max_seconds = 0.0};
  const std::vector<SolvePoint> points = phase_study(measured_scene(scene, reference), reference, options);
  ASSERT_GE(points.size(), options.tolerances.size());
  double loosest = 0.0, tightest = 1.0;
  for (const SolvePoint& point : points) {
    EXPECT_EQ(point.method, "phases");
    EXPECT_TRUE(point.pair.is_phases());
    ASSERT_TRUE(point.converged) << point.status;
    EXPECT_LE(point.displacement_error, point.tolerance);
    EXPECT_GE(point.displacement_error, reference.error);
    EXPECT_EQ(point.error, std::max(point.displacement_error, point.force_error));
    EXPECT_GT(point.seconds, 0.0);
    EXPECT_EQ(point.points, 4 * (point.functions + 1));
    if (point.tolerance == options.tolerances.front()) loosest = point.error;
    if (point.tolerance == options.tolerances.back()) tightest = point.error;
  }
  EXPECT_LT(tightest, 1e-6 * loosest);
}

TEST(PhaseStudy, FindsTheMotionFromABalanceOfThreeFunctions) {
  const Scene scene = jones_legrand("case1");
  const Reference reference = reference_of(scene);
  PhaseStudyOptions options;
  options.solve = {.budget = 0.0, .least = 1, .max_seconds = 0.0};
  options.tolerances = {1e-8};
  options.first_functions = 3;
  const std::vector<SolvePoint> points = phase_study(measured_scene(scene, reference), reference, options);
  ASSERT_GE(points.size(), 2u);  // how many lie between depends on rounding
  EXPECT_EQ(points.front().functions, 3);
  EXPECT_TRUE(points.front().converged);
  EXPECT_LT(points.front().displacement_error, 1e-5);
  EXPECT_EQ(points.back().tolerance, 1e-8);
  EXPECT_TRUE(points.back().converged);
}

TEST(Comparison, DrawsContactPhasesBesideThePairsAndCountsTheirRows) {
  const Comparison found = compare_responses(scene_of(), brief(3.0));
  const PairResult& last = found.pairs.back();
  ASSERT_EQ(last.pair, BasisPair::phases());
  EXPECT_GE(last.converged, 2);
  EXPECT_TRUE(std::isnan(last.order));
  const auto names_phases = [](const Series& one) { return one.label == "contact phases"; };
  const Figure over_time = error_over_time(found), over_functions = error_over_functions(found);
  const auto& drawn = over_time.panels.front().series;
  const auto line = std::find_if(drawn.begin(), drawn.end(), names_phases);
  ASSERT_NE(line, drawn.end());
  EXPECT_GE(line->x.size(), 2u);
  // Their functions are those of the balance that they start from.
  const auto& others = over_functions.panels.front().series;
  EXPECT_TRUE(std::none_of(others.begin(), others.end(), names_phases));
}

}  // namespace
}  // namespace wavebalance::app

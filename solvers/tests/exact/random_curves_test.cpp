// Curves of random structures on supports and between stops: the same ends and folds by default steps and by
// steps ten times smaller.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "campaign.hpp"
#include "support/random_curve.hpp"
#include "wavebalance/solvers/problem/structure_points.hpp"

namespace wavebalance::solvers {
namespace {

ExactCurve traced(const testing::RandomCurve& drawn, double share_of_steps) {
  ExactCurveOptions options;
  options.from = drawn.from;
  options.to = drawn.to;
  options.first_step *= share_of_steps;
  options.largest_step *= share_of_steps;
  options.max_points = static_cast<int>(1500.0 / share_of_steps);
  options.stability = false;
  return drawn.problem(63, 512).exact_sweep(options);
}

std::vector<double> folds_of(const ExactCurve& curve) {
  std::vector<double> folds;
  for (const ExactEvent& event : curve.events)
    if (event.type == SpecialPointType::fold) folds.push_back(event.value);
  return folds;
}

bool ends(const ExactCurve& curve) {
  return curve.status == SweepStatus::reached_end || curve.status == SweepStatus::returned;
}

// Folds that lie at grazing to six digits are told apart to as many.
bool are_equal(const ExactCurve& one, const ExactCurve& other) {
  constexpr double digits = 1e-6;
  const std::vector<double> a = folds_of(one), b = folds_of(other);
  bool equal = one.status == other.status && a.size() == b.size();
  for (std::size_t i = 0; equal && i < a.size(); ++i) equal = std::abs(a[i] - b[i]) <= digits * a[i];
  return equal;
}

TEST(RandomCurves, HaveTheSameEndsAndFoldsByStepsTenTimesSmaller) {
  const int count = campaign_seeds(8, 100);
  int same = 0, folds = 0;
  for (int seed = 1; seed <= count; ++seed) {
    const testing::RandomCurve drawn = testing::random_curve(static_cast<unsigned>(seed));
    const ExactCurve usual = traced(drawn, 1.0);
    const bool equal = ends(usual) && are_equal(usual, traced(drawn, 0.1));
    if (!equal) std::printf("seed %d: %s\n", seed, std::string(to_string(usual.status)).c_str());
    same += equal ? 1 : 0;
    folds += static_cast<int>(folds_of(usual).size());
  }
  std::printf("%d of %d curves the same, %d folds\n", same, count, folds);
  // 97 of 100, and all of the first 8; seeds 16, 28 and 73 are lost or do not end.
  EXPECT_GE(100 * same, 95 * count);
  EXPECT_GT(folds, count);
}

// A balance with 63 functions has other folds, and may pass some of the structure's by.
TEST(RandomCurves, HaveAllTheirFoldsBesideASweepWithDefaultSteps) {
  const int count = campaign_seeds(6, 100);
  int same = 0;
  for (int seed = 1; seed <= count; ++seed) {
    const testing::RandomCurve drawn = testing::random_curve(static_cast<unsigned>(seed));
    const auto make = [&] { return drawn.problem(63, 252); };
    FrequencySweepOptions options;
    options.from = drawn.from;
    options.to = drawn.to;
    options.keep_unknowns = true;
    const StructurePoints found =
        structure_points(make, make().sweep(options), {}, {.from = drawn.from, .to = drawn.to});
    ExactCurve of_structure;
    of_structure.events = found.events;
    const ExactCurve exact = traced(drawn, 1.0);
    of_structure.status = exact.status;
    same += found.whole && !found.apart && are_equal(of_structure, exact) ? 1 : 0;
  }
  std::printf("%d of %d sweeps tell all folds\n", same, count);
  // All of the first 6; seeds 16, 28 and 73 have no exact curve.
  EXPECT_GE(100 * same, 95 * count);
}

}  // namespace
}  // namespace wavebalance::solvers

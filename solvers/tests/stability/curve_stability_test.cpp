#include "wavebalance/solvers/stability/curve_stability.hpp"

#include "stability/curve_motions.hpp"
#include "stability/stability_checks.hpp"
#include "stability/winding.hpp"
#include "support/oscillator.hpp"
#include "support/refusal.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

using Type = SpecialPointType;

/// A curve with its stability.
struct Traced {
  FrequencySweep curve;
  CurveStability stability;

  std::vector<SpecialPoint> of(Type type) const {
    std::vector<SpecialPoint> found;
    for (const SpecialPoint& point : stability.special_points)
      if (point.type == type) found.push_back(point);
    return found;
  }
};

Traced trace(const LinearStructure& structure, const ContactLaws& laws, double from, double to, int functions,
             int points) {
  CondensedProblem problem = testing::fourier_problem(structure, functions, points);
  FrequencySweepOptions options = testing::between(from, to);
  Traced traced;
  traced.curve = frequency_sweep(problem, laws, options);
  traced.stability = curve_stability(problem, laws, traced.curve, ContactDynamics(structure));
  return traced;
}

// The counts along a curve where they are known, each as long as it lasts.
std::vector<int> changes_of_counts(const CurveStability& stability) {
  std::vector<int> counts;
  for (const PointStability& point : stability.points)
    if (point.status == StabilityStatus::converged && (counts.empty() || counts.back() != point.unstable))
      counts.push_back(point.unstable);
  return counts;
}

TEST(CurveStability, IsLostBetweenTheFoldsOfTheSamplesAtAMultiplierOf1) {
  const LinearStructure bar = testing::jl14_case_2.structure();
  const Traced traced = trace(bar, testing::jl14_case_2.law, 1100.0, 1700.0, 63, 1024);
  EXPECT_EQ(changes_of_counts(traced.stability), (std::vector<int>{0, 1, 0}));
  const auto folds = traced.of(Type::fold);
  ASSERT_EQ(folds.size(), 2u);
  ASSERT_EQ(traced.curve.turning_points.size(), 2u);
  for (std::size_t i = 0; i < folds.size(); ++i) {
    EXPECT_TRUE(folds[i].located);
    EXPECT_NEAR(folds[i].frequency, traced.curve.turning_points[i].frequency, 0.02);
    EXPECT_LE(folds[i].bracket, 1e-5);
    EXPECT_LE(std::abs(folds[i].multiplier - 1.0), 1e-5);
    EXPECT_NEAR(folds[i].max_displacement, traced.curve.turning_points[i].max_displacement, 2e-5);
  }
  EXPECT_TRUE(traced.of(Type::branch).empty());
  EXPECT_TRUE(traced.of(Type::period_doubling).empty());
  EXPECT_TRUE(traced.of(Type::neimark_sacker).empty());
}

/// Two masses of 1 with springs of 1 between them and to the ground, the second driven, C = 0.03 K.
LinearStructure two_masses() {
  Eigen::Matrix2d stiffness;
  stiffness << 1.0, -1.0, -1.0, 2.0;
  return testing::structure(Eigen::MatrixXd::Identity(2, 2), 0.03 * stiffness, stiffness,
                            Eigen::Vector2d(0.0, 0.1), contact_rows({0}, 2));
}

// Contact begins at 1e-6 from the Neimark-Sacker point, with a kink of the curve between them. References:
// the grazing is in closed form, the other by event-driven shooting.
TEST(CurveStability, TellsAGrazingFromANeimarkSackerPointBesideItFromAnyStart) {
  for (const double from : {0.0945, 0.0950, 0.0955, 0.0960, 0.0965, 0.0970, 0.0975}) {
    const Traced traced = trace(two_masses(), testing::LinearContact{100.0, 1.0}, from, 0.092, 63, 1024);
    const auto grazings = traced.of(Type::grazing), torus = traced.of(Type::neimark_sacker);
    ASSERT_EQ(grazings.size(), 1u) << from;
    ASSERT_EQ(torus.size(), 1u) << from;
    EXPECT_TRUE(grazings[0].located && torus[0].located) << from;
    EXPECT_NEAR(two_pi * grazings[0].frequency, 0.5818996390, 1e-7) << from;
    EXPECT_NEAR(two_pi * torus[0].frequency, 0.5819006504, 1e-7) << from;
  }
}

/// Counts along a curve, where contact acts, compared with counts by the winding of the polynomial.
struct Counts {
  std::vector<int> found, wound, evaluations;
};

Counts counts_along(const LinearStructure& structure, const ContactLaws& laws, double from, double to) {
  CondensedProblem problem = testing::fourier_problem(structure, 63, 512);
  const ContactDynamics dynamics(structure);
  const FrequencySweep curve = frequency_sweep(problem, laws, testing::between(from, to));
  CurveMotions motions("counts_along", problem, laws, curve, {}, 64);
  StabilityOptions options = with_harmonics_of(problem.pair(), {});
  options.leading = false;
  Counts counts;
  for (const SweepPoint& point : curve.points) {
    const PeriodicResponse at = motions.response(motions.at(point));
    const PeriodicStiffness stiffness = contact_stiffness(problem, laws, at);
    if (stiffness.status != StabilityStatus::converged) continue;
    auto determinant = resolving_determinant(dynamics, stiffness, at.frequency, options.harmonics,
                                             options.harmonics, options.max_omitted);
    if (!determinant || determinant->nodes() == 0) continue;
    const auto polynomial = polynomial_change(*determinant, options.max_evaluations);
    if (!polynomial) continue;
    const UnstableMultipliers count = unstable_multipliers(dynamics, stiffness, at.frequency, options);
    counts.found.push_back(count.count);
    counts.wound.push_back(int(std::lround(polynomial->own - polynomial->change / std::numbers::pi)));
    counts.evaluations.push_back(count.evaluations);
  }
  return counts;
}

// The quick way against the plain one, along curves with folds, a period doubling and a Neimark-Sacker point.
TEST(CurveStability, CountsByTwoRealDeterminantsAsByTheWindingOfThePolynomial) {
  const std::vector<Counts> curves{
      counts_along(testing::jl14_case_2.structure(), testing::jl14_case_2.law, 1100.0, 1700.0),
      counts_along(testing::unit_oscillator(0.1, 0.8), testing::LinearContact{10.0, 0.1}, 2.0 / two_pi,
                   3.2 / two_pi),
      counts_along(two_masses(), testing::LinearContact{100.0, 1.0}, 0.0945, 0.085)};
  std::size_t points = 0, quick = 0;
  std::vector<int> most;
  for (const Counts& counts : curves) {
    ASSERT_GT(counts.found.size(), 10u);
    EXPECT_EQ(counts.found, counts.wound);
    most.push_back(std::ranges::max(counts.found));
    points += counts.found.size();
    quick += std::size_t(std::ranges::count(counts.evaluations, 2));
  }
  EXPECT_EQ(most, (std::vector<int>{1, 1, 2}));
  EXPECT_GT(10 * quick, 9 * points);
}

TEST(CurveStability, OfAnUndampedStructureIsNotKnown) {
  const Traced traced =
      trace(testing::unit_oscillator(0.0, 0.8), testing::LinearContact{10.0, 0.1}, 0.3, 0.4, 15, 64);
  EXPECT_EQ(traced.stability.status(), StabilityStatus::undamped);
  for (const PointStability& point : traced.stability.points) EXPECT_EQ(point.unstable, -1);
}

TEST(CurveStability, NeedsTheUnknownsOfTheCurve) {
  const LinearStructure structure = testing::unit_oscillator(0.1, 0.8);
  const testing::LinearContact stop{10.0, 0.1};
  CondensedProblem problem = testing::fourier_problem(structure, 15, 64);
  FrequencySweepOptions forgetting = testing::between(0.3, 0.4);
  forgetting.keep_unknowns = false;
  const FrequencySweep curve = frequency_sweep(problem, stop, forgetting);
  EXPECT_NE(testing::refusal([&] {
              curve_stability(problem, stop, curve, ContactDynamics(structure));
            }).find("keep_unknowns"),
            std::string::npos);
}

TEST(CurveStability, StopsWhenItsObserverSaysSo) {
  const LinearStructure structure = testing::unit_oscillator(0.1, 0.8);
  const testing::LinearContact stop{10.0, 0.1};
  CondensedProblem problem = testing::fourier_problem(structure, 15, 64);
  const FrequencySweep curve = frequency_sweep(problem, stop, testing::between(0.3, 0.4));
  CurveStabilityOptions options;
  options.observer = [](const Progress& progress) { return progress.step < 3; };
  const CurveStability stability = curve_stability(problem, stop, curve, ContactDynamics(structure), options);
  EXPECT_TRUE(stability.cancelled);
  EXPECT_EQ(stability.points.size(), 3u);
}

}  // namespace
}  // namespace wavebalance::solvers

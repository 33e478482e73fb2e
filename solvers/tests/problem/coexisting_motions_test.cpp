// All periodic motions of one frequency, by settling from random states and at the boundaries of basins.
#include "wavebalance/solvers/problem/coexisting_motions.hpp"

#include <map>
#include <numeric>

#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

using testing::LinearContact;

/// Between its folds at 0.169936531088 and 0.195690553549 Hz it has two stable motions and one unstable one.
ContactProblem folded() {
  return {testing::fourier_pair(63, 256), testing::unit_oscillator(0.05, 0.15), LinearContact{4.0, 1.0}};
}

/// With a motion of one period that is unstable from 2.2062 to 2.9737 rad/s.
ContactProblem doubling() {
  return {testing::fourier_pair(63, 256), testing::unit_oscillator(0.1, 0.8), LinearContact{10.0, 0.1}};
}

int stable_ones(const CoexistingMotions& all) {
  return static_cast<int>(std::count_if(all.motions.begin(), all.motions.end(),
                                        [](const auto& one) { return one.stability.status == "stable"; }));
}

int arrivals(const CoexistingMotions& all) {
  return std::accumulate(all.motions.begin(), all.motions.end(), all.none,
                         [](int sum, const auto& one) { return sum + one.arrivals; });
}

/// Those between the folds, found once.
const CoexistingMotions& between_folds(double frequency) {
  static std::map<double, CoexistingMotions> known;
  const auto [one, is_new] = known.try_emplace(frequency);
  if (is_new) {
    ContactProblem problem = folded();
    one->second = coexisting_motions(problem, frequency, {.random_starts = 6});
  }
  return one->second;
}

// A static load moves the oscillator and its stop: all else equals the one without.
TEST(CoexistingMotions, UnderAStaticLoadHaveTheSharesOfThoseWithoutIt) {
  constexpr double deflection = 40.0;
  LinearStructure loaded = testing::unit_oscillator(0.05, 0.15);
  PeriodicForce weight;
  weight.shape = Eigen::VectorXd::Constant(1, deflection);
  weight.harmonics = Eigen::VectorXcd::Ones(1);
  loaded.forces.push_back(weight);
  ContactProblem under(testing::fourier_pair(63, 256), loaded, LinearContact{4.0, 1.0 + deflection});
  const CoexistingMotions& light = between_folds(0.195);
  const CoexistingMotions heavy = coexisting_motions(under, 0.195, {.random_starts = 6});
  ASSERT_EQ(heavy.motions.size(), light.motions.size());
  EXPECT_GT(light.motions[1].arrivals, 0);
  for (std::size_t i = 0; i < light.motions.size(); ++i) {
    EXPECT_EQ(heavy.motions[i].arrivals, light.motions[i].arrivals);
    EXPECT_NEAR(heavy.motions[i].max_displacement, light.motions[i].max_displacement + deflection, 1e-7);
  }
}

// 600 periods reduce it to a ten-thousandth of its start.
TEST(CoexistingMotions, OfLightDampingCountTheStartsThatHaveNearlyArrived) {
  ContactProblem problem(testing::fourier_pair(63, 256), testing::unit_oscillator(0.008, 0.15),
                         LinearContact{4.0, 1.0});
  const CoexistingMotions all = coexisting_motions(problem, 0.25, {.random_starts = 4});
  ASSERT_EQ(all.motions.size(), 1u);
  EXPECT_EQ(all.motions[0].stability.status, "stable");
  EXPECT_EQ(all.motions[0].arrivals, 4);
  EXPECT_EQ(all.none, 0);
}

TEST(CoexistingMotions, OfThreePeriodsAreABoundaryOfTheBasinOfOneOfOne) {
  ContactProblem problem = doubling();
  const CoexistingMotions all = coexisting_motions(problem, 4.2 / two_pi, {.random_starts = 5});
  ASSERT_EQ(all.motions.size(), 3u);
  EXPECT_EQ(stable_ones(all), 2);
  EXPECT_EQ(all.motions[2].periods, 3);
  EXPECT_EQ(all.motions[2].stability.unstable, 1);
  EXPECT_GT(all.motions[2].stability.leading.real(), 1.0);
}

// At 2.8 rad/s its motion repeats after no number of periods up to sixteen.
TEST(CoexistingMotions, WhereNothingSettlesAreUnstableOnesNearReturns) {
  ContactProblem problem(testing::fourier_pair(63, 256), testing::unit_oscillator(0.1, 1.0),
                         LinearContact{100.0, 0.0});
  const CoexistingMotions all = coexisting_motions(problem, 2.8 / two_pi, {.random_starts = 0});
  EXPECT_EQ(all.status, MotionsStatus::converged);
  ASSERT_EQ(all.motions.size(), 1u);
  EXPECT_EQ(all.motions[0].found_by, MotionSource::newton);
  EXPECT_EQ(all.motions[0].stability.status, "unstable");
  EXPECT_TRUE(std::isnan(all.motions[0].share));
}

// Two oscillators that do not act on each other have as many motions as pairs of theirs.
TEST(CoexistingMotions, OfTwoOscillatorsAreThePairsOfTheirs) {
  const Eigen::Matrix2d mass = Eigen::Matrix2d::Identity(),
                        stiffness = Eigen::Vector2d(1.0, 1.01).asDiagonal();
  const LinearStructure two = testing::structure(mass, 0.05 * mass, stiffness,
                                                 Eigen::Vector2d::Constant(0.15), contact_rows({0, 1}, 2));
  ContactProblem problem(testing::fourier_pair(63, 256), two, LinearContact{4.0, 1.0});
  const CoexistingMotions all = coexisting_motions(problem, 0.18, {.random_starts = 6});
  EXPECT_EQ(stable_ones(all), 4);
  EXPECT_GT(all.motions.size(), 4u);  // and some of the five unstable ones
  EXPECT_EQ(arrivals(all), 6);
  for (const CoexistingMotion& one : all.motions) EXPECT_EQ(one.periods, 1);
}

TEST(CoexistingMotions, EndWhereTheObserverSaysSo) {
  ContactProblem problem = folded();
  int starts = 0, calls = 0;
  MotionsOptions options;
  options.observer = [&](const Progress& progress) {
    starts = static_cast<int>(progress.done * (options.random_starts + 2) + 0.5);
    ++calls;
    return starts < 3;
  };
  const CoexistingMotions all = coexisting_motions(problem, 0.18, options);
  EXPECT_EQ(all.status, MotionsStatus::cancelled);
  EXPECT_EQ(all.starts, 3);
  EXPECT_GE(all.motions.size(), 1u);
}

TEST(CoexistingMotions, RefuseOptionsOutOfRangeAndProblemsOfSeveralPeriods) {
  ContactProblem problem = folded();
  EXPECT_THROW(coexisting_motions(problem, 0.18, {.random_starts = -1}), std::invalid_argument);
  EXPECT_THROW(coexisting_motions(problem, 0.18, {.longest = 0}), std::invalid_argument);
  EXPECT_THROW(coexisting_motions(problem, 0.18, {.tolerance = 0.0}), std::invalid_argument);
  ContactProblem two = problem.over_periods(2);
  EXPECT_THROW(coexisting_motions(two, 0.18), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers

#include "support/collocation_cases.hpp"
#include "support/collocation_stiffness.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"

namespace wavebalance::solvers {
namespace {

using testing::cosine_load, testing::expect_motion, testing::expect_same, testing::HuntCrossley,
    testing::PushingStop, testing::RandomCase;

enum class Kind { dashpot, rising_dashpot, hunt_crossley };

// Laws whose dashpots are so strong that contact ends before the gap, for the stops of a random structure.
ContactLaws pushing_laws(const RandomCase& random, Kind kind) {
  std::vector<AnyContactLaw> list;
  for (int c = 0; c < random.structure.contacts(); ++c) {
    const double gap = random.laws[c].gap(), stiffness = random.laws[c].tangent(2.0 * gap),
                 rate = two_pi * random.frequency;
    if (kind == Kind::hunt_crossley)
      list.emplace_back(HuntCrossley{stiffness / std::sqrt(gap), 1.5, 1.5 / (rate * gap), gap});
    else
      list.emplace_back(
          PushingStop{stiffness, 0.5 * stiffness / rate, gap, kind == Kind::dashpot ? 0.0 : 0.2 * gap});
  }
  return ContactLaws(std::move(list));
}

int releases_of(const ExactSolution& motion, const ContactLaws& laws) {
  int count = 0;
  for (const ForceInterval& interval : motion.intervals) {
    if (interval.always()) continue;
    const double end = motion.displacement(Eigen::VectorXd::Constant(1, interval.end))(interval.contact);
    if (end > laws[interval.contact].gap() * (1.0 + 1e-6)) ++count;
  }
  return count;
}

class IntervalReleases : public ::testing::TestWithParam<Kind> {};

TEST_P(IntervalReleases, EndContactWhereTheForceVanishes) {
  std::mt19937 generator(29);
  int found = 0, solved = 0, releases = 0;
  for (int trial = 0; trial < 12; ++trial) {
    SCOPED_TRACE(trial);
    const RandomCase random(generator, 1 + trial % 3);
    const ContactLaws laws = pushing_laws(random, GetParam());
    CondensedProblem problem = testing::fourier_problem(random.structure, 255, 1024, random.frequency);
    const PeriodicResponse response = forced_response(problem, laws, {});
    if (!response.converged()) continue;
    ++solved;
    const ContactDynamics dynamics(random.structure);
    const ExactNearResponse exact =
        exact_near_response(problem, laws, response, dynamics, {.tolerance = 1e-9});
    if (!exact.motion.converged()) continue;
    ++found;
    releases += releases_of(exact.motion, laws);
    // A power of 3/2 is not analytic where contact begins.
    expect_motion(exact.motion, laws, GetParam() == Kind::hunt_crossley ? 2e-5 : 1e-6);
    EXPECT_LT(exact.displacement_error, 1e-2);
    expect_same(exact.motion.multipliers(),
                monodromy(dynamics, contact_stiffness(exact.motion), random.frequency), 1e-5);
  }
  EXPECT_GE(solved, 10);
  EXPECT_GE(found, 0.95 * solved);
  EXPECT_GE(releases, found);
}

INSTANTIATE_TEST_SUITE_P(Laws, IntervalReleases,
                         ::testing::Values(Kind::dashpot, Kind::rising_dashpot, Kind::hunt_crossley));

// An oscillator whose stop lets it go at 0.257 of the period, before it passes the gap at 0.340. The values
// were computed from the flow, by exponentials of matrices between located events, in another language.
TEST(IntervalReleases, OfAnOscillatorAreThoseOfTheFlow) {
  const LinearStructure structure = testing::unit_oscillator(0.1, 1.0);
  const ContactDynamics dynamics(structure);
  const ContactLaws laws(AnyContactLaw(PushingStop{5.0, 2.5, 0.5}));
  CondensedProblem problem = testing::fourier_problem(structure, 255, 1024, 0.2);
  const ExactSolution motion =
      exact_near_response(problem, laws, forced_response(problem, laws, {}), dynamics, {.tolerance = 1e-11})
          .motion;
  ASSERT_TRUE(motion.converged());
  ASSERT_EQ(motion.intervals.size(), 1u);
  EXPECT_NEAR(motion.intervals[0].begin, 0.08284319588834596, 1e-9);
  EXPECT_NEAR(motion.intervals[0].end, 0.25708609551033634, 1e-9);
  EXPECT_NEAR(motion.displacement(Eigen::VectorXd::Zero(1))(0, 0), -0.7023779, 1e-7);
  EXPECT_NEAR(motion.velocity(Eigen::VectorXd::Zero(1))(0, 0), 2.69438977, 1e-7);
  const Eigen::VectorXcd expected{{{0.24648623, 0.08912041}, {0.24648623, -0.08912041}}};
  expect_same(motion.multipliers(), expected, 1e-7);
  expect_same(monodromy(dynamics, contact_stiffness(motion), 0.2), expected, 1e-7);
}

// A structure that nothing holds but two stops with such dashpots.
TEST(IntervalReleases, OfAStructureThatIsFreeToMoveAreNearItsBalance) {
  const LinearStructure structure = testing::free_pair();
  const ContactDynamics dynamics(structure);
  const ContactLaws laws(
      {AnyContactLaw(PushingStop{300.0, 15.0, 0.0005}), AnyContactLaw(PushingStop{300.0, 15.0, 0.0005})});
  CondensedProblem problem = testing::fourier_problem(structure, 255, 1024, 2.5);
  const PeriodicResponse response = testing::solved_response(problem, laws);
  const ExactNearResponse exact = exact_near_response(problem, laws, response, dynamics, {.tolerance = 1e-9});
  ASSERT_TRUE(exact.motion.converged()) << to_string(exact.motion.status);
  EXPECT_GE(releases_of(exact.motion, laws), 1);
  expect_motion(exact.motion, laws, 1e-6);
  EXPECT_LT(exact.displacement_error, 1e-2);
}

}  // namespace
}  // namespace wavebalance::solvers

#include "support/collocation_cases.hpp"
#include "support/duffing_spring.hpp"
#include "support/rigid_law.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"
#include "wavebalance/solvers/stability/unstable_multipliers.hpp"

namespace wavebalance::solvers {
namespace {

using testing::DampedStop, testing::distance, testing::expect_motion, testing::LinearContact,
    testing::RandomCase, testing::uniform_times;

using testing::Jl14Case;

using testing::cosine_load;

/// A case of the bar with its balance, whose intervals are found to any tolerance.
struct BarCase {
  explicit BarCase(const Jl14Case& jl14, int functions = 63)
      : structure(jl14.structure()),
        law(jl14.law),
        dynamics(structure),
        problem(testing::fourier_pair(functions, 4 * (functions + 1)), structure, cosine_load()) {
    problem.set_frequency(jl14.frequency_hz);
    response = forced_response(problem, law, {});
  }

  ExactNearResponse exact(double tolerance, int max_nodes = 24) const {
    return exact_near_response(problem, law, response, dynamics,
                               {.tolerance = tolerance, .max_nodes = max_nodes});
  }

  LinearStructure structure;
  ContactLaws law;
  ContactDynamics dynamics;
  CondensedProblem problem;
  PeriodicResponse response;
};

TEST(Collocation, OfBothCasesOfTheBarAreWhatTimeSteppingFinds) {
  for (const Jl14Case& jl14 : {testing::jl14_case_1, testing::jl14_case_2}) {
    const BarCase bar(jl14);
    const ExactNearResponse found = bar.exact(1e-11);
    ASSERT_TRUE(found.motion.converged()) << to_string(found.motion.status);
    ASSERT_EQ(found.motion.intervals.size(), 1u);
    EXPECT_NEAR(found.motion.intervals[0].length(), jl14.contact_fraction,
                1.0 / 1024.0);  // a share of samples
    const TimeSteppingResult stepped =
        testing::stepped_motion(bar.structure, bar.law, jl14.frequency_hz, 512);
    EXPECT_LT(distance(found.motion.displacement(uniform_times(512)), stepped.contacts.displacement), 1e-8);
    EXPECT_GT(found.displacement_error, 1e-6);
    EXPECT_LT(found.displacement_error, 1e-2);
  }
}

TEST(Collocation, ConvergeGeometricallyOverTheNodesOfAPanel) {
  const BarCase bar(testing::jl14_case_2);
  const Eigen::VectorXd times = uniform_times(256);
  const Eigen::MatrixXd exact = bar.exact(1e-13).motion.displacement(times);
  // Errors that a prototype in another language had, computed independently.
  for (const auto& [nodes, expected] : {std::pair{8, 2.5e-6}, {12, 9e-8}, {16, 3.8e-9}, {24, 5.6e-12}}) {
    const ExactSolution found =
        exact_near_response(bar.problem, bar.law, bar.response, bar.dynamics,
                            {.tolerance = 1e-14, .nodes = nodes, .max_nodes = nodes, .max_panels = 1})
            .motion;
    ASSERT_EQ(found.status, ExactStatus::tolerance_missed);
    EXPECT_EQ(found.unknowns, nodes + 2);
    const double error = distance(found.displacement(times), exact);
    EXPECT_LT(error, 1.5 * expected);
    EXPECT_GT(error, expected / 1.5);
  }
}

// The layer of fast modes is only where contact begins: the panel that was cut for another one at its end
// is joined with its neighbour, or there would be 83 unknowns.
TEST(Collocation, HaveNoPanelsForLayersThatAreNotThere) {
  const ExactSolution found = BarCase(testing::jl14_case_1).exact(1e-8, 32).motion;
  ASSERT_TRUE(found.converged());
  EXPECT_LE(found.unknowns, 60);
}

TEST(Collocation, OfRandomStructuresSatisfyTheirLawsAndAreNearTheBalance) {
  std::mt19937 generator(28);
  int found = 0, solved = 0;
  for (int trial = 0; trial < 32; ++trial) {
    const RandomCase random(generator, 1 + trial % 4);
    const bool damped = trial >= 24;  // forces of the velocity
    const ContactLaws laws = damped ? testing::with_dashpots(random, 0.1 / two_pi) : ContactLaws(random.laws);
    CondensedProblem problem = testing::fourier_problem(random.structure, 255, 1024, random.frequency);
    const PeriodicResponse response = forced_response(problem, laws, {});
    if (!response.converged()) continue;
    ++solved;
    const ExactNearResponse exact =
        exact_near_response(problem, laws, response, ContactDynamics(random.structure), {.tolerance = 1e-10});
    if (!exact.motion.converged()) continue;
    ++found;
    expect_motion(exact.motion, laws, 1e-6);
    EXPECT_LT(exact.displacement_error, damped ? 1e-2 : 2e-3);
  }
  EXPECT_GE(solved, 27);
  EXPECT_GE(found, 0.95 * solved);
}

TEST(Collocation, OfAMotionWithoutContactAreNone) {
  BarCase bar(testing::jl14_case_1);
  const ContactLaws distant(LinearContact{1e9, 1.0});
  const PeriodicResponse response = forced_response(bar.problem, distant, {});
  const ExactNearResponse found = exact_near_response(bar.problem, distant, response, bar.dynamics);
  ASSERT_TRUE(found.motion.converged());
  EXPECT_TRUE(found.motion.intervals.empty());
  EXPECT_EQ(found.motion.unknowns, 0);
  EXPECT_LT(found.displacement_error, 1e-12);
}

TEST(Collocation, OfContactThatLastsHaveOnePhaseOfAWholePeriod) {
  BarCase bar(testing::jl14_case_1);
  const ContactLaws pressed(LinearContact{1e8, -5e-3});
  const PeriodicResponse response = testing::solved_response(bar.problem, pressed);
  const ExactNearResponse found =
      exact_near_response(bar.problem, pressed, response, bar.dynamics, {.tolerance = 1e-11});
  ASSERT_TRUE(found.motion.converged()) << to_string(found.motion.status);
  ASSERT_EQ(found.motion.intervals.size(), 1u);
  EXPECT_TRUE(found.motion.intervals[0].always());
  // The whole is linear, so that the balance is exact.
  EXPECT_LT(found.displacement_error, 1e-10);
}

TEST(Collocation, OfASpringThatActsAlwaysAreThoseOfItsFullBalance) {
  BarCase bar(testing::jl14_case_1, 255);
  const ContactLaws cubic(testing::DuffingSpring{.cubic = 1e13, .linear = 1e8});
  const PeriodicResponse response = testing::solved_response(bar.problem, cubic);
  const ExactNearResponse found =
      exact_near_response(bar.problem, cubic, response, bar.dynamics, {.tolerance = 1e-11});
  ASSERT_TRUE(found.motion.converged()) << to_string(found.motion.status);
  EXPECT_LT(found.displacement_error, 1e-9);
}

TEST(Collocation, AreFoundWhereTheyPassTheEndOfThePeriod) {
  const BarCase bar(testing::jl14_case_1);
  const ExactNearResponse found = bar.exact(1e-9);
  ASSERT_EQ(found.motion.intervals.size(), 1u);
  EXPECT_GT(found.motion.intervals[0].end, 1.0);
  EXPECT_LT(found.motion.intervals[0].begin, 1.0);
}

TEST(Collocation, NameWhatTheyCannotSolve) {
  const BarCase bar(testing::jl14_case_1);
  const Eigen::MatrixXd start = Eigen::MatrixXd::Zero(1, 64);
  Eigen::MatrixXcd free = Eigen::MatrixXcd::Zero(1, 2);
  free(0, 1) = 1e-3;
  EXPECT_EQ(collocation_motion({bar.dynamics, testing::Rigid{1e-3}, free, 150.0}, start).status,
            ExactStatus::rigid_contact);
  const ContactDynamics undamped = ContactDynamics::undamped(Eigen::VectorXd::Constant(1, two_pi * two_pi),
                                                             Eigen::MatrixXd::Ones(1, 1), 1);
  EXPECT_EQ(collocation_motion({undamped, bar.law, free, 1.0}, start).status, ExactStatus::resonant);
  LinearStructure hysteretic = bar.structure;
  hysteretic.loss_factor = 0.1;
  const ContactDynamics damped(hysteretic);
  EXPECT_EQ(collocation_motion({damped, bar.law, free, 150.0}, start).status,
            ExactStatus::structural_damping);
}

TEST(Collocation, EndWhereTheObserverStopsThemWithTheMotionFoundBefore) {
  const BarCase bar(testing::jl14_case_2);
  const auto found = [&](double tolerance, int steps) {
    return exact_near_response(
               bar.problem, bar.law, bar.response, bar.dynamics,
               {.tolerance = tolerance, .observer = [steps](const Progress&) mutable { return steps-- > 0; }})
        .motion;
  };
  const ExactSolution none = found(1e-12, 0);
  EXPECT_EQ(none.status, ExactStatus::cancelled);
  EXPECT_EQ(none.parts, nullptr);
  int steps = 1;
  while (found(1e-2, steps).status == ExactStatus::cancelled && steps < 100) ++steps;
  const ExactSolution coarse = found(1e-12, steps);
  EXPECT_EQ(coarse.status, ExactStatus::cancelled);
  ASSERT_NE(coarse.parts, nullptr);
  EXPECT_GT(coarse.estimated_error, 1e-12);
  const Eigen::VectorXd times = uniform_times(64);
  EXPECT_LT(distance(coarse.displacement(times), bar.exact(1e-12).motion.displacement(times)), 1e-2);
}

TEST(Collocation, RejectSizesAndOptionsThatDoNotFit) {
  const BarCase bar(testing::jl14_case_1);
  const Eigen::MatrixXcd free = Eigen::MatrixXcd::Zero(1, 2);
  const Eigen::MatrixXd start = Eigen::MatrixXd::Zero(1, 64);
  EXPECT_THROW(collocation_motion({bar.dynamics, bar.law, free, 150.0}, Eigen::MatrixXd::Zero(2, 64)),
               std::invalid_argument);
  EXPECT_THROW(collocation_motion({bar.dynamics, bar.law, Eigen::MatrixXcd::Zero(3, 2), 150.0}, start),
               std::invalid_argument);
  EXPECT_THROW(collocation_motion({bar.dynamics, bar.law, free, 0.0}, start), std::invalid_argument);
  EXPECT_THROW(collocation_motion({bar.dynamics, bar.law, free, 150.0}, start, {.tolerance = 0.0}),
               std::invalid_argument);
  EXPECT_THROW(collocation_motion({bar.dynamics, bar.law, free, 150.0}, start, {.nodes = 2}),
               std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers

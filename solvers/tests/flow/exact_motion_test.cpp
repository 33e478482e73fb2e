// Exact motions by the map of the flow against the equations of collocation; against event-driven
// integrations by pytest, in tests/impacts, tests/friction and tests/mixtures.
#include "wavebalance/solvers/flow/exact_motion.hpp"

#include "support/collocation_cases.hpp"
#include "support/collocation_stiffness.hpp"
#include "support/friction_motions.hpp"
#include "support/friction_table.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

using testing::FrictionMotion, testing::FrictionRow, testing::FrictionScene;

// Where R_0 > 0 the velocity jumps as slip begins.
TEST(ExactMotion, HaveTheForcesOfTheLawAtContactsWithoutMass) {
  constexpr int points = 1 << 15;
  FrictionScene scene{testing::with_massless_contacts(), {}, 8.0};
  scene.laws = {contact::CoulombLaw({0.5, 200.0, 0.4}), contact::CoulombLaw({0.5, 300.0, 0.2})};
  const FrictionMotion found(scene);
  ASSERT_TRUE(found.response.converged());
  const ExactSolution& motion = found.exact.motion;
  ASSERT_EQ(to_string(motion.status), "converged");
  ASSERT_EQ(motion.cycles.size(), 2u);
  for (const FrictionCycle& cycle : motion.cycles) EXPECT_GT(cycle.share(ContactState::slip), 0.0);
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(points, 0.0, 1.0 - 1.0 / points);
  const Eigen::MatrixXd force = motion.force(times);
  EXPECT_LE((scene.contact_laws().force(motion.displacement(times)) - force).norm(), 1e-6 * force.norm());
  EXPECT_EQ(motion.count_unstable(), 0);
}

TEST(ExactMotion, TheEstimatedErrorIsAboveTheError) {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(512, 0.0, 1.0 - 1.0 / 512);
  for (const FrictionRow& row : testing::friction_rows()) {
    if (row.scene.laws.front().tangents() > 1) continue;
    const ExactSolution exact = FrictionMotion(row.scene, {.tolerance = 1e-10, .nodes = 16}).exact.motion;
    for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
      const ExactSolution motion =
          FrictionMotion(row.scene, {.tolerance = tolerance, .nodes = 4}).exact.motion;
      ASSERT_EQ(to_string(motion.status), "converged") << row.name;
      EXPECT_LE(motion.estimated_error, tolerance);
      const Eigen::MatrixXd u = exact.displacement(times);
      EXPECT_LE((motion.displacement(times) - u).norm() / u.norm(), motion.estimated_error + 1e-10)
          << row.name << ' ' << tolerance;
    }
  }
}

// The equations of collocation share the poles with the flow, and no equation. Every other stop has a
// dashpot, does not pull, or both.
TEST(ExactMotion, OfElasticContactAgreeWithCollocationAndItsMultipliers) {
  std::mt19937 generator(11);
  int found = 0;
  for (int trial = 0; trial < 12; ++trial) {
    testing::RandomCase random(generator, 1 + trial % 4);
    if (trial % 3 > 0) {
      std::vector<AnyContactLaw> damped;
      for (int c = 0; c < random.structure.contacts(); ++c) {
        const double gap = random.laws[c].gap(), stiffness = random.laws[c].tangent(2.0 * gap),
                     dashpot = 0.02 * stiffness / random.frequency;
        if (trial % 3 == 1)
          damped.emplace_back(testing::DampedStop{stiffness, dashpot, gap});
        else
          damped.emplace_back(testing::PushingStop{stiffness, dashpot, gap});
      }
      random.laws = ContactLaws(std::move(damped));
    }
    CondensedProblem problem = testing::fourier_problem(random.structure, 127, 512, random.frequency);
    const ContactDynamics dynamics(random.structure);
    const PeriodicResponse response = forced_response(problem, random.laws, {});
    const ExactSolution exact =
        exact_near_response(problem, random.laws, response, dynamics, {.tolerance = 1e-11}).motion;
    if (!exact.converged() || exact.intervals.empty()) continue;
    ++found;
    const ExactSolution motion =
        exact_near_response(problem, random.laws, response, dynamics, {.tolerance = 1e-10}, flow_motion)
            .motion;
    ASSERT_EQ(to_string(motion.status), "converged") << trial;
    const Eigen::VectorXd times = testing::uniform_times(256);
    EXPECT_LE(testing::distance(motion.displacement(times), exact.displacement(times)), 1e-9) << trial;
    testing::expect_same(motion.multipliers(), exact.multipliers(), 1e-7);
    EXPECT_EQ(contact_stiffness(motion).status, StabilityStatus::unsupported_law);
    ASSERT_EQ(motion.intervals.size(), exact.intervals.size()) << trial;
    for (std::size_t i = 0; i < exact.intervals.size(); ++i) {
      EXPECT_EQ(motion.intervals[i].contact, exact.intervals[i].contact);
      EXPECT_EQ(motion.intervals[i].piece, exact.intervals[i].piece);
      EXPECT_NEAR(motion.intervals[i].begin, exact.intervals[i].begin, 1e-8);
      EXPECT_NEAR(motion.intervals[i].end, exact.intervals[i].end, 1e-8);
    }
  }
  EXPECT_GE(found, 8);
}

TEST(ExactMotion, AreRefusedWithTheReason) {
  using enum ExactStatus;
  const FrictionScene plane = testing::slip_in_a_plane(0.4, 1.1);
  const FrictionMotion elastic(plane, {}, 15, 64);
  const double rigid = std::numeric_limits<double>::infinity();
  const ContactLaws laws(std::vector<AnyContactLaw>{contact::CoulombLaw({1.0, rigid, 0.4, 2})});
  EXPECT_EQ(flow_motion(exact_problem(elastic.problem, laws, elastic.dynamics), Eigen::MatrixXd::Ones(2, 64),
                        {}, Eigen::MatrixXd::Zero(2, 64))
                .status,
            slip_in_a_plane);
  const FrictionScene chain = testing::chain_of_three(3.0, 0.85);
  FrictionScene loss = chain;
  loss.structure.loss_factor = 0.01;
  EXPECT_EQ(FrictionMotion(loss, {}, 15, 64).exact.motion.status, structural_damping);
  EXPECT_EQ(FrictionMotion(chain, {.max_operations = 1.0}, 15, 64).exact.motion.status, too_many_intervals);
  EXPECT_EQ(
      FrictionMotion(chain, {.observer = [](const Progress&) { return false; }}, 15, 64).exact.motion.status,
      cancelled);
}

// A panel of this chain needs 4e5 operations, and a period has 16 of them at least.
TEST(ExactMotion, APeriodThatTakesMoreThanTheOperationsIsNotBegun) {
  int periods = 0;
  const CollocationOptions options{.max_operations = 5e6, .observer = [&periods](const Progress&) {
                                     ++periods;
                                     return true;
                                   }};
  const FrictionMotion chain(testing::chain_of_three(3.0, 0.85), options, 15, 64);
  EXPECT_EQ(to_string(chain.exact.motion.status), "too_many_phases");
  EXPECT_EQ(periods, 0);
}

// Collocation with too few nodes misses the tolerance, so that the flow is tried, too.
TEST(ExactMotion, IsCancelledWhereTheSecondSearchIs) {
  std::mt19937 generator(11);
  const testing::RandomCase random(generator, 1);
  CondensedProblem problem = testing::fourier_problem(random.structure, 127, 512, random.frequency);
  const ContactDynamics dynamics(random.structure);
  const PeriodicResponse response = forced_response(problem, random.laws, {});
  CollocationOptions options{.tolerance = 1e-12, .nodes = 6, .max_nodes = 6, .max_panels = 1};
  const auto status = [&] {
    return exact_near_response(problem, random.laws, response, dynamics, options, exact_motion).motion.status;
  };
  EXPECT_EQ(to_string(status()), "converged");
  options.observer = [](const Progress& progress) { return progress.phase != "exact motion"; };
  EXPECT_EQ(to_string(status()), "cancelled");
}

TEST(ExactMotion, BadInputIsRefusedByName) {
  const FrictionScene chain = testing::chain_of_three(3.0, 0.85);
  const FrictionMotion found(chain, {}, 15, 64);
  const ExactProblem problem = exact_problem(found.problem, chain.contact_laws(), found.dynamics);
  const Eigen::MatrixXd start = Eigen::MatrixXd::Ones(2, 64);
  EXPECT_THROW(flow_motion(problem, Eigen::MatrixXd::Ones(1, 64)), std::invalid_argument);
  EXPECT_THROW(flow_motion(problem, Eigen::MatrixXd::Ones(2, 7)), std::invalid_argument);
  EXPECT_THROW(flow_motion(problem, std::nan("") * start), std::invalid_argument);
  EXPECT_THROW(flow_motion(problem, start, {.tolerance = 0.0}), std::invalid_argument);
  EXPECT_THROW(collocation_motion(problem, start), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers

#include "collocation/collocation_layout.hpp"
#include "collocation/collocation_refinement.hpp"
#include "collocation/pole_response.hpp"
#include "support/collocation_cases.hpp"
#include "support/collocation_stiffness.hpp"
#include "support/rigid_law.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"

namespace wavebalance::solvers {
namespace {

using testing::distance, testing::expect_motion, testing::free_pair, testing::cosine_load,
    testing::LinearContact, testing::RandomCase, testing::uniform_times, testing::with_massless_contacts;

TEST(Collocation, OfAnUndampedStructureAreThoseOfOneWithNextToNoDamping) {
  std::mt19937 generator(5);
  RandomCase random(generator, 1);
  const auto motion_with = [&](double factor) {
    LinearStructure structure = random.structure;
    structure.damping = factor * structure.stiffness;
    CondensedProblem problem = testing::fourier_problem(structure, 127, 512, random.frequency);
    const PeriodicResponse response = testing::solved_response(problem, random.laws);
    return exact_near_response(problem, random.laws, response, ContactDynamics(structure), {}).motion;
  };
  const ExactSolution undamped = motion_with(0.0), damped = motion_with(1e-9);
  ASSERT_TRUE(undamped.converged() && damped.converged());
  const Eigen::VectorXd times = uniform_times(128);
  EXPECT_LT(distance(damped.displacement(times), undamped.displacement(times)), 1e-6);
}

TEST(Collocation, OfAStructureThatIsFreeToMoveAreNearItsBalance) {
  const LinearStructure structure = free_pair();
  const ContactLaws laws(AnyContactLaw(LinearContact{60.0, 0.01}));
  CondensedProblem problem = testing::fourier_problem(structure, 255, 1024, 1.1);
  const PeriodicResponse response = testing::solved_response(problem, laws);
  const ExactNearResponse exact =
      exact_near_response(problem, laws, response, ContactDynamics(structure), {});
  ASSERT_TRUE(exact.motion.converged());
  EXPECT_LT(exact.displacement_error, 1e-4);
  EXPECT_LT(exact.force_error, 1e-2);
  EXPECT_GE(exact.motion.intervals.size(), 1u);
  expect_motion(exact.motion, laws, 1e-7);
}

TEST(Collocation, OfContactsWithoutMassThatDeflectEachOtherSatisfyTheirLaws) {
  const LinearStructure structure = with_massless_contacts();
  const ContactLaws laws(
      {AnyContactLaw(LinearContact{150.0, 0.002}), AnyContactLaw(LinearContact{90.0, 0.003})});
  CondensedProblem problem = testing::fourier_problem(structure, 511, 2048, 1.3);
  const PeriodicResponse response = testing::solved_response(problem, laws);
  const ExactNearResponse exact =
      exact_near_response(problem, laws, response, ContactDynamics(structure), {});
  ASSERT_TRUE(exact.motion.converged());
  EXPECT_EQ(exact.motion.intervals.size(), 2u);
  EXPECT_LT(exact.displacement_error, 1e-4);
  expect_motion(exact.motion, laws, 1e-7);
}

/// Rigid contacts of that chain without mass, with and without dashpots before them.
class RigidIntervals : public ::testing::TestWithParam<double> {};

TEST_P(RigidIntervals, HoldTheGapAndPushOnly) {
  const LinearStructure structure = with_massless_contacts(GetParam());
  const ContactLaws laws({AnyContactLaw(testing::Rigid{0.002}), AnyContactLaw(testing::Rigid{0.003})});
  CondensedProblem problem = testing::fourier_problem(structure, 127, 512, 1.3);
  const PeriodicResponse response = testing::solved_response(problem, laws);
  const ContactDynamics dynamics(structure);
  const ExactNearResponse exact = exact_near_response(problem, laws, response, dynamics, {});
  ASSERT_TRUE(exact.motion.converged());
  ASSERT_EQ(exact.motion.intervals.size(), 2u);
  EXPECT_LT(exact.displacement_error, 1e-2);
  const Eigen::VectorXd times = uniform_times(500);
  const Eigen::MatrixXd u = exact.motion.displacement(times), f = exact.motion.force(times);
  for (int c = 0; c < 2; ++c) {
    const double gap = c == 0 ? 0.002 : 0.003;
    EXPECT_LT((u.row(c).array() - gap).maxCoeff(), 1e-9);
    EXPECT_GT(f.row(c).minCoeff(), -1e-6 * f.maxCoeff());
    EXPECT_GT(f.row(c).maxCoeff(), 0.0);
    EXPECT_LT((f.row(c).array() * (u.row(c).array() - gap)).abs().maxCoeff(), 1e-7 * f.maxCoeff() * gap);
  }
  EXPECT_EQ(contact_stiffness(exact.motion).status, StabilityStatus::no_finite_stiffness);
  EXPECT_THROW(
      collocation_motion({dynamics, laws, Eigen::MatrixXcd::Zero(2, 2), 1.3}, Eigen::MatrixXd::Zero(2, 64)),
      std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutDashpots, RigidIntervals, ::testing::Values(0.0, 0.3));

// With 127 functions the samples open the tip once more, for less than a sample.
TEST(IntervalsOfARigidContact, AreFoundThoughSamplesOpenForLessThanTheyResolve) {
  const LinearStructure bar = testing::massless_tip(testing::jl14_case_2.structure());
  const ContactLaws laws(AnyContactLaw(testing::Rigid{testing::jl14_case_2.law.start}));
  const auto intervals_of = [&](int functions) {
    CondensedProblem problem = testing::fourier_problem(bar, functions, 4 * (functions + 1), 1275.0);
    const PeriodicResponse response = testing::solved_response(problem, laws);
    return exact_near_response(problem, laws, response, ContactDynamics(bar), {}).motion;
  };
  const ExactSolution motion = intervals_of(127), other = intervals_of(255);
  ASSERT_TRUE(motion.converged());
  ASSERT_TRUE(other.converged());
  ASSERT_EQ(motion.intervals.size(), 1u);
  EXPECT_NEAR(motion.intervals[0].begin, other.intervals[0].begin, 1e-9);
  EXPECT_NEAR(motion.intervals[0].end, other.intervals[0].end, 1e-9);
}

// For many panels within a cell each pole is used once, for few a series for each pair: the effect of a
// panel on itself is the same among many.
class Influence : public ::testing::Test {
 protected:
  static constexpr int contacts = 6;
  static constexpr Eigen::Index q = 9;

  static detail::PoleResponse response_of_chain() {
    std::mt19937 generator(7);
    LinearStructure chain = testing::random_chain(contacts, generator);
    chain.contact_directions = Eigen::MatrixXd::Identity(contacts, contacts).sparseView();
    return {ContactDynamics(chain), 1.7};
  }

  // One interval of each of `count` contacts.
  static detail::Layout intervals_of(int first, int count, bool cut_by_others) {
    detail::Layout layout;
    layout.cut_by_others = cut_by_others;
    for (int c = first; c < first + count; ++c) {
      const int passage = static_cast<int>(layout.passages.size());
      layout.passages.push_back({c, 0.1 + 0.03 * c, 0.0});
      layout.passages.push_back({c, 0.9 - 0.05 * c, 0.0});
      layout.intervals.push_back({c, 1, passage, passage + 1, 0.0, {}});
    }
    return layout;
  }

  const detail::PoleResponse response = response_of_chain();
  const detail::LegendreNodes nodes{q};
};

TEST_F(Influence, OfAPanelAmongManyIsThatOfThePanelAlone) {
  const auto influence_of = [&](int first, int count) {
    return response.influence(*response.cells(intervals_of(first, count, false).grid(), nodes), true);
  };
  const detail::Influence many = influence_of(0, contacts);
  for (int c = 0; c < contacts; ++c) {
    const detail::Influence alone = influence_of(c, 1);
    const auto expect_same = [&](const Eigen::MatrixXd& all, const Eigen::MatrixXd& own) {
      const Eigen::MatrixXd block = own.topLeftCorner(q, q);
      EXPECT_LT((all.block(q * c, q * c, q, q) - block).norm(), 1e-13 * block.norm()) << c;
    };
    expect_same(many.displacement, alone.displacement);
    expect_same(many.node_velocity, alone.node_velocity);
  }
}

// Within cells with few panels, with many, and with the nodes of panels that are longer than a cell.
TEST_F(Influence, TakesForcesToTheMotionThatTheyMake) {
  for (const bool cut : {true, false})
    for (const int count : {1, 3, contacts}) {
      const detail::CellGrid grid = intervals_of(0, count, cut).grid();
      const auto period = response.cells(grid, nodes);
      const auto n = q * Eigen::Index(grid.panels.size());
      const detail::Influence influence = response.influence(*period, true);
      const Eigen::VectorXd force = Eigen::VectorXd::LinSpaced(n, 1.0, 2.0).array().cube().sin();
      const detail::ForcedMotion motion = response.forced_motion(
          *period, nodes.coefficients * force.reshaped(q, Eigen::Index(grid.panels.size())), true);
      const auto expect_same = [&](const Eigen::VectorXd& own, const Eigen::VectorXd& expected) {
        ASSERT_EQ(own.size(), expected.size());
        EXPECT_LT((own - expected).norm(), 1e-12 * expected.norm()) << count << " contacts, cut: " << cut;
      };
      expect_same(motion.displacement, influence.displacement.leftCols(n) * force);
      expect_same(motion.node_velocity, influence.node_velocity.leftCols(n) * force);
      expect_same(motion.mark_velocity, influence.mark_velocity * force);
    }
}

// Each cuts the panels of the other, and the cuts of one do not move with the passages of the other.
TEST(Layout, DividedInEveryPanelHasNoCellWithoutLengthAfterItsPassagesMove) {
  const detail::LegendreNodes nodes(8);
  detail::Layout layout;
  const double least = 0.5 * 0.1 * std::pow(0.15, 4);  // four layers at an end of the shortest panel
  layout.passages = {{0, 0.1, 0.0}, {0, 0.9, 0.0}, {1, 0.2, 0.0}, {1, 0.7, 0.0}};
  layout.intervals = {{0, 1, 0, 1, 0.0, {}}, {1, 1, 2, 3, 0.0, {}}};
  for (int round = 0; round < 4; ++round) {
    detail::CellGrid grid = layout.grid();
    const auto count = nodes.count() * Eigen::Index(grid.panels.size());
    const Eigen::VectorXd force = Eigen::VectorXd::LinSpaced(count, 1.0, 2.0).array().cube().sin();
    detail::CollocationIterate iterate{layout, detail::PanelForces(std::move(grid), nodes, force)};
    ASSERT_TRUE(detail::divide(iterate, 1e-6));
    layout = iterate.layout;
    layout.passages[0].time += 1e-9;
    const detail::CellGrid moved = layout.grid();
    for (int cell = 0; cell < moved.cells(); ++cell) EXPECT_GT(moved.length(cell), least);
  }
}

TEST(Collocation, OfContactsThatPassTogetherAreThoseOfOne) {
  LinearStructure structure = with_massless_contacts();
  const auto twice = [&](int first, int second) {
    Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(2, 5);
    directions(0, first) = directions(1, second) = 1.0;
    structure.contact_directions = directions.sparseView();
  };
  twice(1, 1);
  const ContactLaws laws(AnyContactLaw(LinearContact{50.0, 0.004}));
  CondensedProblem problem = testing::fourier_problem(structure, 255, 1024, 1.3);
  const PeriodicResponse response = testing::solved_response(problem, laws);
  const ExactSolution motion =
      exact_near_response(problem, laws, response, ContactDynamics(structure), {}).motion;
  ASSERT_TRUE(motion.converged());
  ASSERT_EQ(motion.intervals.size(), 2u);
  EXPECT_NEAR(motion.intervals[0].begin, motion.intervals[1].begin, 1e-11);
  expect_motion(motion, laws, 1e-7);
}

}  // namespace
}  // namespace wavebalance::solvers

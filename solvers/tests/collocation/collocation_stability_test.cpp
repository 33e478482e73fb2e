#include "collocation/interval_count.hpp"
#include "linalg/dense.hpp"
#include "support/collocation_cases.hpp"
#include "support/collocation_stiffness.hpp"
#include "support/rigid_law.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"
#include "wavebalance/solvers/problem/motion_stability.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"

namespace wavebalance::solvers {
namespace {

using testing::expect_same, testing::DampedStop, testing::cosine_load, testing::LinearContact,
    testing::RandomCase, testing::with_massless_contacts;

int outside(const Eigen::VectorXcd& multipliers) {
  return static_cast<int>((multipliers.cwiseAbs().array() > 1.0).count());
}

ExactSolution motion_of(const LinearStructure& structure, const ContactLaws& laws, double frequency,
                        const ContactDynamics& dynamics, int functions = 255) {
  CondensedProblem problem = testing::fourier_problem(structure, functions, 4 * (functions + 1), frequency);
  const PeriodicResponse response = forced_response(problem, laws, {});
  return exact_near_response(problem, laws, response, dynamics, {.tolerance = 1e-11}).motion;
}

// The monodromy of the poles integrates the variational equations on separate nodes.
TEST(CollocationMultipliers, AreThoseOfTheMonodromy) {
  std::mt19937 generator(11);
  int found = 0;
  for (int trial = 0; trial < 12; ++trial) {
    RandomCase random(generator, 1 + trial % 4);
    if (trial % 2 == 1) random.laws = testing::with_dashpots(random, 0.02);
    const ContactDynamics dynamics(random.structure);
    const ExactSolution motion = motion_of(random.structure, random.laws, random.frequency, dynamics);
    if (!motion.converged() || motion.intervals.empty()) continue;
    ++found;
    SCOPED_TRACE(trial);
    expect_same(motion.multipliers(), monodromy(dynamics, contact_stiffness(motion), random.frequency), 1e-7);
  }
  EXPECT_GE(found, 8);
}

// An oscillator with a stop that pulls as it opens. The multipliers were computed from the flow, by
// exponentials of matrices between located events, in another language.
TEST(CollocationMultipliers, OfAForceThatPullsAreThoseOfTheFlow) {
  const LinearStructure structure = testing::unit_oscillator(0.1, 1.0);
  const ContactDynamics dynamics(structure);
  const ExactSolution motion =
      motion_of(structure, ContactLaws(AnyContactLaw(DampedStop{5.0, 0.8, 0.5})), 0.2, dynamics);
  ASSERT_TRUE(motion.converged());
  const Eigen::VectorXcd expected{{{0.39937382, 0.23501644}, {0.39937382, -0.23501644}}};
  expect_same(motion.multipliers(), expected, 2e-8);
  expect_same(monodromy(dynamics, contact_stiffness(motion), 0.2), expected, 2e-8);
}

// A contact that stays closed moves slowly with the load, and a perturbation of it 200 rad a period. Only
// the panels of the motion gave spurious multipliers.
TEST(CollocationMultipliers, OfAContactThatStaysClosedAreExponentialsHoweverFastItIs) {
  const LinearStructure structure = testing::unit_oscillator(0.1, 0.1);
  for (const double damping : {0.0, 3.0, 30.0}) {
    constexpr double stop = 4e4, frequency = 1.0;
    SCOPED_TRACE(damping);
    const ContactDynamics dynamics(structure);
    const ExactSolution motion = motion_of(
        structure, ContactLaws(AnyContactLaw(DampedStop{stop, damping, -1.0})), frequency, dynamics);
    ASSERT_TRUE(motion.converged());
    ASSERT_EQ(motion.intervals.size(), 1u);
    const double decay = 0.5 * (0.1 + damping);
    const std::complex<double> turn = std::sqrt(std::complex<double>(decay * decay - stop - 1.0));
    const Eigen::VectorXcd expected{
        {std::exp((-decay + turn) / frequency), std::exp((-decay - turn) / frequency)}};
    expect_same(motion.multipliers(), expected, 1e-9);
    EXPECT_EQ(motion.count_unstable(), 0);
  }
}

// The other map projects perturbations where contact begins and holds the contacts until it ends.
TEST(CollocationMultipliers, OfRigidContactAreThoseOfHeldContacts) {
  const LinearStructure structure = with_massless_contacts(0.3);
  const ContactDynamics dynamics(structure);
  const ContactLaws laws({AnyContactLaw(testing::Rigid{0.002}), AnyContactLaw(testing::Rigid{0.003})});
  const ExactSolution motion = motion_of(structure, laws, 1.3, dynamics, 127);
  ASSERT_TRUE(motion.converged());
  const Eigen::VectorXcd multipliers = motion.multipliers();
  ASSERT_GT(multipliers.size(), 0);
  expect_same(multipliers, rigid_monodromy(dynamics, contact_stiffness(motion), 1.3), 1e-6);
  EXPECT_EQ(motion.count_unstable(), outside(multipliers));
}

// Without contact they belong to the structure.
TEST(CollocationMultipliers, OfAMotionWithoutContactAreExponentials) {
  std::mt19937 generator(3);
  const RandomCase random(generator, 2);
  const ContactDynamics dynamics(random.structure);
  const ContactLaws distant(AnyContactLaw(LinearContact{1.0, 1e3}));
  const ExactSolution motion = motion_of(random.structure, distant, random.frequency, dynamics, 15);
  ASSERT_TRUE(motion.converged());
  const Eigen::VectorXcd multipliers = motion.multipliers();
  ASSERT_EQ(multipliers.size(), 2 * random.structure.size());
  double slowest = -infinity;
  for (const ContactPole& pole : dynamics.poles()) slowest = std::max(slowest, pole.exponent.real());
  EXPECT_NEAR(std::abs(multipliers[0]), std::exp(slowest / random.frequency), 1e-12);
}

// Poles of which some have decayed, some lie outside the circle, and two unknowns.
TEST(CollocationMultipliers, OfAnyMapAreCountedByTheDeterminant) {
  std::mt19937 generator(41);
  std::uniform_real_distribution<double> part(-1.0, 1.0), size(0.0, 1.2);
  const auto random = [&](int rows, int columns) {
    return Eigen::MatrixXd(Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return part(generator); }));
  };
  int unstable = 0;
  for (int trial = 0; trial < 20; ++trial) {
    detail::PeriodMap map{Eigen::MatrixXd::Zero(12, 12), random(12, 2), random(2, 12)};
    for (int i = 0; i < 10; i += 2) {
      const std::complex<double> pole =
          std::polar(i == 0 ? 1e-20 : size(generator), 0.5 * two_pi * part(generator));
      map.free.block<2, 2>(i, i) << pole.real(), -pole.imag(), pole.imag(), pole.real();
    }
    map.free(10, 10) = size(generator);
    const Eigen::VectorXcd all = detail::eigenvalues(map.all());
    EXPECT_EQ(detail::count_by_determinant(map, 100000), outside(all)) << trial;
    unstable += outside(all);
  }
  EXPECT_GT(unstable, 20);
}

TEST(CollocationMultipliers, AreCountedAsOneByOne) {
  std::mt19937 generator(5);
  int found = 0;
  for (int trial = 0; trial < 24; ++trial) {
    const RandomCase random(generator, 1 + trial % 4);
    const ContactDynamics dynamics(random.structure);
    const ExactSolution motion = motion_of(random.structure, random.laws, random.frequency, dynamics, 127);
    if (!motion.converged()) continue;
    const Eigen::VectorXcd multipliers = motion.multipliers();
    if ((multipliers.array().abs() - 1.0).abs().minCoeff() < 1e-4) continue;
    ++found;
    EXPECT_EQ(motion.count_unstable(), outside(multipliers)) << trial;
  }
  EXPECT_GE(found, 16);
}

// Panels that other contacts do not cut have kinks within, which need more nodes and panels.
TEST(CollocationMultipliers, AreTheSameWithPanelsThatOtherContactsDoNotCut) {
  std::mt19937 generator(23);
  int found = 0;
  for (int trial = 0; trial < 8; ++trial) {
    RandomCase random(generator, 2 + trial % 4);
    if (trial % 2 == 1) random.laws = testing::with_dashpots(random, 0.02);
    const ContactDynamics dynamics(random.structure);
    CondensedProblem problem = testing::fourier_problem(random.structure, 127, 512, random.frequency);
    const PeriodicResponse response = forced_response(problem, random.laws, {});
    const ExactSolution cut = exact_near_response(problem, random.laws, response, dynamics).motion,
                        whole = exact_near_response(problem, random.laws, response, dynamics,
                                                    {.tolerance = 1e-7, .max_cut_panels = 0})
                                    .motion;
    if (!cut.converged() || cut.intervals.size() < 2) continue;
    ++found;
    SCOPED_TRACE(trial);
    ASSERT_TRUE(whole.converged());
    const Eigen::VectorXd times = testing::uniform_times(257);
    EXPECT_LT(testing::distance(whole.displacement(times), cut.displacement(times)), 1e-6);
    EXPECT_LT(testing::distance(whole.velocity(times), cut.velocity(times)), 1e-5);
    expect_same(whole.multipliers(), cut.multipliers(), 1e-4);
  }
  EXPECT_GE(found, 4);
}

/// A chain of masses between a wall and a stop, damped so little that all states outlast a period.
LinearStructure chain(int masses) {
  LinearStructure result;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(masses, masses);
  stiffness.diagonal().setConstant(2.0);
  stiffness.diagonal(1).setConstant(-1.0);
  stiffness.diagonal(-1).setConstant(-1.0);
  stiffness(masses - 1, masses - 1) = 1.0;
  const Eigen::MatrixXd mass = Eigen::MatrixXd::Identity(masses, masses);
  result.mass = mass.sparseView();
  result.stiffness = stiffness.sparseView();
  result.damping = (0.05 * mass + 0.02 * stiffness).sparseView();
  result.load = Eigen::VectorXd::Unit(masses, masses - 1);
  result.contact_directions = contact_rows({masses - 1}, masses);
  return result;
}

TEST(CollocationMultipliers, OfMoreStatesThanAreComputedAreCountedInTheVerdict) {
  const LinearStructure structure = chain(220);
  const ContactDynamics dynamics(structure);
  const ContactLaws laws(AnyContactLaw(DampedStop{3.0, 0.2, 0.4}));
  CondensedProblem problem = testing::fourier_problem(structure, 63, 256, 0.12);
  const PeriodicResponse response = forced_response(problem, laws, {});
  const ExactSolution motion = exact_near_response(problem, laws, response, dynamics).motion;
  ASSERT_TRUE(motion.converged());
  ASSERT_EQ(motion.multipliers().size(), 0);
  const Eigen::VectorXcd all = motion.multipliers(440);
  ASSERT_GT(all.size(), 400);
  const MotionStability stability = motion_stability(problem, laws, response, dynamics, &motion);
  EXPECT_TRUE(stability.is_exact);
  EXPECT_EQ(stability.unstable, outside(all));
  EXPECT_EQ(stability.status, outside(all) > 0 ? "unstable" : "stable");
}

TEST(CollocationMultipliers, AreNotComputedForMoreStatesThanAllowed) {
  std::mt19937 generator(11);
  const RandomCase random(generator, 1);
  const ExactSolution motion =
      motion_of(random.structure, random.laws, random.frequency, ContactDynamics(random.structure));
  ASSERT_TRUE(motion.converged());
  ASSERT_FALSE(motion.intervals.empty());
  EXPECT_EQ(motion.multipliers(1).size(), 0);
}

}  // namespace
}  // namespace wavebalance::solvers

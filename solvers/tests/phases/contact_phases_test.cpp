#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "constants.hpp"
#include "support/condensation_cases.hpp"
#include "support/jl14_bar.hpp"
#include "support/rigid_law.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/period/shooting.hpp"
#include "wavebalance/solvers/phases/response_phases.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"
#include "wavebalance/solvers/stability/unstable_multipliers.hpp"

namespace wavebalance::solvers {
namespace {

using testing::Jl14Case;

using testing::cosine_load;

Eigen::VectorXd uniform_times(int count) { return Eigen::VectorXd::LinSpaced(count, 0.0, 1.0 - 1.0 / count); }

double distance(const Eigen::MatrixXd& values, const Eigen::MatrixXd& exact) {
  return (values - exact).norm() / exact.norm();
}

/// A case of the bar with its balance, whose phases are found to any tolerance.
struct BarCase {
  explicit BarCase(const Jl14Case& jl14, int functions = 63)
      : structure(jl14.structure()),
        law(jl14.law),
        dynamics(structure),
        problem(testing::fourier_pair(functions, 4 * (functions + 1)), structure, cosine_load()) {
    problem.set_frequency(jl14.frequency_hz);
    response = forced_response(problem, law, {});
  }

  ResponsePhases phases(double tolerance, int max_nodes = 24) const {
    return response_phases(problem, law, response, dynamics,
                           {.tolerance = tolerance, .max_nodes = max_nodes});
  }

  LinearStructure structure;
  ContactLaws law;
  ContactDynamics dynamics;
  CondensedProblem problem;
  PeriodicResponse response;
};

TEST(ContactPhases, OfBothCasesOfTheBarAreWhatShootingFinds) {
  for (const Jl14Case& jl14 : {testing::jl14_case_1, testing::jl14_case_2}) {
    const BarCase bar(jl14);
    const ResponsePhases found = bar.phases(1e-11);
    ASSERT_TRUE(found.motion.converged()) << to_string(found.motion.status);
    ASSERT_EQ(found.motion.phases.size(), 1u);
    EXPECT_NEAR(found.motion.phases[0].length(), jl14.contact_fraction, 1.0 / 1024.0);  // a share of samples
    ShootingOptions options;
    options.output_points = 512;
    const ShootingResult shot = shoot(bar.structure, bar.law[0], jl14.frequency_hz, options);
    ASSERT_EQ(shot.status, ShootingStatus::converged);
    EXPECT_LT(distance(found.motion.displacement(uniform_times(512)), shot.contacts.displacement), 1e-8);
    EXPECT_GT(found.displacement_error, 1e-6);
    EXPECT_LT(found.displacement_error, 1e-2);
  }
}

TEST(ContactPhases, ConvergeGeometricallyOverTheNodesOfAPanel) {
  const BarCase bar(testing::jl14_case_2);
  const Eigen::VectorXd times = uniform_times(256);
  const Eigen::MatrixXd exact = bar.phases(1e-13).motion.displacement(times);
  // Errors that a prototype in another language had, computed independently.
  for (const auto& [nodes, expected] : {std::pair{8, 2.5e-6}, {12, 9e-8}, {16, 3.8e-9}, {24, 5.6e-12}}) {
    const PhaseMotion found =
        response_phases(bar.problem, bar.law, bar.response, bar.dynamics,
                        {.tolerance = 1e-14, .nodes = nodes, .max_nodes = nodes, .max_panels = 1})
            .motion;
    ASSERT_EQ(found.status, PhasesStatus::tolerance_missed);
    EXPECT_EQ(found.unknowns, nodes + 2);
    const double error = distance(found.displacement(times), exact);
    EXPECT_LT(error, 1.5 * expected);
    EXPECT_GT(error, expected / 1.5);
  }
}

TEST(ContactPhases, KeepToTheToleranceAndEstimateTheirError) {
  for (const Jl14Case& jl14 : {testing::jl14_case_1, testing::jl14_case_2}) {
    const BarCase bar(jl14);
    const Eigen::VectorXd times = uniform_times(256);
    const Eigen::MatrixXd exact = bar.phases(1e-13).motion.displacement(times);
    for (const double tolerance : {1e-4, 1e-6, 1e-8, 1e-10}) {
      const PhaseMotion found = bar.phases(tolerance).motion;
      ASSERT_TRUE(found.converged());
      EXPECT_LE(found.estimated_error, tolerance);
      EXPECT_LT(distance(found.displacement(times), exact), tolerance);
    }
  }
}

/// What must hold of any motion: forces are those of the law at the displacements, the
/// displacements outside phases are on the other side of the gap, and the work of load, damping and contacts
/// is zero.
void expect_motion(const PhaseMotion& motion, const ContactLaws& laws, double tolerance) {
  const Eigen::VectorXd times = uniform_times(257);
  const Eigen::MatrixXd u = motion.displacement(times), v = motion.velocity(times), f = motion.force(times);
  const double size = f.cwiseAbs().maxCoeff();
  for (Eigen::Index c = 0; c < u.rows(); ++c)
    for (Eigen::Index k = 0; k < times.size(); ++k)
      EXPECT_NEAR(f(c, k), laws[static_cast<int>(c)].force(u(c, k), v(c, k)), tolerance * size)
          << "contact " << c << " at " << times[k];
}

struct LinearStop {
  double stiffness, start;
  double force(double u) const { return u > start ? stiffness * (u - start) : 0.0; }
  double tangent(double u) const { return u >= start ? stiffness : 0.0; }
  double potential(double u) const { return u > start ? 0.5 * stiffness * (u - start) * (u - start) : 0.0; }
  double gap() const { return start; }
};

/// k u + c u^3.
struct HardeningSpring {
  double linear, cubic;
  double force(double u) const { return u * (linear + cubic * u * u); }
  double tangent(double u) const { return linear + 3.0 * cubic * u * u; }
  double potential(double u) const { return u * u * (0.5 * linear + 0.25 * cubic * u * u); }
  double gap() const { return infinity; }
  bool unilateral() const { return false; }
};

/// A random chain with contacts along random directions, and a balance of it.
struct RandomCase {
  RandomCase(std::mt19937& generator, int contacts)
      : structure(testing::random_chain(std::max(contacts, 2) + 2, generator)) {
    structure.contact_directions = testing::random_directions(contacts, structure.size(), generator);
    std::vector<AnyContactLaw> list;
    const ContactDynamics linear(structure);
    double lowest = infinity;
    for (const ContactPole& pole : linear.poles())
      if (pole.exponent.imag() > 0.0) lowest = std::min(lowest, pole.exponent.imag());
    frequency = 0.8 * lowest / two_pi;
    CondensedProblem free(testing::fourier_pair(15, 64), structure, cosine_load());
    free.set_frequency(frequency);
    const double size = free.contact_free_response().cwiseAbs().maxCoeff();
    for (int c = 0; c < contacts; ++c)
      list.emplace_back(LinearStop{(1.0 + c) / free.contact_compliance()[c], (0.3 + 0.1 * c) * size});
    laws = ContactLaws(std::move(list));
  }

  LinearStructure structure;
  ContactLaws laws;
  double frequency = 0.0;
};

TEST(ContactPhases, OfRandomStructuresSatisfyTheirLawsAndAreNearTheBalance) {
  std::mt19937 generator(28);
  int found = 0, solved = 0;
  for (int trial = 0; trial < 24; ++trial) {
    const RandomCase random(generator, 1 + trial % 4);
    CondensedProblem problem(testing::fourier_pair(255, 1024), random.structure, cosine_load());
    problem.set_frequency(random.frequency);
    const PeriodicResponse response = forced_response(problem, random.laws, {});
    if (!response.converged()) continue;
    ++solved;
    const ResponsePhases phases = response_phases(problem, random.laws, response,
                                                  ContactDynamics(random.structure), {.tolerance = 1e-10});
    if (!phases.motion.converged()) continue;
    ++found;
    expect_motion(phases.motion, random.laws, 1e-6);
    EXPECT_LT(phases.displacement_error, 2e-3);
  }
  EXPECT_GE(solved, 20);
  EXPECT_GE(found, 0.95 * solved);
}

/// Kelvin and Voigt's stop, whose force jumps where contact begins and ends.
struct DampedStop {
  double stiffness, dashpot, start;
  double force(double u, double v) const { return u > start ? stiffness * (u - start) + dashpot * v : 0.0; }
  double tangent(double u, double) const { return u >= start ? stiffness : 0.0; }
  double damping(double u, double) const { return u >= start ? dashpot : 0.0; }
  double potential(double u) const { return u > start ? 0.5 * stiffness * (u - start) * (u - start) : 0.0; }
  double gap() const { return start; }
};

TEST(ContactPhases, OfForcesOfTheVelocitySatisfyTheirLaws) {
  std::mt19937 generator(5);
  int found = 0;
  for (int trial = 0; trial < 8; ++trial) {
    const RandomCase random(generator, 1 + trial % 3);
    std::vector<AnyContactLaw> list;
    for (int c = 0; c < random.structure.contacts(); ++c) {
      const AnyContactLaw& stop = random.laws[c];
      const double stiffness = stop.tangent(2.0 * stop.gap());
      list.emplace_back(DampedStop{stiffness, 0.1 * stiffness / (two_pi * random.frequency), stop.gap()});
    }
    const ContactLaws laws(std::move(list));
    CondensedProblem problem(testing::fourier_pair(255, 1024), random.structure, cosine_load());
    problem.set_frequency(random.frequency);
    const PeriodicResponse response = forced_response(problem, laws, {});
    if (!response.converged()) continue;
    const ResponsePhases phases =
        response_phases(problem, laws, response, ContactDynamics(random.structure), {.tolerance = 1e-10});
    if (!phases.motion.converged()) continue;
    ++found;
    expect_motion(phases.motion, laws, 1e-6);
    EXPECT_LT(phases.displacement_error, 1e-2);
  }
  EXPECT_GE(found, 7);
}

TEST(ContactPhases, HaveTheStabilityOfTheStructureAtAnyNumberOfFunctions) {
  std::mt19937 generator(7);
  for (int trial = 0; trial < 8; ++trial) {
    const RandomCase random(generator, 1 + trial % 3);
    const ContactDynamics dynamics(random.structure);
    std::vector<int> counts;
    for (const int functions : {63, 127, 255}) {
      CondensedProblem problem(testing::fourier_pair(functions, 4 * (functions + 1)), random.structure,
                               cosine_load());
      problem.set_frequency(random.frequency);
      const PeriodicResponse response = forced_response(problem, random.laws, {});
      const ResponsePhases phases = response_phases(problem, random.laws, response, dynamics);
      if (!phases.motion.converged()) continue;
      const Eigen::VectorXcd multipliers =
          monodromy(dynamics, contact_stiffness(phases.motion), random.frequency);
      counts.push_back(static_cast<int>((multipliers.cwiseAbs().array() > 1.0).count()));
      EXPECT_EQ(counts.back(), counts.front());
    }
    EXPECT_GE(counts.size(), 2u) << trial;
  }
}

TEST(ContactPhases, OfAMotionWithoutContactAreNone) {
  BarCase bar(testing::jl14_case_1);
  const ContactLaws distant(LinearStop{1e9, 1.0});
  const PeriodicResponse response = forced_response(bar.problem, distant, {});
  const ResponsePhases found = response_phases(bar.problem, distant, response, bar.dynamics);
  ASSERT_TRUE(found.motion.converged());
  EXPECT_TRUE(found.motion.phases.empty());
  EXPECT_EQ(found.motion.unknowns, 0);
  EXPECT_LT(found.displacement_error, 1e-12);
}

TEST(ContactPhases, OfContactThatLastsHaveOnePhaseOfAWholePeriod) {
  BarCase bar(testing::jl14_case_1);
  const ContactLaws pressed(LinearStop{1e8, -5e-3});
  const PeriodicResponse response = forced_response(bar.problem, pressed, {});
  ASSERT_TRUE(response.converged());
  const ResponsePhases found =
      response_phases(bar.problem, pressed, response, bar.dynamics, {.tolerance = 1e-11});
  ASSERT_TRUE(found.motion.converged()) << to_string(found.motion.status);
  ASSERT_EQ(found.motion.phases.size(), 1u);
  EXPECT_TRUE(found.motion.phases[0].always());
  // The whole is linear, so that the balance is exact.
  EXPECT_LT(found.displacement_error, 1e-10);
}

TEST(ContactPhases, OfASpringThatActsAlwaysAreThoseOfItsFullBalance) {
  BarCase bar(testing::jl14_case_1, 255);
  const ContactLaws cubic(HardeningSpring{1e8, 1e13});
  const PeriodicResponse response = forced_response(bar.problem, cubic, {});
  ASSERT_TRUE(response.converged());
  const ResponsePhases found =
      response_phases(bar.problem, cubic, response, bar.dynamics, {.tolerance = 1e-11});
  ASSERT_TRUE(found.motion.converged()) << to_string(found.motion.status);
  EXPECT_LT(found.displacement_error, 1e-9);
}

TEST(ContactPhases, AreFoundWhereTheyPassTheEndOfThePeriod) {
  const BarCase bar(testing::jl14_case_1);
  const ResponsePhases found = bar.phases(1e-9);
  ASSERT_EQ(found.motion.phases.size(), 1u);
  EXPECT_GT(found.motion.phases[0].end, 1.0);
  EXPECT_LT(found.motion.phases[0].begin, 1.0);
}

TEST(ContactPhases, OfAnUndampedStructureAreThoseOfOneWithNextToNoDamping) {
  std::mt19937 generator(5);
  RandomCase random(generator, 1);
  const auto motion_with = [&](double factor) {
    LinearStructure structure = random.structure;
    structure.damping = factor * structure.stiffness;
    CondensedProblem problem(testing::fourier_pair(127, 512), structure, cosine_load());
    problem.set_frequency(random.frequency);
    const PeriodicResponse response = forced_response(problem, random.laws, {});
    EXPECT_TRUE(response.converged());
    return response_phases(problem, random.laws, response, ContactDynamics(structure), {}).motion;
  };
  const PhaseMotion undamped = motion_with(0.0), damped = motion_with(1e-9);
  ASSERT_TRUE(undamped.converged() && damped.converged());
  const Eigen::VectorXd times = uniform_times(128);
  EXPECT_LT(distance(damped.displacement(times), undamped.displacement(times)), 1e-6);
}

/// Two masses with a spring and a dashpot between them that nothing holds but a stop on either side.
LinearStructure free_pair() {
  LinearStructure structure;
  const auto sparse = [](const Eigen::MatrixXd& dense) {
    return Eigen::SparseMatrix<double>(dense.sparseView());
  };
  const Eigen::Matrix2d coupling{{1.0, -1.0}, {-1.0, 1.0}};
  structure.mass = sparse(Eigen::Vector2d(1.0, 0.7).asDiagonal().toDenseMatrix());
  structure.stiffness = sparse(100.0 * coupling);
  structure.damping = sparse(0.8 * coupling);
  structure.load = Eigen::Vector2d(1.0, 0.3);
  structure.rigid_modes = Eigen::MatrixXd::Constant(2, 1, 1.0 / std::sqrt(1.7));
  structure.contact_directions = sparse(Eigen::Matrix2d{{1.0, 0.0}, {0.0, -1.0}});
  return structure;
}

TEST(ContactPhases, OfAStructureThatIsFreeToMoveAreNearItsBalance) {
  const LinearStructure structure = free_pair();
  const ContactLaws laws(AnyContactLaw(LinearStop{60.0, 0.01}));
  CondensedProblem problem(testing::fourier_pair(255, 1024), structure, cosine_load());
  problem.set_frequency(1.1);
  const PeriodicResponse response = forced_response(problem, laws, {});
  ASSERT_TRUE(response.converged());
  const ResponsePhases phases = response_phases(problem, laws, response, ContactDynamics(structure), {});
  ASSERT_TRUE(phases.motion.converged());
  EXPECT_LT(phases.displacement_error, 1e-4);
  EXPECT_LT(phases.force_error, 1e-2);
  EXPECT_GE(phases.motion.phases.size(), 1u);
  expect_motion(phases.motion, laws, 1e-7);
}

/// A chain of three masses whose ends are held by springs, and contacts without mass on springs before two of
/// its masses, which also deflect each other.
LinearStructure with_massless_contacts(double dashpot = 0.0) {
  const auto sparse = [](const Eigen::MatrixXd& dense) {
    return Eigen::SparseMatrix<double>(dense.sparseView());
  };
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(5, 5), damping = stiffness, mass = stiffness;
  const auto spring = [&](int i, int j, double k, double c) {
    for (auto [matrix, value] : {std::pair{&stiffness, k}, {&damping, c}}) {
      (*matrix)(i, i) += value;
      if (j < 0) continue;
      (*matrix)(j, j) += value;
      (*matrix)(i, j) -= value;
      (*matrix)(j, i) -= value;
    }
  };
  spring(0, -1, 90.0, 0.4);
  spring(0, 1, 100.0, 0.4);
  spring(1, 2, 110.0, 0.4);
  spring(2, -1, 80.0, 0.4);
  spring(3, 0, 300.0, dashpot);
  spring(4, 2, 350.0, dashpot);
  spring(3, 4, 40.0, 0.0);
  mass.diagonal().head(3) << 1.0, 0.8, 1.2;
  LinearStructure structure;
  structure.mass = sparse(mass);
  structure.stiffness = sparse(stiffness);
  structure.damping = sparse(damping);
  structure.load = Eigen::VectorXd::Unit(5, 1);
  Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(2, 5);
  directions(0, 3) = 1.0;
  directions(1, 4) = -1.0;
  structure.contact_directions = sparse(directions);
  return structure;
}

TEST(ContactPhases, OfContactsWithoutMassThatDeflectEachOtherSatisfyTheirLaws) {
  const LinearStructure structure = with_massless_contacts();
  const ContactLaws laws({AnyContactLaw(LinearStop{150.0, 0.002}), AnyContactLaw(LinearStop{90.0, 0.003})});
  CondensedProblem problem(testing::fourier_pair(511, 2048), structure, cosine_load());
  problem.set_frequency(1.3);
  const PeriodicResponse response = forced_response(problem, laws, {});
  ASSERT_TRUE(response.converged());
  const ResponsePhases phases = response_phases(problem, laws, response, ContactDynamics(structure), {});
  ASSERT_TRUE(phases.motion.converged());
  EXPECT_EQ(phases.motion.phases.size(), 2u);
  EXPECT_LT(phases.displacement_error, 1e-4);
  expect_motion(phases.motion, laws, 1e-7);
}

/// Rigid contacts of that chain without mass, with and without dashpots before them.
class RigidPhases : public ::testing::TestWithParam<double> {};

TEST_P(RigidPhases, HoldTheGapAndPushOnly) {
  const LinearStructure structure = with_massless_contacts(GetParam());
  const ContactLaws laws({AnyContactLaw(testing::Rigid{0.002}), AnyContactLaw(testing::Rigid{0.003})});
  CondensedProblem problem(testing::fourier_pair(127, 512), structure, cosine_load());
  problem.set_frequency(1.3);
  const PeriodicResponse response = forced_response(problem, laws, {});
  ASSERT_TRUE(response.converged());
  const ContactDynamics dynamics(structure);
  const ResponsePhases phases = response_phases(problem, laws, response, dynamics, {});
  ASSERT_TRUE(phases.motion.converged());
  ASSERT_EQ(phases.motion.phases.size(), 2u);
  EXPECT_LT(phases.displacement_error, 1e-2);
  const Eigen::VectorXd times = uniform_times(500);
  const Eigen::MatrixXd u = phases.motion.displacement(times), f = phases.motion.force(times);
  for (int c = 0; c < 2; ++c) {
    const double gap = c == 0 ? 0.002 : 0.003;
    EXPECT_LT((u.row(c).array() - gap).maxCoeff(), 1e-9);
    EXPECT_GT(f.row(c).minCoeff(), -1e-6 * f.maxCoeff());
    EXPECT_GT(f.row(c).maxCoeff(), 0.0);
    EXPECT_LT((f.row(c).array() * (u.row(c).array() - gap)).abs().maxCoeff(), 1e-7 * f.maxCoeff() * gap);
  }
  EXPECT_EQ(contact_stiffness(phases.motion).status, StabilityStatus::no_finite_stiffness);
  EXPECT_THROW(
      contact_phases({dynamics, laws, Eigen::MatrixXcd::Zero(2, 2), 1.3}, Eigen::MatrixXd::Zero(2, 64)),
      std::invalid_argument);
}

INSTANTIATE_TEST_SUITE_P(WithAndWithoutDashpots, RigidPhases, ::testing::Values(0.0, 0.3));

TEST(ContactPhases, OfContactsThatPassTogetherAreThoseOfOne) {
  LinearStructure structure = with_massless_contacts();
  const auto twice = [&](int first, int second) {
    Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(2, 5);
    directions(0, first) = directions(1, second) = 1.0;
    structure.contact_directions = directions.sparseView();
  };
  twice(1, 1);
  const ContactLaws laws(AnyContactLaw(LinearStop{50.0, 0.004}));
  CondensedProblem problem(testing::fourier_pair(255, 1024), structure, cosine_load());
  problem.set_frequency(1.3);
  const PeriodicResponse response = forced_response(problem, laws, {});
  ASSERT_TRUE(response.converged());
  const PhaseMotion motion = response_phases(problem, laws, response, ContactDynamics(structure), {}).motion;
  ASSERT_TRUE(motion.converged());
  ASSERT_EQ(motion.phases.size(), 2u);
  EXPECT_NEAR(motion.phases[0].begin, motion.phases[1].begin, 1e-11);
  expect_motion(motion, laws, 1e-7);
}

TEST(ContactPhases, NameWhatTheyCannotSolve) {
  const BarCase bar(testing::jl14_case_1);
  const Eigen::MatrixXd start = Eigen::MatrixXd::Zero(1, 64);
  Eigen::MatrixXcd free = Eigen::MatrixXcd::Zero(1, 2);
  free(0, 1) = 1e-3;
  EXPECT_EQ(contact_phases({bar.dynamics, testing::Rigid{1e-3}, free, 150.0}, start).status,
            PhasesStatus::rigid_contact);
  const ContactDynamics undamped = ContactDynamics::undamped(Eigen::VectorXd::Constant(1, two_pi * two_pi),
                                                             Eigen::MatrixXd::Ones(1, 1), 1);
  EXPECT_EQ(contact_phases({undamped, bar.law, free, 1.0}, start).status, PhasesStatus::resonant);
  LinearStructure hysteretic = bar.structure;
  hysteretic.loss_factor = 0.1;
  const ContactDynamics damped(hysteretic);
  EXPECT_EQ(contact_phases({damped, bar.law, free, 150.0}, start).status, PhasesStatus::structural_damping);
}

TEST(ContactPhases, RejectSizesAndOptionsThatDoNotFit) {
  const BarCase bar(testing::jl14_case_1);
  const Eigen::MatrixXcd free = Eigen::MatrixXcd::Zero(1, 2);
  const Eigen::MatrixXd start = Eigen::MatrixXd::Zero(1, 64);
  EXPECT_THROW(contact_phases({bar.dynamics, bar.law, free, 150.0}, Eigen::MatrixXd::Zero(2, 64)),
               std::invalid_argument);
  EXPECT_THROW(contact_phases({bar.dynamics, bar.law, Eigen::MatrixXcd::Zero(3, 2), 150.0}, start),
               std::invalid_argument);
  EXPECT_THROW(contact_phases({bar.dynamics, bar.law, free, 0.0}, start), std::invalid_argument);
  EXPECT_THROW(contact_phases({bar.dynamics, bar.law, free, 150.0}, start, {.tolerance = 0.0}),
               std::invalid_argument);
  EXPECT_THROW(contact_phases({bar.dynamics, bar.law, free, 150.0}, start, {.nodes = 2}),
               std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers

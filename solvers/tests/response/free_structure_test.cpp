#include <numeric>

#include "dense_algebra.hpp"
#include "support/condensation_cases.hpp"
#include "support/oscillator.hpp"
#include "support/refusal.hpp"
#include "support/rigid_law.hpp"
#include "support/runge_kutta.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/response/curve_responses.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"
#include "wavebalance/solvers/stability/unstable_multipliers.hpp"
#include "wavebalance/solvers/structure/rigid_modes.hpp"

// Structures that are free to move: only contact holds them, or nothing does.
namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;
using testing::LinearContact;

PeriodicForce static_force(const Eigen::VectorXd& shape) {
  return {shape, Eigen::VectorXcd::Constant(1, 1.0), 0};
}

// A mass of 1 kg with a dashpot to the ground, pressed by a static force.
LinearStructure pressed_mass(double damping, double pressure, double load) {
  LinearStructure mass = testing::unit_oscillator(damping, load);
  mass.stiffness.coeffRef(0, 0) = 0.0;
  mass.forces = {static_force(Eigen::VectorXd::Constant(1, pressure))};
  mass.rigid_modes = find_rigid_modes(mass.mass, mass.stiffness);
  return mass;
}

// Masses of 1 kg in a row between springs of 1 N/m, free at both ends, with stops at both.
LinearStructure free_rod(int size, double load) {
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size);
  for (int i = 0; i + 1 < size; ++i) {
    stiffness.block<2, 2>(i, i) += Eigen::Matrix2d{{1.0, -1.0}, {-1.0, 1.0}};
  }
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2, size);
  rows(0, size - 1) = 1.0;
  rows(1, 0) = -1.0;
  const Eigen::MatrixXd mass = Eigen::MatrixXd::Identity(size, size);
  LinearStructure rod = testing::structure(mass, 0.3 * stiffness + 0.3 * mass, stiffness,
                                           load * Eigen::VectorXd::Unit(size, 0), rows);
  rod.rigid_modes = find_rigid_modes(rod.mass, rod.stiffness);
  return rod;
}

// Two masses that a static force presses against each other, with a load on the first.
LinearStructure two_masses(double pressure, double load) {
  LinearStructure two = testing::structure(
      Eigen::Vector2d(1.0, 3.0).asDiagonal(), Eigen::Matrix2d{{0.9, -0.5}, {-0.5, 0.9}},
      Eigen::Matrix2d::Zero(), Eigen::Vector2d(load, 0.0), Eigen::MatrixXd(Eigen::RowVector2d(1.0, -1.0)));
  two.forces = {static_force(Eigen::Vector2d(pressure, -pressure))};
  two.rigid_modes = find_rigid_modes(two.mass, two.stiffness);
  return two;
}

CondensedProblem problem_of(const LinearStructure& structure, double omega, TimePair pair) {
  CondensedProblem problem(std::move(pair), structure, testing::cosine_load());
  problem.set_frequency(omega / two_pi);
  return problem;
}

double mean(const Eigen::VectorXd& values) { return values.mean(); }

TEST(RigidModes, AreThoseThatStrainNothing) {
  const LinearStructure rod = free_rod(6, 1.0);
  ASSERT_EQ(rod.rigid_modes.cols(), 1);
  EXPECT_LT((rod.stiffness * rod.rigid_modes).norm(), 1e-12);
  EXPECT_NEAR((rod.rigid_modes.transpose() * (rod.mass * rod.rigid_modes))(0, 0), 1.0, 1e-12);
  EXPECT_EQ(two_masses(1.0, 1.0).rigid_modes.cols(), 2);
  std::mt19937 generator(51);
  const LinearStructure held = testing::random_chain(6, generator);
  EXPECT_EQ(find_rigid_modes(held.mass, held.stiffness).cols(), 0);
  EXPECT_NE(
      testing::refusal([&] { find_rigid_modes(held.mass, -held.stiffness); }).find("negative eigenvalue"),
      std::string::npos);
}

TEST(RigidModes, OfLargeStructuresAreFoundByInverseIteration) {
  constexpr int size = 1200;
  Eigen::SparseMatrix<double> stiffness(size, size), mass(size, size);
  mass.setIdentity();
  for (int i = 0; i + 1 < size; ++i) {
    if (i == size / 3) continue;  // two bodies
    stiffness.coeffRef(i, i) += 1.0;
    stiffness.coeffRef(i + 1, i + 1) += 1.0;
    stiffness.coeffRef(i, i + 1) -= 1.0;
    stiffness.coeffRef(i + 1, i) -= 1.0;
  }
  const Eigen::MatrixXd rigid = find_rigid_modes(mass, stiffness);
  ASSERT_EQ(rigid.cols(), 2);
  EXPECT_LT((stiffness * rigid).norm(), 1e-8);
  stiffness.coeffRef(0, 0) += 1.0;
  EXPECT_EQ(find_rigid_modes(mass, stiffness).cols(), 1);
}

// Always in contact the mass is an oscillator on the stop: u = gap + p / k + Re F exp(i omega t) / (k -
// omega^2 + i c omega).
TEST(FreeStructure, PressedAgainstAStopHasTheClosedFormForEveryPair) {
  const LinearContact stop{4.0, 0.2};
  for (TimePair& pair : testing::pair_kinds(8, 32)) {
    CondensedProblem problem = problem_of(pressed_mass(0.3, 2.0, 0.5), 0.7, std::move(pair));
    ASSERT_TRUE(problem.is_free());
    const PeriodicResponse response = testing::solved_response(problem, AnyContactLaw(stop));
    EXPECT_GT(response.contact_force.minCoeff(), 0.0);
    EXPECT_NEAR(mean(response.contact_force), 2.0, 1e-9);
    EXPECT_NEAR(mean(response.displacement), 0.2 + 2.0 / 4.0, 1e-9);
    EXPECT_LE(response.residual, 1e-10);
  }
  CondensedProblem problem = problem_of(pressed_mass(0.3, 2.0, 0.5), 0.7, testing::fourier_pair(7, 32));
  const PeriodicResponse response = forced_response(problem, AnyContactLaw(stop), {});
  for (int l = 0; l < 32; ++l) {
    const Complex amplitude = 0.5 / Complex(4.0 - 0.49, 0.21);
    EXPECT_NEAR(response.displacement[l], 0.7 + std::real(amplitude * std::polar(1.0, two_pi * l / 32.0)),
                1e-10);
  }
  EXPECT_LT((problem.displacement(response.force_on_held_structure) - response.displacement).norm(), 1e-9);
}

TEST(FreeStructure, KeepsAZeroMeanWhereNothingTouches) {
  const LinearStructure rod = free_rod(5, 1.0);
  CondensedProblem problem = problem_of(rod, 0.8, testing::fourier_pair(15, 64));
  for (const AnyContactLaw& law : {AnyContactLaw(), AnyContactLaw(LinearContact{5.0, 50.0})}) {
    const PeriodicResponse response = testing::solved_response(problem, law);
    EXPECT_TRUE(response.contact_force.isZero(0.0));
    EXPECT_NEAR(mean(response.displacement.head(64)), 0.0, 1e-12);
  }
  // The mean momentum-weighted position of the two bodies, along which no contact acts.
  const LinearStructure two = two_masses(1.0, 2.5);
  CondensedProblem pair = problem_of(two, 1.3, testing::fourier_pair(63, 256));
  const PeriodicResponse response = forced_response(pair, AnyContactLaw(LinearContact{4.0, 0.2}), {});
  const Motion motion = structure_motion(pair, response, 256);
  const Eigen::Vector2d position = motion.displacement.rowwise().mean();
  EXPECT_NEAR(position[0] + 3.0 * position[1], 0.0, 1e-10);
  EXPECT_LT(
      (motion.displacement.row(0) - motion.displacement.row(1) - response.displacement.transpose()).norm(),
      1e-9);
}

TEST(FreeStructure, WhoseStaticLoadNothingBalancesHasNoPeriodicMotion) {
  const ContactLaws stop = AnyContactLaw(LinearContact{4.0, 0.2});
  const auto status = [](const LinearStructure& structure, const ContactLaws& laws) {
    CondensedProblem problem = problem_of(structure, 0.8, testing::fourier_pair(15, 64));
    return forced_response(problem, laws, {}).status;
  };
  EXPECT_EQ(status(pressed_mass(0.3, -1.0, 0.5), stop), SolveStatus::unbalanced);  // pulled away
  EXPECT_EQ(status(pressed_mass(0.3, 1.0, 0.5), AnyContactLaw()), SolveStatus::unbalanced);
  LinearStructure pushed = two_masses(1.0, 2.5);  // both of them in one direction
  pushed.forces.push_back(static_force(Eigen::Vector2d(0.5, 0.0)));
  EXPECT_EQ(status(pushed, stop), SolveStatus::unbalanced);
  LinearStructure rod = free_rod(5, 1.0);  // either stop balances a force towards it
  for (const double pressure : {-0.5, 0.5}) {
    rod.forces = {static_force(pressure * Eigen::VectorXd::Unit(5, 2))};
    EXPECT_EQ(status(rod, std::vector<AnyContactLaw>{LinearContact{5.0, 0.3}, LinearContact{5.0, 0.5}}),
              SolveStatus::converged);
    EXPECT_EQ(status(rod, std::vector<AnyContactLaw>{LinearContact{5.0, 0.3}, AnyContactLaw()}),
              pressure > 0.0 ? SolveStatus::converged : SolveStatus::unbalanced);
  }
  EXPECT_EQ(to_string(SolveStatus::unbalanced), "unbalanced");
}

// Solves with J, bordered and not, are those with the derivative of the residual, in both forms.
TEST(FreeStructure, HasTheNewtonMatrixOfItsResidual) {
  std::mt19937 generator(52);
  for (const bool force_form : {false, true})
    for (TimePair& pair : testing::pair_kinds(8, 32)) {
      CondensedProblem problem = problem_of(free_rod(4, 1.0), 0.8, std::move(pair));
      const Eigen::VectorXd form =
          force_form ? Eigen::VectorXd(Eigen::Vector2d(0.3, 0.2)) : Eigen::VectorXd();
      ContactSystem system(problem, AnyContactLaw(LinearContact{4.0, -0.1}), form);
      const Eigen::VectorXd state = testing::random_vector(problem.samples(), generator),
                            right = testing::random_vector(problem.samples(), generator),
                            column = testing::random_vector(problem.samples(), generator),
                            row = testing::random_vector(problem.samples(), generator);
      const auto derivative = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
        constexpr double step = 1e-7;
        system.evaluate(state + step * x);
        const Eigen::VectorXd ahead = system.residual();
        system.evaluate(state - step * x);
        return (ahead - system.residual()) / (2.0 * step);
      };
      system.evaluate(state);
      ASSERT_TRUE(system.factorize());
      Eigen::VectorXd x;
      ASSERT_TRUE(system.solve(right, x));
      EXPECT_LT((derivative(x) - right).norm(), 1e-5 * right.norm());
      system.evaluate(state);
      ASSERT_TRUE(system.factorize_bordered(column, row, 0.7));
      double y = 0.0;
      ASSERT_TRUE(system.solve_bordered(right, 0.4, x, y));
      EXPECT_LT((derivative(x) + y * column - right).norm(), 1e-5 * right.norm());
      EXPECT_NEAR(row.dot(x) + 0.7 * y, 0.4, 1e-8 * x.norm());
    }
}

// One period of the pressed mass by the classical method of Runge and Kutta.
Eigen::Vector2d integrated(const LinearContact& law, double omega, Eigen::Vector2d state) {
  const auto rate = [&](double time, const Eigen::Vector2d& at) {
    return Eigen::Vector2d(at[1], 1.0 + 3.0 * std::cos(omega * time) - 0.3 * at[1] - law.force(at[0]));
  };
  return testing::runge_kutta(rate, state, two_pi / omega, 20000);
}

TEST(FreeStructure, HasTheMultipliersOfItsPeriodMap) {
  const LinearContact law{4.0, 0.2};
  int unstable = 0;
  for (const double omega : {1.1, 2.0, 3.4}) {
    CondensedProblem problem =
        problem_of(pressed_mass(0.3, 1.0, 3.0), omega, testing::fourier_pair(127, 1024));
    const ContactLaws laws = AnyContactLaw(law);
    const PeriodicResponse response = testing::solved_response(problem, laws);
    EXPECT_EQ(response.contact_force.minCoeff(), 0.0) << omega;
    const Motion motion = contact_motion(problem, response, laws, 1024);
    const Eigen::Vector2d start(motion.displacement(0, 0), motion.velocity(0, 0));
    const Eigen::Vector2d end = integrated(law, omega, start);
    EXPECT_LT((end - start).norm(), 1e-2 * start.norm()) << omega;
    Eigen::Matrix2d map;
    for (int i = 0; i < 2; ++i)
      map.col(i) = (integrated(law, omega, start + 1e-6 * Eigen::Vector2d::Unit(i)) - end) / 1e-6;
    const Eigen::VectorXcd exact = oracle::eigenvalues(map);
    const ContactDynamics dynamics(problem.structure());
    EXPECT_GT(dynamics.holding(), 0.0);
    for (const Complex multiplier :
         monodromy(dynamics, contact_stiffness(problem, laws, response), problem.frequency()))
      EXPECT_LT((exact.array() - multiplier).abs().minCoeff(), 1e-2) << omega;
    const UnstableMultipliers count = unstable_multipliers(dynamics, problem, laws, response);
    EXPECT_EQ(count.status, StabilityStatus::converged) << omega;
    EXPECT_EQ(count.count, (exact.cwiseAbs().array() > 1.0).count()) << omega;
    StabilityOptions alone{.max_states = 0};  // by the determinant
    const UnstableMultipliers wound = unstable_multipliers(dynamics, problem, laws, response, alone);
    const bool winds = wound.status == StabilityStatus::converged;
    EXPECT_EQ(winds ? wound.count : count.count, count.count) << omega;
    unstable += count.count > 0;
  }
  RecordProperty("unstable", unstable);
}

// A mass on a spring with a tip without mass, pressed against a rigid stop: the tip rests at the stop.
TEST(FreeStructure, IsHeldByARigidStopAtAContactWithoutMass) {
  const Eigen::Matrix2d stiffness{{2.0, -2.0}, {-2.0, 2.0}};
  LinearStructure body = testing::structure(Eigen::Vector2d(1.0, 0.0).asDiagonal(), 0.1 * stiffness,
                                            stiffness, Eigen::Vector2d(0.5, 0.0), contact_rows({1}, 2));
  body.forces = {static_force(Eigen::Vector2d(1.5, 0.0))};
  body.rigid_modes = Eigen::Vector2d(1.0, 1.0);
  CondensedProblem problem = problem_of(body, 0.6, testing::fourier_pair(31, 128));
  const PeriodicResponse response = testing::solved_response(problem, AnyContactLaw(testing::Rigid{0.25}));
  EXPECT_LT((response.displacement.array() - 0.25).abs().maxCoeff(), 1e-9);
  EXPECT_NEAR(mean(response.contact_force), 1.5, 1e-9);
  const Motion motion = structure_motion(problem, response, 128);
  for (int l = 0; l < 128; ++l) {
    const Complex amplitude = 0.5 / Complex(2.0 - 0.36, 0.2 * 0.6);
    EXPECT_NEAR(motion.displacement(0, l),
                0.25 + 0.75 + std::real(amplitude * std::polar(1.0, two_pi * l / 128.0)), 1e-9);
  }
}

TEST(FreeStructure, RefusesRigidModesOfAnotherSizeAndACirculatoryStiffness) {
  LinearStructure rod = free_rod(3, 1.0);
  rod.rigid_modes.conservativeResize(2, 1);
  EXPECT_NE(testing::refusal([&] { rod.validate(); }).find("rigid_modes has 2 rows"), std::string::npos);
  rod = free_rod(3, 1.0);
  rod.stiffness.coeffRef(0, 2) = 0.3;
  EXPECT_NE(testing::refusal([&] { rod.validate(); }).find("must have a symmetric stiffness"),
            std::string::npos);
}

}  // namespace
}  // namespace wavebalance::solvers

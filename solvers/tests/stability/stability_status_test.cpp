#include "support/oscillator.hpp"
#include "support/rigid_law.hpp"
#include "support/solved.hpp"
#include "support/stability_cases.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"

namespace wavebalance::solvers {
namespace {

// A count is given only with the status `converged`.
void expect_unknown(const UnstableMultipliers& found, StabilityStatus status) {
  EXPECT_EQ(found.status, status) << to_string(found.status);
  EXPECT_EQ(found.count, -1);
}

PeriodicStiffness half_period() {
  PeriodicStiffness stiffness;
  stiffness.intervals = {{0, 0.1, 0.6}};
  stiffness.tangent = [](int, double) { return 0.7; };
  return stiffness;
}

TEST(StabilityStatus, OfAResponseThatHasNotConvergedIsNoResponse) {
  CondensedProblem problem = testing::fourier_problem(testing::unit_oscillator(0.1, 0.8), 15, 64);
  expect_unknown(unstable_multipliers(problem, testing::LinearContact{10.0, 0.1}, PeriodicResponse{}),
                 StabilityStatus::no_response);
}

TEST(StabilityStatus, OfRigidContactWithMassIsNoFiniteStiffness) {
  CondensedProblem problem = testing::fourier_problem(testing::unit_oscillator(0.1, 0.8), 15, 64, 0.1);
  PeriodicResponse response;  // any with force: not the motion is in question, but the law
  response.status = SolveStatus::converged;
  response.frequency = 0.1;
  response.unknown = problem.linear_response();
  response.unknown_coefficients = problem.coefficients(Eigen::VectorXd::Zero(problem.samples()));
  const ContactLaws rigid = testing::Rigid{0.5 * response.unknown.maxCoeff()};
  expect_unknown(unstable_multipliers(problem, rigid, response), StabilityStatus::no_finite_stiffness);
  EXPECT_EQ(stability_signs(ContactDynamics(problem.structure()), problem, rigid, response).status,
            StabilityStatus::no_finite_stiffness);
}

TEST(StabilityStatus, OfRigidObstacleThatIsNotReachedIsKnown) {
  // A tip without mass hangs on the oscillator by a damped spring.
  const Eigen::Matrix2d stiffness{{2.0, -1.0}, {-1.0, 1.0}};
  const LinearStructure structure =
      testing::structure(Eigen::Vector2d(1.0, 0.0).asDiagonal(), 0.1 * stiffness, stiffness,
                         Eigen::Vector2d(0.8, 0.0), contact_rows({1}, 2));
  CondensedProblem problem = testing::fourier_problem(structure, 15, 64, 0.05);
  const ContactLaws rigid = testing::Rigid{100.0};
  const auto found = unstable_multipliers(problem, rigid, forced_response(problem, rigid, {}));
  EXPECT_EQ(found.status, StabilityStatus::converged);
  EXPECT_EQ(found.count, 0);
}

TEST(StabilityStatus, OfAnUndampedOrFreeStructureIsUndamped) {
  LinearStructure structure = testing::unit_oscillator(0.0, 1.0);
  StabilityOptions options{.harmonics = 10};
  expect_unknown(unstable_multipliers(ContactDynamics(structure), half_period(), 0.3, options),
                 StabilityStatus::undamped);
  EXPECT_EQ(stability_signs(ContactDynamics(structure), half_period(), 0.3, options).fold, 0);
  FloquetOptions floquet;
  floquet.stability = options;
  const auto exponents = floquet_exponents(ContactDynamics(structure), half_period(), 0.3, floquet);
  EXPECT_EQ(exponents.status, StabilityStatus::undamped);
  EXPECT_TRUE(exponents.values.empty());
  structure.damping.coeffRef(0, 0) = 0.1;
  structure.stiffness.coeffRef(0, 0) = 0.0;
  expect_unknown(unstable_multipliers(ContactDynamics(structure), half_period(), 0.3, options),
                 StabilityStatus::undamped);
}

// u = 1 cos, gap just below the top: contact for less than the distance of two samples, and between them.
TEST(StabilityStatus, OfContactBetweenTwoSamplesIsTooFewSamples) {
  const LinearStructure structure = testing::unit_oscillator(0.1, 1.0);
  CondensedProblem problem = testing::fourier_problem(structure, 15, 16, 0.05);
  const Eigen::VectorXd& free = problem.linear_response();
  const double amplitude =
      1.0 / std::abs(std::complex<double>(1.0 - std::pow(two_pi * 0.05, 2), 0.1 * two_pi * 0.05));
  ASSERT_LT(free.maxCoeff(), (1.0 - 1e-6) * amplitude);
  const ContactLaws laws = testing::LinearContact{10.0, 0.5 * (free.maxCoeff() + amplitude)};
  const PeriodicResponse response = testing::solved_response(problem, laws);
  ASSERT_EQ(response.contact_force.maxCoeff(), 0.0);
  expect_unknown(unstable_multipliers(problem, laws, response), StabilityStatus::too_few_samples);
  EXPECT_THROW(monodromy(ContactDynamics(structure), contact_stiffness(problem, laws, response), 0.05),
               std::invalid_argument);
}

TEST(StabilityStatus, OfMasslessContactsThatDeflectEachOtherIsCoupledMassless) {
  const Eigen::Matrix3d mass = Eigen::Vector3d(1.0, 0.0, 0.0).asDiagonal(),
                        stiffness{{2.0, -1.0, 0.0}, {-1.0, 2.0, -1.0}, {0.0, -1.0, 1.0}};
  const LinearStructure structure = testing::structure(
      mass, 0.1 * mass, stiffness, Eigen::Vector3d(1.0, 0.0, 0.0), contact_rows({1, 2}, 3));
  StabilityOptions options{.harmonics = 10};
  expect_unknown(unstable_multipliers(ContactDynamics(structure), half_period(), 0.3, options),
                 StabilityStatus::coupled_massless);
}

// On such a contact the mass of the oscillator moves at harmonic 20 of the load.
TEST(StabilityStatus, OfContactTooStiffForHarmonicsAndMonodromyIsTooFewHarmonics) {
  PeriodicStiffness stiff = half_period();
  stiff.tangent = [](int, double) { return std::pow(20.0 * two_pi * 0.3, 2); };
  StabilityOptions options{.harmonics = 10};
  const ContactDynamics dynamics(testing::unit_oscillator(0.1, 1.0));
  const auto found = unstable_multipliers(dynamics, stiff, 0.3, options);
  EXPECT_EQ(found.status, StabilityStatus::converged);
  EXPECT_EQ(found.harmonics, 0);
  EXPECT_EQ(found.count, (monodromy(dynamics, stiff, 0.3).cwiseAbs().array() > 1.0).count());
  const StabilitySigns signs = stability_signs(dynamics, stiff, 0.3, options);
  EXPECT_EQ(signs.status, StabilityStatus::converged);
  options.harmonics = 200;  // enough of them
  options.max_states = 0;
  EXPECT_EQ(unstable_multipliers(dynamics, stiff, 0.3, options).count, found.count);
  EXPECT_EQ(unstable_multipliers(dynamics, stiff, 0.3, options).harmonics, 200);
  EXPECT_EQ(stability_signs(dynamics, stiff, 0.3, options).fold, signs.fold);
  EXPECT_EQ(stability_signs(dynamics, stiff, 0.3, options).flip, signs.flip);
  options.harmonics = 10;
  expect_unknown(unstable_multipliers(dynamics, stiff, 0.3, options), StabilityStatus::too_few_harmonics);
  EXPECT_EQ(stability_signs(dynamics, stiff, 0.3, options).status, StabilityStatus::too_few_harmonics);
  FloquetOptions floquet;
  floquet.stability = options;
  EXPECT_EQ(floquet_exponents(dynamics, stiff, 0.3, floquet).status, StabilityStatus::too_few_harmonics);
}

TEST(StabilityStatus, OfTooFewEvaluationsIsEffortLimit) {
  StabilityOptions options{.harmonics = 10, .max_evaluations = 1};
  LinearStructure structure = testing::unit_oscillator(1e-3, 1.0);
  expect_unknown(unstable_multipliers(ContactDynamics(structure), half_period(), 0.3, options),
                 StabilityStatus::effort_limit);
}

// Four oscillators in a row, each with a contact that lasts the whole period.
TEST(StabilityStatus, OfManyLongContactsIsCountedByTheMonodromyWithinTheOperationsGiven) {
  constexpr int n = 4;
  Eigen::MatrixXd springs = 2.0 * Eigen::MatrixXd::Identity(n, n);
  for (int i = 1; i < n; ++i) springs(i, i - 1) = springs(i - 1, i) = -1.0;
  const LinearStructure structure =
      testing::structure(Eigen::MatrixXd::Identity(n, n), 0.02 * springs, springs,
                         Eigen::VectorXd::Unit(n, 0), contact_rows({0, 1, 2, 3}, n));
  const ContactDynamics dynamics(structure);
  PeriodicStiffness stiffness;
  for (int c = 0; c < n; ++c) stiffness.intervals.push_back({c, 0.0, 1.0});
  stiffness.tangent = [](int, double time) { return 1.0 + 0.9 * std::cos(two_pi * time); };
  StabilityOptions options{.harmonics = 30};
  constexpr double frequency = 0.2;
  const auto quick = unstable_multipliers(dynamics, stiffness, frequency, options);
  EXPECT_EQ(quick.evaluations, 0);
  EXPECT_GT(std::abs(quick.leading), 0.0);
  EXPECT_GE(quick.leading.imag(), 0.0);
  options.max_states = 0;
  const auto counted = unstable_multipliers(dynamics, stiffness, frequency, options);
  EXPECT_GT(counted.evaluations, 0);
  EXPECT_EQ(counted.count, quick.count);
  EXPECT_GT(counted.leading_error, 0.0);
  EXPECT_LE(std::abs(counted.leading - quick.leading), counted.leading_error);
  options.max_operations = 1e7;
  expect_unknown(unstable_multipliers(dynamics, stiffness, frequency, options),
                 StabilityStatus::effort_limit);
}

TEST(StabilityArguments, AreCheckedWithTheirNames) {
  const ContactDynamics dynamics(testing::unit_oscillator(0.1, 1.0));
  StabilityOptions options;
  EXPECT_THROW(unstable_multipliers(dynamics, half_period(), 0.3, options), std::invalid_argument);
  options.harmonics = 5;
  EXPECT_THROW(unstable_multipliers(dynamics, half_period(), 0.0, options), std::invalid_argument);
  PeriodicStiffness other = half_period();
  other.intervals[0].contact = 1;
  EXPECT_THROW(unstable_multipliers(dynamics, other, 0.3, options), std::invalid_argument);
  options.max_evaluations = 0;
  EXPECT_THROW(unstable_multipliers(dynamics, half_period(), 0.3, options), std::invalid_argument);
  options.max_evaluations = 10;
  options.max_operations = 0.0;
  EXPECT_THROW(unstable_multipliers(dynamics, half_period(), 0.3, options), std::invalid_argument);
  EXPECT_THROW(monodromy(dynamics, half_period(), 0.3, {.nodes = 1}), std::invalid_argument);
  EXPECT_THROW(monodromy(dynamics, half_period(), infinity), std::invalid_argument);
}

// The second mass carries the contact and has none.
LinearStructure massless_contact(double damping) {
  const Eigen::Matrix2d stiffness{{3.0, -2.0}, {-2.0, 2.0}}, dampers{{0.05, 0.0}, {0.0, damping}};
  return testing::structure(Eigen::Vector2d(1.0, 0.0).asDiagonal(), dampers, stiffness,
                            Eigen::Vector2d(1.0, 0.0), contact_rows({1}, 2));
}

PeriodicStiffness stiff_half_period() {
  PeriodicStiffness stiffness = half_period();
  stiffness.tangent = [](int, double) { return 5.0; };
  return stiffness;
}

TEST(MasslessContact, WithoutDampingIsTheLimitOfALittleDamping) {
  const auto leading = [](double damping) {
    return std::abs(monodromy(ContactDynamics(massless_contact(damping)), stiff_half_period(), 0.25)[0]);
  };
  const double limit = leading(0.0), near = std::abs(leading(0.01) - limit),
               far = std::abs(leading(0.02) - limit);
  EXPECT_LT(near, 0.01);
  EXPECT_NEAR(near, 0.5 * far, 0.1 * far);
}

TEST(MasslessContact, WithoutDampingHasTheExponentsOfTheMonodromy) {
  const ContactDynamics dynamics(massless_contact(0.0));
  FloquetOptions options;
  options.stability.harmonics = 100;
  const Eigen::VectorXcd multipliers = monodromy(dynamics, stiff_half_period(), 0.25);
  ASSERT_EQ(multipliers.size(), 2);
  const auto exponents = floquet_exponents(dynamics, stiff_half_period(), 0.25, options);
  ASSERT_FALSE(exponents.values.empty());
  EXPECT_NEAR(std::abs(exponents.values[0].multiplier), std::abs(multipliers[0]), 1e-4);
  EXPECT_EQ(unstable_multipliers(dynamics, stiff_half_period(), 0.25, options.stability).count,
            (multipliers.cwiseAbs().array() > 1.0).count());
}

TEST(MasslessContact, ThatIsTooStiffToResolveHasNoMonodromy) {
  const Eigen::VectorXcd multipliers =
      monodromy(ContactDynamics(massless_contact(1e-5)), stiff_half_period(), 0.25);
  EXPECT_TRUE(std::isnan(multipliers[0].real()));
}

}  // namespace
}  // namespace wavebalance::solvers

// Floquet multipliers of contact that dissipates energy.

#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/contact/hunt_crossley_law.hpp"
#include "wavebalance/contact/kelvin_voigt_law.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"
#include "wavebalance/solvers/flow/exact_motion.hpp"
#include "wavebalance/solvers/stability/floquet_exponents.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"
#include "wavebalance/solvers/stability/unstable_multipliers.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;

struct EverywhereDamper {
  double force(double u, double v) const { return 0.5 * u + 0.3 * v; }
  double tangent(double, double) const { return 0.5; }
  double damping(double, double) const { return 0.3; }
  double potential(double u) const { return 0.25 * u * u; }
  double gap() const { return 0.0; }
};

CondensedProblem problem_at(const LinearStructure& structure, double frequency, int functions = 127) {
  return testing::fourier_problem(structure, functions, 1024, frequency);
}

TEST(DampedContact, ASpringAndDamperThatAlwaysActHaveTheMultipliersOfTheDampedOscillator) {
  CondensedProblem problem = problem_at(testing::unit_oscillator(0.1, 0.4), 0.2, 31);
  const EverywhereDamper law;
  const PeriodicResponse response = testing::solved_response(problem, law);
  const FloquetExponents found =
      floquet_exponents(ContactDynamics(problem.structure()), problem, law, response);
  ASSERT_EQ(found.status, StabilityStatus::converged);
  const double decay = 0.5 * 0.4, natural = std::sqrt(1.5 - decay * decay);
  const Complex expected = std::exp(Complex(-decay, natural) / 0.2);
  ASSERT_GE(found.values.size(), 1u);
  EXPECT_NEAR(std::abs(found.values[0].multiplier), std::abs(expected), 1e-10);
  EXPECT_NEAR(std::abs(found.values[0].multiplier.imag()), std::abs(expected.imag()), 1e-10);
}

// Compared with the exact motion from event to event, whose equations the balance does not share.
template <class Law>
void expect_multipliers(const Law& law, double load, double frequency, double tolerance) {
  CondensedProblem problem = problem_at(testing::unit_oscillator(0.1, load), frequency);
  const PeriodicResponse response = testing::solved_response(problem, law);
  ASSERT_GT(response.contact_force.maxCoeff(), 0.1);
  const ContactDynamics dynamics(problem.structure());
  const ExactSolution exact =
      exact_near_response(problem, law, response, dynamics, {.tolerance = 1e-10}, flow_motion).motion;
  ASSERT_TRUE(exact.converged()) << to_string(exact.status);
  const Eigen::VectorXcd expected = exact.multipliers();
  ASSERT_EQ(expected.size(), 2);
  const PeriodicStiffness stiffness = contact_stiffness(problem, law, response);
  ASSERT_EQ(stiffness.status, StabilityStatus::converged);
  const Eigen::VectorXcd found = monodromy(dynamics, stiffness, frequency);
  ASSERT_EQ(found.size(), 2);
  EXPECT_NEAR(std::abs(found[0]), std::abs(expected[0]), tolerance);
  EXPECT_NEAR((found[0] + found[1]).real(), (expected[0] + expected[1]).real(), tolerance);
  EXPECT_NEAR((found[0] * found[1]).real(), (expected[0] * expected[1]).real(), tolerance);
  const UnstableMultipliers count = unstable_multipliers(dynamics, problem, law, response);
  EXPECT_EQ(count.status, StabilityStatus::converged);
  EXPECT_EQ(count.count, (expected.cwiseAbs().array() > 1.0).count());
  // Fewer than without loss in contact: the determinant of the map is exp(-trace) of all damping.
  EXPECT_LT((found[0] * found[1]).real(), std::exp(-0.1 / frequency));
}

TEST(DampedContact, HuntCrossleyMultipliersAreThoseOfTheExactMotion) {
  expect_multipliers(contact::HuntCrossleyLaw(10.0, 1.5, 0.5, 0.1), 0.8, 0.2, 2e-4);
  expect_multipliers(contact::HuntCrossleyLaw(10.0, 1.0, 0.3, 0.1), 0.8, 0.39, 5e-3);
  expect_multipliers(contact::HuntCrossleyLaw(40.0, 2.0, 1.0, 0.3), 0.5, 0.15, 2e-3);
}

TEST(DampedContact, MultipliersOfADamperThatActsAtOnceIncludeTheJumpOfItsForce) {
  expect_multipliers(contact::KelvinVoigtLaw(10.0, 0.4, 0.1), 0.8, 0.2, 1e-2);
  expect_multipliers(contact::KelvinVoigtLaw(10.0, 0.4, 0.1, 0.05), 0.8, 0.2, 4e-3);
}

}  // namespace
}  // namespace wavebalance::solvers

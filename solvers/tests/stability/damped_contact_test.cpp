// Floquet multipliers of contact that dissipates energy.

#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/contact/hunt_crossley_law.hpp"
#include "wavebalance/contact/kelvin_voigt_law.hpp"
#include "wavebalance/solvers/stability/floquet_exponents.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"
#include "wavebalance/solvers/stability/unstable_multipliers.hpp"
#include "wavebalance/solvers/time/motion_evaluator.hpp"

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

// The state of m = k = 1, c = 0.1 after one period, by the classical Runge-Kutta method with steps that end
// where the law begins or ceases to act.
template <class Law>
Eigen::Vector2d after_period(const Law& law, double load, double frequency, Eigen::Vector2d state,
                             double time) {
  const double omega = two_pi * frequency, end = time + 1.0 / frequency;
  const auto acts = [&](const Eigen::Vector2d& y) { return law.force(y[0], y[1]) > 0.0; };
  const auto step = [&](const Eigen::Vector2d& y, double t, double h, bool acting) {
    const auto rate = [&](const Eigen::Vector2d& at, double now) {
      // Beyond its side of a jump the force is that of the side: a step ends there to rounding.
      const double force = acting ? law.force(std::max(at[0], law.gap() + 1e-14), at[1]) : 0.0;
      return Eigen::Vector2d(at[1], load * std::cos(omega * now) - at[0] - 0.1 * at[1] - force);
    };
    const Eigen::Vector2d k1 = rate(y, t), k2 = rate(y + 0.5 * h * k1, t + 0.5 * h);
    const Eigen::Vector2d k3 = rate(y + 0.5 * h * k2, t + 0.5 * h), k4 = rate(y + h * k3, t + h);
    return Eigen::Vector2d(y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4));
  };
  const double usual = 1.0 / frequency / 4000.0;
  bool acting = acts(state);
  while (time < end - 1e-14) {
    double h = std::min(usual, end - time);
    Eigen::Vector2d next = step(state, time, h, acting);
    if (acts(next) != acting) {
      double low = 0.0, high = h;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (acts(step(state, time, middle, acting)) == acting ? low : high) = middle;
      }
      h = high;
      next = step(state, time, h, acting);
      acting = !acting;
    }
    state = next;
    time += h;
  }
  return state;
}

// Those of the period map about the response, by central differences.
template <class Law>
Eigen::Vector2cd multipliers_by_differences(const Law& law, double load, double frequency,
                                            const CondensedProblem& problem,
                                            const PeriodicResponse& response) {
  MotionEvaluator evaluate(problem.pair().trial(), problem.points());
  const Eigen::VectorXd u = evaluate.displacement(response.coefficients.col(0));
  const Eigen::VectorXd v = evaluate.velocity(response.coefficients.col(0), frequency);
  int start = 0;
  u.minCoeff(&start);  // out of contact
  const double time = double(start) / problem.points() / frequency;
  Eigen::Vector2d fixed(u[start], v[start]);
  Eigen::Matrix2d map;
  for (int newton = 0; newton < 6; ++newton) {  // onto the periodic motion of the integrator
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector2d aside = 1e-6 * Eigen::Vector2d::Unit(i);
      map.col(i) = (after_period(law, load, frequency, fixed + aside, time) -
                    after_period(law, load, frequency, fixed - aside, time)) /
                   2e-6;
    }
    const Eigen::Vector2d miss = after_period(law, load, frequency, fixed, time) - fixed;
    const Eigen::Matrix2d change = map - Eigen::Matrix2d::Identity();
    const double determinant = change(0, 0) * change(1, 1) - change(0, 1) * change(1, 0);
    fixed -= Eigen::Vector2d(change(1, 1) * miss[0] - change(0, 1) * miss[1],
                             change(0, 0) * miss[1] - change(1, 0) * miss[0]) /
             determinant;
  }
  EXPECT_NEAR(fixed[0], u[start], 5e-3);  // the same motion
  const Complex half = 0.5 * map.trace();
  const double determinant = map(0, 0) * map(1, 1) - map(0, 1) * map(1, 0);
  const Complex root = std::sqrt(half * half - determinant);
  Eigen::Vector2cd values(half + root, half - root);
  if (std::abs(values[1]) > std::abs(values[0])) std::swap(values[0], values[1]);
  return values;
}

template <class Law>
void expect_multipliers(const Law& law, double load, double frequency, double tolerance) {
  CondensedProblem problem = problem_at(testing::unit_oscillator(0.1, load), frequency);
  const PeriodicResponse response = testing::solved_response(problem, law);
  ASSERT_GT(response.contact_force.maxCoeff(), 0.1);
  const Eigen::Vector2cd expected = multipliers_by_differences(law, load, frequency, problem, response);
  const ContactDynamics dynamics(problem.structure());
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

TEST(DampedContact, HuntCrossleyMultipliersAreThoseOfThePeriodMap) {
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

// Springs that act everywhere or on both sides: responses and sweeps against independent solutions.

#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/contact/bilinear_law.hpp"
#include "wavebalance/contact/clearance_law.hpp"
#include "wavebalance/contact/cubic_law.hpp"
#include "wavebalance/contact/polynomial_law.hpp"
#include "wavebalance/contact/table_law.hpp"
#include "wavebalance/solvers/stability/contact_stiffness.hpp"
#include "wavebalance/solvers/stability/unstable_multipliers.hpp"

namespace wavebalance::solvers {
namespace {

CondensedProblem problem_of(const LinearStructure& structure, int functions, int points) {
  return testing::fourier_problem(structure, functions, points);
}

FrequencySweepOptions between(double from, double to) {
  FrequencySweepOptions options = testing::between(from / two_pi, to / two_pi);
  return options;
}

TEST(SpringResponse, ALinearSpringIsAStiffnessOfTheStructure) {
  const LinearStructure stiffer =
      testing::Oscillator{.mass = 1.0, .damping = 0.1, .stiffness = 1.7, .load = 0.4}.structure();
  CondensedProblem exact = problem_of(stiffer, 7, 32);
  exact.set_frequency(0.15);
  CondensedProblem problem = problem_of(testing::unit_oscillator(0.1, 0.4), 7, 32);
  problem.set_frequency(0.15);
  for (const AnyContactLaw& law : {AnyContactLaw(contact::PolynomialLaw({0.7})),
                                   AnyContactLaw(contact::TableLaw({-9.0, 2.0}, {-6.3, 1.4})),
                                   AnyContactLaw(contact::BilinearLaw(0.7, 0.7, 0.1))}) {
    const PeriodicResponse response = testing::solved_response(problem, law);
    EXPECT_LE((response.displacement - exact.linear_response()).norm(), 1e-11 * response.displacement.norm());
  }
}

TEST(SpringResponse, StopsOnBothSidesAreReachedByRaisingTheLoadWhereNewtonFails) {
  const contact::ClearanceLaw law({10.0, 0.1}, {4.0, 0.6});
  CondensedProblem problem = problem_of(testing::unit_oscillator(0.1, 0.8), 63, 256);
  int raised = 0;
  for (int i = 0; i < 41; i += 3) {
    problem.set_frequency((0.2 + 0.07 * i) / two_pi);
    const PeriodicResponse response = testing::solved_response(problem, law);
    raised += response.strategy == Strategy::load_continuation ? 1 : 0;
    for (int l = 0; l < 256; ++l) EXPECT_EQ(response.contact_force[l], law.force(response.displacement[l]));
  }
  EXPECT_GT(raised, 0);
}

TEST(SpringResponse, TheForceFormOfAMonotoneSpringHasTheMotionOfTheDisplacementForm) {
  ForcedResponseOptions force;
  force.form = ContactForm::force;
  CondensedProblem problem = problem_of(testing::unit_oscillator(0.1, 0.8), 127, 512);
  problem.set_frequency(0.2);
  for (const AnyContactLaw& law :
       {AnyContactLaw(contact::ClearanceLaw({10.0, 0.3}, {4.0, 0.6})),
        AnyContactLaw(contact::BilinearLaw(0.2, 8.0, 0.3)), AnyContactLaw(contact::CubicLaw(2.0))}) {
    const PeriodicResponse a = testing::solved_response(problem, law),
                           b = testing::solved_response(problem, law, force);
    EXPECT_GT(b.series_flexibility.size(), 0);
    EXPECT_LE((a.displacement - b.displacement).norm(), 2e-3 * a.displacement.norm());
    const UnstableMultipliers count = unstable_multipliers(problem, law, b);
    EXPECT_EQ(count.status, StabilityStatus::converged);
    EXPECT_EQ(count.count, unstable_multipliers(problem, law, a).count);
  }
  EXPECT_THROW(forced_response(problem, contact::CubicLaw(-0.1), force), std::invalid_argument);
}

// A law of a user's own whose kinks are not said, with any displacement as its gap: right all the same.
struct TwoSided {
  double force(double u) const { return u > 0.2 ? 5.0 * (u - 0.2) : u < -0.2 ? 5.0 * (u + 0.2) : 0.0; }
  double tangent(double u) const { return u >= 0.2 || u < -0.2 ? 5.0 : 0.0; }
  double potential(double u) const { return 0.5 * force(u) * (std::abs(u) - 0.2); }
  double gap() const { return at; }
  double at = 0.2;
};

TEST(SpringResponse, AnUndeclaredLawOnBothSidesHasTheSameCurveAsADeclaredOne) {
  CondensedProblem problem = problem_of(testing::unit_oscillator(0.1, 0.2), 31, 128);
  const auto curve = [&](const ContactLaws& laws) {
    const FrequencySweep sweep = frequency_sweep(problem, laws, between(0.5, 2.5));
    ContactSystem system(problem, laws);
    for (const SweepPoint& point : sweep.points) {
      problem.set_frequency(point.frequency);
      EXPECT_LE(system.evaluate(point.unknown), 1e-9);
    }
    return sweep;
  };
  const auto peak = [](const FrequencySweep& sweep) {
    double largest = 0.0;
    for (const SweepPoint& point : sweep.points) largest = std::max(largest, point.max_abs_displacement);
    return largest;
  };
  const double declared = peak(curve(contact::ClearanceLaw(5.0, 0.2)));
  for (const double gap : {0.2, -0.2}) {
    const FrequencySweep sweep = curve(TwoSided{gap});
    EXPECT_EQ(sweep.status, SweepStatus::reached_end) << gap;
    EXPECT_NEAR(peak(sweep), declared, 5e-3 * declared) << gap;
  }
  curve(TwoSided{-1.0});  // no kink is known: the curve may be lost, but each of its points is a response
}

}  // namespace
}  // namespace wavebalance::solvers

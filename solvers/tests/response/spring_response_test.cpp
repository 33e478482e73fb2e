// Springs that act everywhere or on both sides: responses and sweeps against independent solutions.

#include "support/oscillator.hpp"
#include "support/runge_kutta.hpp"
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
#include "wavebalance/solvers/time/motion_evaluator.hpp"

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
    EXPECT_LE((response.displacement - exact.contact_free_response()).norm(),
              1e-11 * response.displacement.norm());
  }
}

// With one harmonic the balance of m u'' + c u' + k u + k3 u^3 = F cos has the amplitudes of
// ((k - m w^2 + 3/4 k3 a^2)^2 + (c w)^2) a^2 = F^2, the middle branch between the folds included.
void expect_duffing_curve(double cubic, double load, double from, double to) {
  CondensedProblem problem = problem_of(testing::unit_oscillator(0.04, load), 3, 16);
  const FrequencySweep sweep = testing::complete_sweep(problem, contact::CubicLaw(cubic), between(from, to));
  EXPECT_EQ(sweep.turning_points.size(), 2u);
  EXPECT_LT(sweep.points.size(), 500u);
  double largest = 0.0;
  for (const SweepPoint& point : sweep.points) {
    const double a = point.max_abs_displacement, w = two_pi * point.frequency;
    const double detuning = 1.0 - w * w + 0.75 * cubic * a * a;
    EXPECT_NEAR(a * std::hypot(detuning, 0.04 * w), load, 1e-4 * load) << w;  // of 1024 output times
    largest = std::max(largest, a);
  }
  // The peak lies on the backbone, w^2 = 1 + 3/4 k3 a^2, where c w a = F.
  const double w = std::sqrt(0.5 + std::sqrt(0.25 + 0.75 * cubic * load * load / (0.04 * 0.04)));
  EXPECT_NEAR(largest, load / (0.04 * w), 0.01 * largest);
}

TEST(SpringResponse, TheCurveOfASofteningDuffingOscillatorPassesBothFolds) {
  expect_duffing_curve(-0.2, 0.035, 0.5, 1.4);
  expect_duffing_curve(-0.2, 0.035, 1.4, 0.5);
}

// With many harmonics each point is a periodic motion of the exact equation, the unstable ones too.
TEST(SpringResponse, EveryBranchOfADuffingOscillatorHasTheMotionsOfItsPeriodMap) {
  const LinearStructure oscillator = testing::unit_oscillator(0.04, 0.1);
  const contact::CubicLaw law(0.5);
  CondensedProblem problem = problem_of(oscillator, 31, 128);
  const FrequencySweep sweep = testing::complete_sweep(problem, law, between(0.5, 2.5));
  ContactSystem system(problem, law);
  MotionEvaluator evaluate(problem.pair().trial(), 128);
  int unstable = 0, compared = 0;
  for (std::size_t i = 0; i < sweep.points.size(); i += 9) {
    problem.set_frequency(sweep.points[i].frequency);
    const PeriodicResponse response = response_at(system, sweep.points[i].unknown);
    const double omega = two_pi * response.frequency;
    const auto rate = [&](double time, const Eigen::Vector2d& at) {
      return Eigen::Vector2d(at[1], 0.1 * std::cos(omega * time) - at[0] - 0.04 * at[1] - law.force(at[0]));
    };
    const Eigen::Vector2d start(response.displacement[0],
                                evaluate.velocity(response.coefficients.col(0), response.frequency)[0]);
    const testing::PeriodMap map(rate, start, two_pi / omega, 4000);
    EXPECT_LE((map.end - start).norm(), 1e-6) << response.frequency;
    const int count = unstable_multipliers(problem, law, response).count;
    EXPECT_EQ(count, map.unstable()) << response.frequency;
    unstable += count > 0 ? 1 : 0;
    ++compared;
  }
  EXPECT_GT(compared, 10);
  EXPECT_GT(unstable, 1);
}

// Backlash: one law on both sides against two contacts, one in each direction.
TEST(SpringResponse, AClearanceIsAStopInEitherDirection) {
  for (const double stiffness : {0.5, 5.0, 50.0}) {
    const LinearStructure one = testing::unit_oscillator(0.06, 0.3);
    LinearStructure two = one;
    two.contact_directions.resize(2, 1);
    two.contact_directions.insert(0, 0) = 1.0;
    two.contact_directions.insert(1, 0) = -1.0;
    const contact::ClearanceLaw clearance({stiffness, 0.5}, {2.0 * stiffness, 0.8});
    const ContactLaws stops(std::vector<AnyContactLaw>{testing::LinearContact{stiffness, 0.5},
                                                       testing::LinearContact{2.0 * stiffness, 0.8}});
    CondensedProblem a = problem_of(one, 31, 128), b = problem_of(two, 31, 128);
    const FrequencySweep law = frequency_sweep(a, clearance, between(0.3, 2.6));
    const FrequencySweep directions = frequency_sweep(b, stops, between(0.3, 2.6));
    ASSERT_EQ(law.status, SweepStatus::reached_end) << stiffness;
    ASSERT_EQ(directions.status, SweepStatus::reached_end) << stiffness;
    const auto peak = [](const FrequencySweep& sweep) {
      return std::max_element(
                 sweep.points.begin(), sweep.points.end(),
                 [](const auto& x, const auto& y) { return x.max_abs_displacement < y.max_abs_displacement; })
          ->max_abs_displacement;
    };
    EXPECT_NEAR(peak(law), peak(directions), 2e-3 * peak(law)) << stiffness;
    ASSERT_EQ(law.turning_points.size(), directions.turning_points.size()) << stiffness;
    for (std::size_t i = 0; i < law.turning_points.size(); ++i)
      EXPECT_NEAR(law.turning_points[i].frequency, directions.turning_points[i].frequency, 1e-5);
    ContactSystem system(a, clearance);
    for (const SweepPoint& point : law.points) {  // solutions, and of the law itself
      a.set_frequency(point.frequency);
      EXPECT_LE(system.evaluate(point.unknown), 1e-9);
    }
  }
}

TEST(SpringResponse, TheStabilityOfAClearanceIsThatOfStopsInEitherDirection) {
  LinearStructure one = testing::unit_oscillator(0.1, 0.8), two = one;
  two.contact_directions.resize(2, 1);
  two.contact_directions.insert(0, 0) = 1.0;
  two.contact_directions.insert(1, 0) = -1.0;
  const ContactLaws stops(
      std::vector<AnyContactLaw>{testing::LinearContact{10.0, 0.1}, testing::LinearContact{4.0, 0.6}});
  const contact::ClearanceLaw clearance({10.0, 0.1}, {4.0, 0.6});
  int unstable = 0;
  for (const double omega : {0.7, 1.3, 1.8, 2.0, 2.3, 2.6, 2.9}) {
    CondensedProblem a = problem_of(one, 63, 256), b = problem_of(two, 63, 256);
    a.set_frequency(omega / two_pi);
    b.set_frequency(omega / two_pi);
    const PeriodicResponse response = testing::solved_response(a, clearance);
    const PeriodicResponse other = testing::solved_response(
        b, stops, {},
        response.displacement.replicate(2, 1).cwiseProduct(
            (Eigen::VectorXd(512) << Eigen::VectorXd::Ones(256), -Eigen::VectorXd::Ones(256)).finished()));
    ASSERT_LE((other.displacement.head(256) - response.displacement).norm(), 1e-6);
    const UnstableMultipliers count = unstable_multipliers(a, clearance, response);
    ASSERT_EQ(count.status, StabilityStatus::converged) << to_string(count.status);
    EXPECT_EQ(count.count, unstable_multipliers(b, stops, other).count) << omega;
    unstable += count.count;
  }
  EXPECT_GT(unstable, 0);
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

#include "wavebalance/solvers/period/time_stepping.hpp"

#include <utility>

#include "support/jl14_bar.hpp"
#include "support/oscillator.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

using testing::jl14_bar;
using testing::LinearContact;
using testing::Oscillator;

TEST(TimeStepping, ReachesTheClosedFormOfADampedOscillator) {
  const Oscillator oscillator;
  TimeSteppingOptions options;
  options.output_points = 100;
  options.step_tolerance = 1e-12;
  options.period_tolerance = 1e-9;
  const TimeSteppingResult result =
      integrate_to_periodic(oscillator.structure(), AnyContactLaw(), oscillator.frequency, options);
  ASSERT_EQ(result.status, TimeSteppingStatus::converged);
  ASSERT_EQ(result.contacts.points(), 100);
  const double amplitude = std::abs(oscillator.amplitude());
  for (int l = 0; l < 100; ++l) {
    const double t = l / (100.0 * oscillator.frequency);
    EXPECT_NEAR(result.contacts.displacement(0, l), oscillator.steady_displacement(t), 1e-8 * amplitude);
    EXPECT_NEAR(result.contacts.velocity(0, l), oscillator.steady_velocity(t), 1e-5 * amplitude);
    EXPECT_EQ(result.contacts.force(0, l), 0.0);
  }
}

TEST(TimeStepping, FollowsTheTransientFromTheGivenState) {
  Oscillator oscillator;
  oscillator.displacement = 2e-3;
  oscillator.velocity = -0.1;
  TimeSteppingOptions options;
  options.output_points = 64;
  options.max_periods = 3;
  options.initial_displacement = Eigen::VectorXd::Constant(1, oscillator.displacement);
  options.initial_velocity = Eigen::VectorXd::Constant(1, oscillator.velocity);
  const TimeSteppingResult result =
      integrate_to_periodic(oscillator.structure(), AnyContactLaw(), oscillator.frequency, options);
  ASSERT_EQ(result.status, TimeSteppingStatus::iteration_limit);
  ASSERT_EQ(result.periods, 3);
  ASSERT_EQ(result.period_error.size(), 2u);
  for (int l = 0; l < 64; ++l) {
    const double t = (2.0 + l / 64.0) / oscillator.frequency;
    EXPECT_NEAR(result.contacts.displacement(0, l), oscillator.transient_displacement(t),
                1e-7 * oscillator.displacement);
  }
}

TEST(TimeStepping, FreeBilinearOscillatorReturnsAfterItsPeriod) {
  // Half a period on either side of the gap at zero: T = pi sqrt(m/k) + pi sqrt(m/(k + k_c)).
  Oscillator oscillator;
  oscillator.damping = 0.0;
  oscillator.load = 0.0;
  const LinearContact contact{3.0 * oscillator.stiffness, 0.0};
  const double natural = std::sqrt(oscillator.stiffness / oscillator.mass);
  const double frequency = natural / (1.5 * std::numbers::pi);
  TimeSteppingOptions options;
  options.initial_displacement = Eigen::VectorXd::Constant(1, -1e-3);
  const TimeSteppingResult result =
      integrate_to_periodic(oscillator.structure(), contact, frequency, options);
  EXPECT_EQ(result.status, TimeSteppingStatus::converged);
  EXPECT_EQ(result.periods, 2);
  EXPECT_NEAR(result.contacts.displacement.minCoeff(), -1e-3, 1e-9);
  EXPECT_NEAR(result.contacts.displacement.maxCoeff(), 0.5e-3, 1e-8);  // equal energy: half the amplitude
  EXPECT_NEAR(result.contacts.force.maxCoeff(), contact.stiffness * 0.5e-3, 1e-4);
}

TEST(TimeStepping, FullHistoryHoldsTheContactSamples) {
  const LinearStructure bar = jl14_bar(4, 1e-4);
  TimeSteppingOptions options;
  options.output_points = 32;
  options.full_history = true;
  const TimeSteppingResult result = integrate_to_periodic(bar, testing::ExponentialLaw{}, 150.0, options);
  ASSERT_EQ(result.status, TimeSteppingStatus::converged);
  ASSERT_EQ(result.structure.displacement.rows(), 4);
  ASSERT_EQ(result.structure.displacement.cols(), 32);
  ASSERT_EQ(result.structure.velocity.cols(), 32);
  EXPECT_EQ(result.structure.displacement.row(3), result.contacts.displacement);
  EXPECT_EQ(result.structure.velocity.row(3), result.contacts.velocity);
  EXPECT_GT(result.contacts.force.maxCoeff(), 0.0);
}

TEST(TimeStepping, StructureAtRestWithoutLoadStaysThere) {
  LinearStructure bar = jl14_bar(3, 1e-4);
  bar.load.setZero();
  const TimeSteppingResult result = integrate_to_periodic(bar, testing::ExponentialLaw{}, 150.0);
  EXPECT_EQ(result.status, TimeSteppingStatus::converged);
  EXPECT_EQ(result.contacts.displacement, Eigen::MatrixXd::Zero(1, 1024));
}

TEST(TimeStepping, TooFewPeriodsOrStepsAreNotConverged) {
  const LinearStructure bar = jl14_bar(4, 5e-6);
  TimeSteppingOptions options;
  options.max_periods = 4;
  const TimeSteppingResult few_periods =
      integrate_to_periodic(bar, testing::jl14_case_2.law, 1275.0, options);
  EXPECT_EQ(few_periods.status, TimeSteppingStatus::iteration_limit);
  EXPECT_EQ(few_periods.periods, 4);
  EXPECT_EQ(few_periods.contacts.points(), 1024);
  EXPECT_GT(few_periods.period_error.back(), options.period_tolerance);
  options.max_steps_per_period = 10;
  const TimeSteppingResult few_steps = integrate_to_periodic(bar, testing::jl14_case_2.law, 1275.0, options);
  EXPECT_EQ(few_steps.status, TimeSteppingStatus::iteration_limit);
  EXPECT_EQ(few_steps.periods, 0);
  EXPECT_EQ(few_steps.steps, 10);
  EXPECT_EQ(few_steps.contacts.points(), 0);
}

TEST(TimeStepping, TellsItsObserverOfEveryPeriodAndMayBeCancelled) {
  const LinearStructure bar = jl14_bar(4, 5e-6);
  std::vector<int> periods;
  std::vector<double> differences;
  TimeSteppingOptions options;
  options.observer = [&](const Progress& progress) {
    periods.push_back(progress.step);
    differences.push_back(progress.value);
    return progress.step < 3;
  };
  const TimeSteppingResult result = integrate_to_periodic(bar, AnyContactLaw(), 1275.0, options);
  EXPECT_EQ(result.status, TimeSteppingStatus::cancelled);
  EXPECT_EQ(periods, (std::vector<int>{1, 2, 3}));
  EXPECT_TRUE(std::isinf(differences.front()));
  EXPECT_EQ(std::vector<double>(differences.begin() + 1, differences.end()), result.period_error);
}

TEST(TimeStepping, LawWithoutAValueIsAStepFailure) {
  struct Undefined {
    double force(double u) const { return u > 1e-4 ? nan : 0.0; }
    double tangent(double) const { return 0.0; }
    double potential(double) const { return 0.0; }
    double gap() const { return 1e-4; }
  };
  const TimeSteppingResult result = integrate_to_periodic(jl14_bar(4, 1e-4), Undefined{}, 150.0);
  EXPECT_EQ(result.status, TimeSteppingStatus::step_failure);
  EXPECT_EQ(to_string(result.status), "step_failure");
}

TEST(TimeStepping, RejectsBadFrequencies) {
  const LinearStructure bar = jl14_bar(3, 1e-4);
  for (const double bad : {0.0, -150.0, nan, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(integrate_to_periodic(bar, AnyContactLaw(), bad), std::invalid_argument) << bad;
}

TEST(TimeStepping, RejectsOptionsOutOfRangeAndNamesThem) {
  const LinearStructure bar = jl14_bar(3, 1e-4);
  const auto message = [&](auto&& change) {
    TimeSteppingOptions options;
    change(options);
    try {
      integrate_to_periodic(bar, AnyContactLaw(), 150.0, options);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  const auto expect = [&](const char* name, auto&& change) {
    EXPECT_NE(message(change).find(name), std::string::npos) << message(change);
  };
  expect("output_points is 1;", [](auto& o) { o.output_points = 1; });
  expect("period_tolerance", [](auto& o) { o.period_tolerance = 0.0; });
  expect("max_periods", [](auto& o) { o.max_periods = 0; });
  expect("max_steps_per_period", [](auto& o) { o.max_steps_per_period = 0; });
  expect("step_tolerance", [](auto& o) { o.step_tolerance = nan; });
  expect("step_floor", [](auto& o) { o.step_floor = -1.0; });
  expect("initial_displacement has 2 entries", [](auto& o) { o.initial_displacement.setZero(2); });
  expect("initial_velocity has an entry", [](auto& o) { o.initial_velocity.setConstant(3, nan); });
  LinearStructure misfit = bar;
  misfit.contact_directions = contact_rows({3}, 4);
  EXPECT_THROW(integrate_to_periodic(misfit, AnyContactLaw(), 150.0), std::invalid_argument);
}

// An oscillator with a stop between its period doublings.
TEST(TimeStepping, NamesThePeriodsAfterWhichASubharmonicMotionRepeats) {
  const LinearStructure structure = testing::unit_oscillator(0.1, 0.8);
  for (const auto& [omega, periods] : {std::pair{2.7, 2}, std::pair{2.4, 4}}) {
    const auto result = integrate_to_periodic(structure, LinearContact{10.0, 0.1}, omega / two_pi);
    EXPECT_EQ(result.status, TimeSteppingStatus::subharmonic);
    EXPECT_EQ(to_string(result.status), "subharmonic");
    EXPECT_EQ(result.attractor_periods, periods);
    EXPECT_GT(result.period_error.back(), 0.1);
  }
  TimeSteppingOptions options;
  options.longest = 1;
  options.max_periods = 40;
  const auto ordinary = integrate_to_periodic(structure, LinearContact{10.0, 0.1}, 2.7 / two_pi, options);
  EXPECT_EQ(ordinary.status, TimeSteppingStatus::iteration_limit);
  EXPECT_EQ(ordinary.attractor_periods, 0);
}

// The preloaded impact oscillator. Its successive periods differ by three values in turn.
TEST(TimeStepping, NamesOddNumbersOfPeriodsToo) {
  TimeSteppingOptions options;
  options.period_tolerance = 1e-6;
  const auto result = integrate_to_periodic(testing::unit_oscillator(0.1, 1.0), LinearContact{100.0, 0.0},
                                            2.4 / two_pi, options);
  EXPECT_EQ(result.status, TimeSteppingStatus::subharmonic);
  EXPECT_EQ(result.attractor_periods, 3);
}

// Driven at twice its natural frequency, so that every second period of the transient is alike: a multiplier
// of -0.995.
TEST(TimeStepping, DoesNotTakeADecayingAlternationForASubharmonicMotion) {
  const LinearStructure structure = testing::unit_oscillator(0.0032, 0.8);
  TimeSteppingOptions options;
  options.period_tolerance = 1e-4;
  const auto result = integrate_to_periodic(structure, AnyContactLaw(), 2.0 / two_pi, options);
  EXPECT_EQ(result.status, TimeSteppingStatus::converged);
  EXPECT_EQ(result.attractor_periods, 1);
}

}  // namespace
}  // namespace wavebalance::solvers

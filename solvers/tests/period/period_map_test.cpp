// The two maps over a period of the load, and after how many periods a motion repeats.

#include "period/bdf_map.hpp"
#include "period/modal_map.hpp"
#include "period/repetition.hpp"
#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

constexpr int samples = 1024;

ModalMap modal_map(const CondensedProblem& problem, const ContactLaws& laws) {
  return {
      problem, laws, samples,
      *ModalFlow::make(problem.structure(), problem.frequency(), 1.0 / (problem.frequency() * samples), 50)};
}

void expect_near(const Eigen::MatrixXd& found, const Eigen::MatrixXd& expected, double tolerance) {
  EXPECT_LE((found - expected).cwiseAbs().maxCoeff(), tolerance * expected.cwiseAbs().maxCoeff());
}

TEST(PeriodMap, ModesAndBackwardDifferencesTakeABarThroughTheSameImpacts) {
  const testing::Jl14Case& scene = testing::jl14_case_2;
  const LinearStructure bar = scene.structure();
  CondensedProblem problem = testing::fourier_problem(bar, 7, 32, scene.frequency_hz);
  const ContactLaws laws(testing::LinearContact{1e8, 0.3 * scene.max_displacement});
  ModalMap modes = modal_map(problem, laws);
  BdfMap differences(bar, laws, scene.frequency_hz, samples, 1e-2);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(bar.size());
  Period by_modes, by_differences;
  Eigen::Index in_contact = 0;
  by_modes.state = modes.state(rest, rest);
  by_differences.state = differences.state(rest, rest);
  for (int period = 0; period < 10; ++period) {
    by_modes = modes.advance(by_modes.state, {1e-9, 1e10});
    by_differences = differences.advance(by_differences.state, {1e-11, 1e10});
    ASSERT_TRUE(by_modes.complete() && by_differences.complete());
    expect_near(by_modes.contacts.displacement, by_differences.contacts.displacement, 1e-6);
    expect_near(by_modes.contacts.velocity, by_differences.contacts.velocity, 1e-5);
    expect_near(by_modes.contacts.force, by_differences.contacts.force, 1e-4);
    in_contact += (by_modes.contacts.force.array() != 0.0).count();
  }
  EXPECT_GE(in_contact, 4);
}

// Half a period on either side of the gap at zero: pi sqrt(m/k) and pi sqrt(m/(k + k_c)), from -1e-3 m on.
TEST(PeriodMap, TakesTheBilinearOscillatorBackToItsStart) {
  testing::Oscillator oscillator;
  oscillator.damping = 0.0;
  oscillator.load = 0.0;
  const ContactLaws laws(testing::LinearContact{3.0 * oscillator.stiffness, 0.0});
  const double frequency = std::sqrt(oscillator.stiffness / oscillator.mass) / (1.5 * std::numbers::pi);
  CondensedProblem problem = testing::fourier_problem(oscillator.structure(), 7, 32, frequency);
  ModalMap modes = modal_map(problem, laws);
  BdfMap differences(oscillator.structure(), laws, frequency, samples, 1e-2);
  for (PeriodMap* map : std::initializer_list<PeriodMap*>{&modes, &differences}) {
    const PeriodState begin = map->state(Eigen::VectorXd::Constant(1, -1e-3), Eigen::VectorXd::Zero(1));
    const Period period = map->advance(begin, {1e-10, 1e10});
    ASSERT_TRUE(period.complete());
    const auto closed = (period.contacts.force.array() != 0.0).count();
    EXPECT_NEAR(double(closed), samples / 3.0, 1.0);
    EXPECT_LE((period.state.motion - begin.motion).norm(), 1e-6 * map->size(begin));
  }
}

TEST(PeriodMap, EndsWhereTheOperationsAreUsedUp) {
  const testing::Oscillator oscillator;
  CondensedProblem problem = testing::fourier_problem(oscillator.structure(), 7, 32, 25.0);
  const ContactLaws none;
  ModalMap modes = modal_map(problem, none);
  BdfMap differences(oscillator.structure(), none, 25.0, samples, 1e-2);
  for (PeriodMap* map : std::initializer_list<PeriodMap*>{&modes, &differences}) {
    const PeriodState rest = map->state(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1));
    EXPECT_EQ(map->advance(rest, {1e-8, 100.0}).ended, Period::End::effort_limit);
  }
}

// The repetition of a motion of three periods, as large as `lasting`, with one added that turns by `turns`
// per period and decays.
Repetition after(int periods, double turns, double decay, double lasting) {
  RepetitionRule rule(16, 1e-6);
  const auto at = [&](int n) {
    return lasting * std::polar(1.0, 2.0 * std::numbers::pi * double(n) / 3.0) +
           std::polar(std::pow(decay, n), 2.0 * std::numbers::pi * turns * double(n));
  };
  for (int n = 0; n < periods; ++n) rule.add([&](int lag) { return std::abs(at(n) - at(n - lag)); });
  return rule.found();
}

TEST(RepetitionRule, FindsThreePeriodsAfterATransient) {
  EXPECT_EQ(after(40, 0.0, 0.0, 1.0).periods, 0);
  const Repetition found = after(60, 0.5, 0.5, 1.0);
  EXPECT_EQ(found.periods, 3);
  EXPECT_NEAR(found.apart, std::sqrt(3.0), 1e-6);
}

TEST(RepetitionRule, FindsOnePeriodAtOnce) {
  EXPECT_EQ(after(1, 0.0, 0.0, 0.0).periods, 0);
  EXPECT_EQ(after(3, 0.0, 0.0, 0.0).periods, 1);
}

TEST(RepetitionRule, DoesNotTakeASpiralForARepetition) {
  EXPECT_EQ(after(100, 0.25, 0.9999999, 0.0).periods, 4);  // as good as lasting
  EXPECT_EQ(after(400, 0.25, 0.99, 0.0).periods, 0);
  EXPECT_EQ(after(2000, 0.25, 0.99, 0.0).periods, 1);
}

}  // namespace
}  // namespace wavebalance::solvers

// The map over a period of the load, and after how many periods a motion repeats.

#include <limits>

#include "period/modal_map.hpp"
#include "period/repetition.hpp"
#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"
#include "wavebalance/contact/hunt_crossley_law.hpp"

namespace wavebalance::solvers {
namespace {

constexpr int samples = 1024;

ModalMap modal_map(const CondensedProblem& problem, const ContactLaws& laws) {
  return {
      problem, laws, samples,
      *ModalFlow::make(problem.structure(), problem.frequency(), 1.0 / (problem.frequency() * samples), 50)};
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
  const PeriodState begin = modes.state(Eigen::VectorXd::Constant(1, -1e-3), Eigen::VectorXd::Zero(1));
  const Period period = modes.advance(begin, {1e-10, 1e10});
  ASSERT_TRUE(period.complete);
  const auto closed = (period.contacts.force.array() != 0.0).count();
  EXPECT_NEAR(double(closed), samples / 3.0, 1.0);
  EXPECT_LE((period.state.motion - begin.motion).norm(), 1e-6 * modes.size(begin));
}

TEST(PeriodMap, EndsWhereTheOperationsAreUsedUp) {
  const testing::Oscillator oscillator;
  CondensedProblem problem = testing::fourier_problem(oscillator.structure(), 7, 32, 25.0);
  const ContactLaws none;
  ModalMap modes = modal_map(problem, none);
  EXPECT_FALSE(modes.advance(modes.state({}, {}), {1e-8, 100.0}).complete);
}

// A law of the velocity is evaluated many times per step, which once were counted as one.
TEST(PeriodMap, CountsEachEvaluationOfALaw) {
  const testing::Oscillator oscillator;
  CondensedProblem problem = testing::fourier_problem(oscillator.structure(), 7, 32, 25.0);
  constexpr double pressed = -1.0;
  const auto operations = [&](const ContactLaws& laws) {
    ModalMap modes = modal_map(problem, laws);
    const StepControl even{std::numeric_limits<double>::infinity(), 1e10};
    EXPECT_TRUE(modes.advance(modes.balanced(modes.state({}, {})), even).complete);
    return modes.operations();
  };
  const double stiffness = oscillator.stiffness;
  const double of_one = operations(ContactLaws(testing::LinearContact{stiffness, pressed}));
  const double of_many = operations(ContactLaws(contact::HuntCrossleyLaw(stiffness, 1.5, 0.5, pressed)));
  constexpr double least = 500.0 * 3.0;  // operations of three more evaluations
  EXPECT_GE(of_many - of_one, least * samples);
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

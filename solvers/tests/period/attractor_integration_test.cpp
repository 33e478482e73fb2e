// Motions that structures at rest converge to, and continuation from approximate motions.

#include "wavebalance/solvers/period/attractor_integration.hpp"
#include "period/modal_flow.hpp"
#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/continuation/residual_homotopy.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::solvers {
namespace {

using testing::LinearContact;

// q'' + c q' + k q = -f with f rising linearly: a particular solution of first degree, and free decay.
TEST(ModalFlow, IsExactForForcesLinearInTime) {
  const testing::Oscillator one;
  const double step = 0.013, from = 3.0, to = -5.0;
  const auto flow = ModalFlow::make(one.structure(), 25.0, step, 10);
  ASSERT_TRUE(flow);
  const double k = one.stiffness, c = one.damping, m = one.mass, rate = (to - from) / step;
  const double offset = -(from - c * rate / k) / k;  // particular solution offset - rate t / k
  const double u0 = 2e-3, v0 = 0.1;
  const double decay = 0.5 * c / m, natural = std::sqrt(k / m - decay * decay);
  const double a = u0 - offset, b = (v0 + rate / k + decay * a) / natural;
  const double expected =
      offset - rate * step / k +
      std::exp(-decay * step) * (a * std::cos(natural * step) + b * std::sin(natural * step));
  const Eigen::VectorXd start =
      flow->state(Eigen::VectorXd::Constant(1, u0), Eigen::VectorXd::Constant(1, v0));
  Eigen::VectorXd end = flow->advance(start, Eigen::VectorXd::Constant(1, from));
  const double without_end = flow->contact_displacement(end)[0];
  flow->add_force(end, Eigen::VectorXd::Constant(1, to));
  EXPECT_NEAR(flow->contact_displacement(end)[0], expected, 1e-12 * u0);
  EXPECT_NEAR(without_end - flow->step_compliance()(0, 0) * to, expected, 1e-12 * u0);
}

TEST(ModalFlow, KeepsTheStaticDeflectionOfOmittedModes) {
  const LinearStructure bar = testing::jl14_case_1.structure();
  const double step = 1e-2;  // long against every period: what remains at its end is static
  const auto all = ModalFlow::make(bar, 150.0, 1e3 * step, 100),
             few = ModalFlow::make(bar, 150.0, 1e3 * step, 5);
  ASSERT_TRUE(all && few);
  EXPECT_EQ(few->modes(), 5);
  const Eigen::VectorXd force = Eigen::VectorXd::Ones(1);
  const auto deflection = [&](const ModalFlow& flow) {
    Eigen::VectorXd state = flow.advance(Eigen::VectorXd::Zero(flow.states()), force);
    const double predicted = flow.contact_displacement(state)[0];
    return predicted - flow.step_compliance()(0, 0);
  };
  EXPECT_NEAR(deflection(*few), deflection(*all), 1e-6 * std::abs(deflection(*all)));
}

CondensedProblem oscillator_problem(double frequency) {
  return testing::fourier_problem(testing::Oscillator{}.structure(), 63, 256, frequency);
}

TEST(AttractorIntegration, WithoutContactArrivesAtTheResponseOfTheLoad) {
  const CondensedProblem problem = oscillator_problem(25.0);
  const AttractorMotion motion = settle(problem, AnyContactLaw());
  EXPECT_EQ(motion.attractor_periods, 1);
  const Eigen::VectorXd samples = resample(motion.last.displacement, 256);
  EXPECT_LE((samples - problem.linear_response()).norm(), 1e-5 * samples.norm());
}

TEST(AttractorIntegration, AgainstAStopArrivesAtTheForcedResponse) {
  CondensedProblem problem = oscillator_problem(27.0);
  const LinearContact stop{2e4, 0.4e-3};
  const AttractorMotion motion = settle(problem, stop);
  ASSERT_EQ(motion.attractor_periods, 1);
  const PeriodicResponse response = testing::solved_response(problem, stop);
  EXPECT_LE((resample(motion.last.displacement, 256) - response.displacement).norm(),
            1e-3 * response.displacement.norm());
  EXPECT_LE((resample(motion.last.force, 256) - response.contact_force).norm(),
            1e-2 * response.contact_force.norm());
}

// Between the folds of its curve, at 0.1699 and 0.1957 Hz, the oscillator has a motion that touches the stop
// and one that does not.
class TwoMotions : public ::testing::Test {
 protected:
  TwoMotions()
      : problem_(testing::fourier_pair(63, 256), testing::unit_oscillator(0.05, 0.15),
                 testing::cosine_load()) {
    problem_.set_frequency(0.18);
  }
  AttractorMotion from(double displacement, double velocity) const {
    AttractorOptions options;
    options.displacement = Eigen::VectorXd::Constant(1, displacement);
    options.velocity = Eigen::VectorXd::Constant(1, velocity);
    return settle(problem_, stop_, options);
  }
  AttractorMotion again(const AttractorMotion& motion) const {
    return from(motion.last.displacement(0, 0), motion.last.velocity(0, 0));
  }

  const LinearContact stop_{4.0, 1.0};
  CondensedProblem problem_;
};

TEST_F(TwoMotions, OfOneFrequencyAreEachSettledToFromTheirStates) {
  const AttractorMotion light = settle(problem_, stop_), hard = from(1.0, 0.0);
  ASSERT_EQ(light.attractor_periods, 1);
  ASSERT_EQ(hard.attractor_periods, 1);
  EXPECT_EQ(light.last.force.maxCoeff(), 0.0);
  EXPECT_GT(hard.last.force.maxCoeff(), 0.5);
  for (const AttractorMotion& motion : {light, hard}) {
    const AttractorMotion same = again(motion);
    EXPECT_EQ(same.attractor_periods, 1);
    EXPECT_LE((same.last.displacement - motion.last.displacement).norm(),
              1e-4 * motion.last.displacement.norm());
    EXPECT_LT(same.periods, motion.periods);  // it begins where the other one ended
  }
}

TEST_F(TwoMotions, StateOfRestIsThatWithoutAState) {
  const AttractorMotion rest = settle(problem_, stop_), zero = from(0.0, 0.0);
  EXPECT_EQ(zero.periods, rest.periods);
  EXPECT_EQ(zero.last.displacement, rest.last.displacement);
}

TEST_F(TwoMotions, RefuseAStateThatIsNotOfTheStructure) {
  AttractorOptions options;
  options.velocity = Eigen::VectorXd::Zero(2);
  EXPECT_THROW(settle(problem_, stop_, options), std::invalid_argument);
  EXPECT_THROW(from(std::nan(""), 0.0), std::invalid_argument);
}

// Driven at four times its natural frequency: the decaying motion turns by a right angle per period.
TEST(AttractorIntegration, DoesNotTakeASpiralForASubharmonicMotion) {
  constexpr double omega = 2.0 * std::numbers::pi;
  const testing::Oscillator one{
      .mass = 1.0, .damping = 0.04 * omega, .stiffness = omega * omega, .load = 1.0};
  CondensedProblem problem = testing::fourier_problem(one.structure(), 7, 32, 4.0);
  EXPECT_EQ(settle(problem, AnyContactLaw()).attractor_periods, 1);
}

TEST(AttractorIntegration, ReportsWhatItCannotIntegrateAndStopsWhenAsked) {
  const CondensedProblem problem = oscillator_problem(25.0);
  AttractorOptions small;
  small.max_size = 0;
  EXPECT_EQ(settle(problem, AnyContactLaw(), small).attractor_periods, AttractorMotion::unknown);
  testing::Oscillator undamped;
  undamped.damping = 0.0;
  CondensedProblem resonant = testing::fourier_problem(undamped.structure(), 7, 32, 25.0);
  EXPECT_EQ(settle(resonant, AnyContactLaw()).attractor_periods, 0);  // it beats for ever
  AttractorOptions stopped;
  int periods = 0;
  stopped.observer = [&](const Progress& progress) {
    EXPECT_EQ(progress.phase, "settling");
    return ++periods < 3;
  };
  EXPECT_TRUE(settle(problem, AnyContactLaw(), stopped).cancelled);
  EXPECT_EQ(periods, 3);
  AttractorOptions wrong;
  wrong.steps = 0;
  EXPECT_THROW(settle(problem, AnyContactLaw(), wrong), std::invalid_argument);
}

TEST(ResidualHomotopy, LeadsFromAnApproximateMotionToASolution) {
  CondensedProblem problem = oscillator_problem(27.0);
  ContactSystem system(problem, LinearContact{9e4, 0.4e-3});
  Eigen::VectorXd u = 1.2 * problem.linear_response();
  ASSERT_EQ(residual_homotopy(system, u, {}), HomotopyStatus::arrived);
  EXPECT_LE(system.evaluate(u), 1e-6);
  ResidualHomotopyOptions one;
  one.max_points = 1;
  Eigen::VectorXd start = 3.0 * problem.linear_response();
  EXPECT_EQ(residual_homotopy(system, start, one), HomotopyStatus::effort_limit);
  one.max_points = 0;
  EXPECT_THROW(residual_homotopy(system, start, one), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers

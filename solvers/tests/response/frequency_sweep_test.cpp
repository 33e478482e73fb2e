#include "wavebalance/solvers/response/frequency_sweep.hpp"

#include <optional>

#include "support/collocation_cases.hpp"
#include "support/solved.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

struct BarSweep {
  CondensedProblem problem;
  FrequencySweepOptions options;

  explicit BarSweep(TimePair pair)
      : problem(std::move(pair), testing::jl14_case_2.structure(), testing::cosine_load()) {
    options.from = 1100.0;
    options.to = 1700.0;
  }
  FrequencySweep run() { return frequency_sweep(problem, testing::jl14_case_2.law, options); }
};

// Where the largest sample of the linear response reaches the gap, by bisection.
double grazing_frequency(CondensedProblem& problem, double gap, double low, double high) {
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    problem.set_frequency(middle);
    (problem.linear_response().maxCoeff() > gap ? low : high) = middle;
  }
  return low;
}

TEST(FrequencySweep, ReversesWhereTheBarGrazes) {
  for (const bool haar : {false, true})
    for (const bool rising : {true, false}) {
      BarSweep sweep(haar ? testing::make_pair(testing::HaarBasis{64}, spectral::FourierBasis(64), 256)
                          : testing::fourier_pair(63, 256));
      if (!rising) std::swap(sweep.options.from, sweep.options.to);
      const FrequencySweep result = sweep.run();
      ASSERT_EQ(result.status, SweepStatus::reached_end);
      ASSERT_GE(result.turning_points.size(), 2u);
      const TurningPoint& turn = rising ? result.turning_points.back() : result.turning_points.front();
      const double grazing = grazing_frequency(sweep.problem, testing::jl14_case_2.law.start, 1300.0, 1400.0);
      EXPECT_TRUE(turn.grazing);
      EXPECT_NEAR(turn.frequency, grazing, haar ? 1e-4 : 2e-2);
      EXPECT_NEAR(turn.max_displacement, testing::jl14_case_2.law.start, 2e-5);
      for (const SweepPoint& point : result.points) EXPECT_LE(point.residual, 1e-10);
    }
}

// A mass that its static load presses on a spring, 30 deep, and that vibrates by 0.005 outside its
// resonance and by 1.8 in it. Measured by the gap of 10, one step would change the vibration to twice as
// much.
TEST(FrequencySweep, StepsAreSharesOfAVibrationAboutALargeStaticDeflection) {
  constexpr double damping = 0.004, load = 0.01;
  LinearStructure structure = testing::unit_oscillator(damping, load);
  structure.forces = {{Eigen::VectorXd::Constant(1, 50.0), Eigen::VectorXcd::Ones(1)}};
  const ContactLaws laws(AnyContactLaw(testing::LinearContact{1.0, 10.0}));
  CondensedProblem problem = testing::fourier_problem(structure, 15, 64);
  FrequencySweepOptions options = testing::between(0.1, 0.4);
  const FrequencySweep sweep = testing::complete_sweep(problem, laws, options);
  double amplitude = 0.0;
  for (std::size_t i = 1; i < sweep.points.size(); ++i) {
    const Eigen::VectorXd &before = sweep.points[i - 1].unknown, &now = sweep.points[i].unknown;
    const double vibration = (before.array() - before.mean()).matrix().norm();
    EXPECT_LT((now - before).norm(), 1.1 * options.arc_length.max_step * vibration) << i;
    amplitude = std::max(amplitude, 0.5 * (now.maxCoeff() - now.minCoeff()));
  }
  const double stiffness = 2.0, peak = load / (damping * std::sqrt(stiffness - 0.25 * damping * damping));
  EXPECT_GT(amplitude, 0.95 * peak);
}

// The curve of JL14's case 2 from its response at 1275 Hz.
class BarCurve : public ::testing::Test {
 protected:
  BarCurve() : sweep_(testing::fourier_pair(31, 128)), law_(testing::jl14_case_2.law) {
    sweep_.problem.set_frequency(1275.0);
    first_ = forced_response(sweep_.problem, law_, {}).displacement;
    system_.emplace(sweep_.problem, law_);
    options_.displacement_scale = law_.gap();
    options_.parameter_scale = 20.0;
  }

  BarSweep sweep_;
  AnyContactLaw law_;
  Eigen::VectorXd first_;
  std::optional<ContactSystem> system_;
  ArcLengthOptions options_;
  FrequencyParameter parameter_;
};

// Else a curve with thousands of samples in contact would go on for minutes.
TEST_F(BarCurve, EndsWhereItsOperationsAreUsedUp) {
  options_.max_operations = 1e5;  // an LU of the 25 samples in contact needs 1e4
  ArcLength curve(*system_, parameter_, options_);
  ASSERT_EQ(curve.start(first_, 1275.0, 1.0), ArcLength::Status::advanced);
  int points = 0;
  while (curve.advance() == ArcLength::Status::advanced) ++points;
  EXPECT_GT(points, 0);
  EXPECT_LT(points, 30);  // the whole curve has some hundred
  EXPECT_GT(system_->operations(), 1e5);
  EXPECT_LT(system_->operations(), 2e5);
}

// Points, unit tangents and grazing events of the curve, each checked with a separate problem.
TEST_F(BarCurve, SolvesItsFrequencyAtEveryPoint) {
  ArcLength curve(*system_, parameter_, options_);
  ASSERT_EQ(curve.start(first_, 1275.0, 1.0), ArcLength::Status::advanced);
  BarSweep fresh(testing::fourier_pair(31, 128));
  ContactSystem check(fresh.problem, law_);
  int falling = 0;
  while (curve.point().displacement.maxCoeff() > 0.8 * law_.gap()) {
    ASSERT_EQ(curve.advance(), ArcLength::Status::advanced);
    const CurvePoint& point = curve.point();
    fresh.problem.set_frequency(point.parameter);
    EXPECT_LE(check.evaluate(point.displacement), 1e-10);
    const double length = point.displacement_tangent.squaredNorm() / (128 * law_.gap() * law_.gap()) +
                          point.parameter_tangent * point.parameter_tangent / 400.0;
    EXPECT_NEAR(length, 1.0, 1e-12);
    falling += point.parameter_tangent < 0.0;
  }
  EXPECT_GT(falling, 3) << "the curve must have turned back and on again";
  CurvePoint missed;
  EXPECT_FALSE(curve.locate([](const CurvePoint&) { return 1.0; }, missed));
}

TEST(FrequencySweep, StopsAtThePointLimitAndWhenTheObserverSaysSo) {
  BarSweep sweep(testing::fourier_pair(31, 128));
  sweep.options.max_points = 7;
  const FrequencySweep limited = sweep.run();
  EXPECT_EQ(limited.status, SweepStatus::point_limit);
  EXPECT_EQ(limited.points.size(), 7u);
  sweep.options.max_points = 1000;
  int seen = 0;
  sweep.options.observer = [&](const Progress& progress) {
    if (progress.phase != "frequency sweep") return true;
    EXPECT_EQ(progress.measure, "Hz");
    EXPECT_GE(progress.value, 1100.0);
    EXPECT_EQ(progress.step, seen + 1);
    EXPECT_TRUE(progress.done >= 0.0 && progress.done <= 1.0);
    return ++seen < 5;
  };
  const FrequencySweep cancelled = sweep.run();
  EXPECT_EQ(cancelled.status, SweepStatus::cancelled);
  EXPECT_EQ(cancelled.points.size(), 5u);
}

TEST(FrequencySweep, ObserverMayStopAtTheFirstPoint) {
  BarSweep sweep(testing::fourier_pair(31, 128));
  sweep.options.observer = [](const Progress& progress) { return progress.phase != "frequency sweep"; };
  const FrequencySweep result = sweep.run();
  EXPECT_EQ(result.status, SweepStatus::cancelled);
  EXPECT_EQ(result.points.size(), 1u);
}

TEST(FrequencySweep, ObserverMayStopTheSolutionOfTheFirstPoint) {
  BarSweep sweep(testing::fourier_pair(31, 128));
  sweep.options.from = 1275.0;  // in contact, where Newton iterates
  sweep.options.observer = [](const Progress&) { return false; };
  const FrequencySweep result = sweep.run();
  EXPECT_EQ(result.status, SweepStatus::cancelled);
  EXPECT_TRUE(result.points.empty());
}

TEST(FrequencySweep, SaysWhenThereIsNoStart) {
  BarSweep sweep(testing::fourier_pair(31, 128));
  sweep.options.from = 1275.0;
  sweep.options.start.newton.max_iterations = 1;
  sweep.options.start.fallbacks = false;
  const FrequencySweep result = sweep.run();
  EXPECT_EQ(result.status, SweepStatus::no_start);
  EXPECT_TRUE(result.points.empty());
}

// A force that jumps at the gap: the curve of responses without contact ends there.
struct Jump {
  double force(double u) const { return u > 14.5e-3 ? 1e6 : 0.0; }
  double tangent(double) const { return 0.0; }
  double potential(double u) const { return u > 14.5e-3 ? 1e6 * (u - 14.5e-3) : 0.0; }
  double gap() const { return 14.5e-3; }
};

TEST(FrequencySweep, SaysWhenTheCurveEnds) {
  BarSweep sweep(testing::fourier_pair(31, 128));
  const FrequencySweep result = frequency_sweep(sweep.problem, Jump{}, sweep.options);
  EXPECT_EQ(result.status, SweepStatus::lost);
  ASSERT_FALSE(result.points.empty());
  EXPECT_LE(result.points.back().max_displacement, 14.5e-3 * (1 + 1e-3));  // between the 128 samples
}

// An even number of functions leaves the Nyquist coefficient of the bar without damping.
TEST(FrequencySweep, SaysWhenTheCurveGrowsPastAllBounds) {
  BarSweep even(testing::fourier_pair(64, 256)), odd(testing::fourier_pair(63, 256));
  even.options.arc_length.grazing_events = odd.options.arc_length.grazing_events = GrazingEvents::all;
  EXPECT_EQ(even.run().status, SweepStatus::unbounded);
  EXPECT_EQ(odd.run().status, SweepStatus::reached_end);
}

// Steps grow to more than the frequency itself: a trial point below zero is a step too long, not an error.
TEST(FrequencySweep, GoesDownToAHundredthOfTheFirstFrequency) {
  CondensedProblem problem = testing::fourier_problem(testing::jl14_case_1.structure(), 7, 32);
  const FrequencySweep result =
      testing::complete_sweep(problem, testing::jl14_case_1.law, testing::between(100.0, 0.1));
  EXPECT_NEAR(result.points.back().frequency, 0.1, 1e-8);
}

TEST(FrequencySweep, RefusesFrequenciesThatAreNotPositiveAndDifferent) {
  BarSweep sweep(testing::fourier_pair(7, 32));
  for (const auto& [from, to] : {std::pair{0.0, 1.0}, {1.0, -1.0}, {1.0, 1.0}, {1.0, std::nan("")}}) {
    sweep.options.from = from;
    sweep.options.to = to;
    EXPECT_THROW(sweep.run(), std::invalid_argument);
  }
  sweep.options.to = 2.0;
  sweep.options.smallest_return = -1.0;
  EXPECT_THROW(sweep.run(), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers

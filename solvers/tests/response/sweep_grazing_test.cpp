#include "dense_algebra.hpp"
#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"

namespace wavebalance::solvers {
namespace {

// m = k = 1 of each, uncoupled, with a stop of `stiffness` at a gap of 1.
struct StoppedOscillators {
  double stiffness = 10.0;
  int count = 1;

  FrequencySweep sweep(TimePair pair, double from, double to,
                       GrazingEvents events = GrazingEvents::at_turning_points) const {
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(count, count);
    LinearStructure structure;
    structure.mass = structure.stiffness = identity.sparseView();
    structure.damping = 0.04 * structure.mass;
    structure.load = Eigen::VectorXd::Constant(count, 0.1);
    structure.contact_directions.resize(count, count);
    structure.contact_directions.setIdentity();
    CondensedProblem problem(std::move(pair), structure, testing::cosine_load());
    FrequencySweepOptions options = testing::between(from, to);
    options.arc_length.grazing_events = events;
    if (events == GrazingEvents::all) options.smallest_return = 1e-12;
    return frequency_sweep(problem, testing::LinearContact{stiffness, 1.0}, options);
  }
};

std::vector<double> turning_frequencies(const FrequencySweep& sweep) {
  std::vector<double> frequencies;
  for (const TurningPoint& turn : sweep.turning_points) frequencies.push_back(turn.frequency);
  return frequencies;
}

void expect_near(const std::vector<double>& a, const std::vector<double>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], tolerance) << i;
}

// Their samples reach the gaps together. At each turning point three curves meet: with contact of all, of one
// and of none.
TEST(FrequencySweep, OfTwinsThatTouchTogetherIsThatOfOne) {
  for (const bool haar : {false, true})
    for (const bool rising : {true, false}) {
      const auto pair = [&] {
        return haar ? testing::make_pair(testing::HaarBasis{16}, spectral::FourierBasis(16), 64)
                    : testing::fourier_pair(15, 64);
      };
      const double from = rising ? 0.1 : 0.35, to = rising ? 0.35 : 0.1;
      const FrequencySweep one = StoppedOscillators{10.0, 1}.sweep(pair(), from, to, GrazingEvents::all);
      const FrequencySweep two = StoppedOscillators{10.0, 2}.sweep(pair(), from, to, GrazingEvents::all);
      const FrequencySweep three = StoppedOscillators{10.0, 3}.sweep(pair(), from, to);
      EXPECT_EQ(one.status, SweepStatus::reached_end) << to_string(one.status);
      EXPECT_EQ(two.status, SweepStatus::reached_end) << to_string(two.status);
      EXPECT_EQ(three.status, SweepStatus::reached_end) << to_string(three.status);
      EXPECT_GT(one.turning_points.size(), 10u);
      expect_near(turning_frequencies(one), turning_frequencies(two), 1e-8);
    }
}

TEST(FrequencySweep, OfEveryGrazingEventIsTheSameUpAndDown) {
  for (const double stiffness : {1.0, 10.0, 100.0}) {
    const StoppedOscillators one{stiffness};
    for (const int functions : {7, 15}) {
      const auto pair = testing::fourier_pair(functions, 32);
      const FrequencySweep up = one.sweep(pair, 0.1, 0.35, GrazingEvents::all),
                           down = one.sweep(pair, 0.35, 0.1, GrazingEvents::all);
      ASSERT_EQ(up.status, SweepStatus::reached_end);
      ASSERT_EQ(down.status, SweepStatus::reached_end);
      std::vector<double> reversed = turning_frequencies(down);
      std::reverse(reversed.begin(), reversed.end());
      expect_near(turning_frequencies(up), reversed, 1e-8);
    }
  }
}

// Stops on both sides at different gaps.
struct TwoGaps {
  double stiffness = 3.0, below = 0.6, above = 1.0;
  double force(double u) const {
    return u > above ? stiffness * (u - above) : u < -below ? stiffness * (u + below) : 0.0;
  }
  double tangent(double u) const { return u >= above || u < -below ? stiffness : 0.0; }
  double potential(double u) const {
    const double into = u > above ? u - above : u < -below ? u + below : 0.0;
    return 0.5 * stiffness * into * into;
  }
  double gap() const { return above; }
  std::vector<double> kinks() const { return {-below, above}; }
  bool unilateral() const { return false; }
};

// Where several samples reach different kinks within one step, the first of them ends the piece.
TEST(FrequencySweep, PassesEveryKinkOfStopsOnBothSidesWithShortAndLongSteps) {
  const auto turns = [](double max_step) {
    CondensedProblem problem = testing::fourier_problem(testing::unit_oscillator(0.04, 0.1), 15, 32);
    FrequencySweepOptions options = testing::between(0.1, 0.35);
    options.arc_length.grazing_events = GrazingEvents::all;
    options.arc_length.max_step = max_step;
    options.arc_length.initial_step = std::min(options.arc_length.initial_step, max_step);
    options.smallest_return = 1e-12;
    const FrequencySweep sweep = testing::complete_sweep(problem, TwoGaps{}, options);
    return turning_frequencies(sweep);
  };
  const std::vector<double> fine = turns(0.002);
  EXPECT_GT(fine.size(), 4u);
  for (const double step : {0.02, 0.1, 0.4}) expect_near(turns(step), fine, 1e-8);
}

// All responses at a frequency, without following anything: each set of neighbouring samples in contact, and
// none, gives a linear system, whose solution is a response if it presses there and nowhere else.
int count_responses(CondensedProblem& problem, double frequency, const testing::LinearContact& law) {
  problem.set_frequency(frequency);
  const Eigen::MatrixXd compliance = testing::compliance_matrix(problem);
  const int points = problem.points();
  int found = problem.linear_response().maxCoeff() <= law.start ? 1 : 0;
  for (int first = 0; first < points; ++first)
    for (int length = 1; length < points; ++length) {
      Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(points);
      for (int i = 0; i < length; ++i) stiffness[(first + i) % points] = law.stiffness;
      const Eigen::MatrixXd jacobian =
          Eigen::MatrixXd::Identity(points, points) + compliance * stiffness.asDiagonal();
      const Eigen::VectorXd right = problem.linear_response() + law.start * (compliance * stiffness);
      const Eigen::VectorXd u = oracle::solve(jacobian, right);
      found += ((u.array() > law.start) == (stiffness.array() > 0.0)).all() ? 1 : 0;
    }
  return found;
}

TEST(FrequencySweep, OfEveryGrazingEventPassesAllResponses) {
  const testing::LinearContact law{1.0, 1.0};
  const TimePair pair = testing::fourier_pair(15, 32);
  const FrequencySweep sweep = StoppedOscillators{1.0}.sweep(pair, 0.1, 0.35, GrazingEvents::all);
  ASSERT_EQ(sweep.status, SweepStatus::reached_end);
  std::vector<double> curve = turning_frequencies(sweep);
  EXPECT_EQ(curve.size(), 12u);
  std::vector<double> sorted = curve;
  std::sort(sorted.begin(), sorted.end());
  curve.insert(curve.begin(), 0.1);
  curve.push_back(0.35);
  CondensedProblem problem(pair, testing::unit_oscillator(0.04, 0.1), testing::cosine_load());
  for (std::size_t i = 0; i + 1 < sorted.size(); ++i) {
    const double frequency = 0.5 * (sorted[i] + sorted[i + 1]);
    int passes = 0;
    for (std::size_t k = 0; k + 1 < curve.size(); ++k)
      passes += (curve[k] < frequency) != (curve[k + 1] < frequency) ? 1 : 0;
    EXPECT_EQ(count_responses(problem, frequency, law), passes) << frequency << " Hz";
  }
}

// Long steps may miss small returns, but the turning points found are on the curve.
TEST(FrequencySweep, TurningPointsFoundWithLongStepsLieOnTheCurve) {
  const StoppedOscillators one{1.0};
  for (const TimePair& pair : {testing::fourier_pair(15, 32), testing::fourier_pair(31, 128)}) {
    const FrequencySweep every = one.sweep(pair, 0.1, 0.35, GrazingEvents::all);
    const FrequencySweep some = one.sweep(pair, 0.1, 0.35);
    ASSERT_EQ(some.status, SweepStatus::reached_end);
    ASSERT_GE(some.turning_points.size(), 2u);
    EXPECT_LT(some.turning_points.size(), every.turning_points.size());
    for (const double frequency : turning_frequencies(some)) {
      double nearest = 1.0;
      for (const double other : turning_frequencies(every))
        nearest = std::min(nearest, std::abs(other - frequency));
      EXPECT_LE(nearest, 1e-8) << frequency;
    }
    EXPECT_GE(some.turning_points[0].frequency, some.turning_points[1].frequency + 0.25e-3);
  }
}

// Equal sectors under equal loads: the coupling does not act while all move alike, but curves of unlike
// motions leave the common one at its turning points.
TEST(FrequencySweep, OfACyclicStructureUnderEqualLoadsIsThatOfItsSector) {
  constexpr int sectors = 4;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Identity(sectors, sectors);
  for (int i = 0; i < sectors; ++i) {
    const int next = (i + 1) % sectors;
    stiffness(i, i) += 0.3;
    stiffness(next, next) += 0.3;
    stiffness(i, next) -= 0.3;
    stiffness(next, i) -= 0.3;
  }
  LinearStructure ring = testing::unit_oscillator(0.04, 0.1);
  ring.stiffness = stiffness.sparseView();
  ring.mass = Eigen::MatrixXd::Identity(sectors, sectors).sparseView();
  ring.damping = 0.04 * ring.mass;
  ring.load = Eigen::VectorXd::Constant(sectors, 0.1);
  ring.contact_directions = contact_rows({0, 1, 2, 3}, ring.size());
  const TimePair pair = testing::fourier_pair(7, 32);
  CondensedProblem problem(pair, ring, testing::cosine_load());
  const FrequencySweep whole =
      frequency_sweep(problem, testing::LinearContact{10.0, 1.0}, testing::between(0.35, 0.1));
  const FrequencySweep sector = StoppedOscillators{10.0}.sweep(pair, 0.35, 0.1, GrazingEvents::all);
  ASSERT_EQ(whole.status, SweepStatus::reached_end) << to_string(whole.status);
  ASSERT_EQ(sector.status, SweepStatus::reached_end) << to_string(sector.status);
  expect_near(turning_frequencies(whole), turning_frequencies(sector), 1e-8);
}

// Near some kinks of a stop 650 times as stiff as the structure no step of some lengths leads on. The weight
// deflects it twenty times as far as it vibrates.
TEST(FrequencySweep, OfAHeavyMassOnAStiffStopReachesItsEndWithStepsOfAnyLength) {
  const double from = 7.258013048393989, to = 16.710987934217528;
  LinearStructure heavy = testing::Oscillator{.mass = 1.073514447533596,
                                              .damping = 3.7231150496841336,
                                              .stiffness = 6122.4230958026174,
                                              .load = 0.2811668913552674}
                              .structure();
  heavy.forces.push_back({Eigen::VectorXd::Constant(1, 122.44846191605234), Eigen::VectorXcd::Ones(1)});
  CondensedProblem problem = testing::fourier_problem(heavy, 63, 252);
  for (const double steps : {80.0, 111.0, 130.0, 160.0, 200.0, 230.0, 300.0, 320.0, 400.0, 480.0, 640.0}) {
    FrequencySweepOptions options = testing::between(from, to);
    options.output_points = 64;
    options.arc_length.max_step = 20.0 / steps;
    options.arc_length.initial_step = options.arc_length.max_step / 12.5;
    options.arc_length.min_step = std::min(1e-3, options.arc_length.initial_step / 20.0);
    const testing::LinearContact stop{3964183.877915115, 0.020389023978488015};
    EXPECT_EQ(frequency_sweep(problem, stop, options).status, SweepStatus::reached_end) << steps;
  }
}

}  // namespace
}  // namespace wavebalance::solvers

#include "wavebalance/solvers/frequency_sweep.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "oscillator.hpp"
#include "small_problems.hpp"

namespace wavebalance::solvers {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

// u'' + 2 zeta u' + u + u^3 = cos, time in units of 1/omega_0: with one harmonic and enough points for the
// third, balance is exact and has a closed form.
struct Cubic {
  double force(double u) const { return u * u * u; }
  double tangent(double u) const { return 3.0 * u * u; }
  double potential(double u) const { return 0.25 * u * u * u * u; }
  double gap() const { return std::numeric_limits<double>::infinity(); }
};

constexpr double duffing_load = 0.3, duffing_damping = 0.05;

LinearStructure oscillator(double damping, double load) {
  LinearStructure one = testing::jl14_bar(1, 0.0);
  one.mass.coeffRef(0, 0) = 1.0;
  one.stiffness.coeffRef(0, 0) = 1.0;
  one.damping.resize(1, 1);
  one.damping.coeffRef(0, 0) = damping;
  one.load[0] = load;
  return one;
}

// Frequencies (Hz) on the Duffing curve at amplitude a, lower and upper branch of
// ((1 - w^2 + 3/4 a^2)^2 + (c w)^2) a^2 = F^2, a quadratic equation for w^2.
std::array<double, 2> duffing_frequencies(double a) {
  const double k = 1.0 + 0.75 * a * a, c = duffing_damping, ratio = duffing_load / a;
  const double half = k - 0.5 * c * c;
  const double root = std::sqrt(half * half - k * k + ratio * ratio);
  return {std::sqrt(std::max(half - root, 0.0)) / two_pi, std::sqrt(half + root) / two_pi};
}

// Where a branch turns in frequency between two amplitudes, by golden section.
double duffing_fold(int branch, double low, double high, double sign) {
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  const auto value = [&](double a) {
    return sign * duffing_frequencies(a)[static_cast<std::size_t>(branch)];
  };
  for (int i = 0; i < 200; ++i) {
    const double left = high - ratio * (high - low), right = low + ratio * (high - low);
    (value(left) > value(right) ? high : low) = value(left) > value(right) ? right : left;
  }
  return sign * value(0.5 * (low + high));
}

FrequencySweep duffing_sweep(double from, double to) {
  CondensedProblem problem(testing::fourier_pair(3, 16), oscillator(duffing_damping, duffing_load),
                           testing::cosine_load());
  FrequencySweepOptions options;
  options.from = from;
  options.to = to;
  return frequency_sweep(problem, Cubic{}, options);
}

TEST(FrequencySweep, PointsLieOnTheClosedFormOfTheDuffingCurve) {
  const FrequencySweep sweep = duffing_sweep(0.05, 0.5);
  ASSERT_EQ(sweep.status, SweepStatus::reached_end) << to_string(sweep.status);
  ASSERT_GT(sweep.points.size(), 30u);
  for (const SweepPoint& point : sweep.points) {
    const double a = std::sqrt(2.0) * point.rms_displacement, w = two_pi * point.frequency;
    const double k = 1.0 + 0.75 * a * a - w * w;
    EXPECT_NEAR(a * std::hypot(k, duffing_damping * w), duffing_load, 1e-8) << point.frequency;
    EXPECT_NEAR(point.max_displacement, a, 1e-5 * a);  // 1024 points miss the top by less than (pi/1024)^2/2
    EXPECT_FALSE(point.corner);
  }
  EXPECT_EQ(sweep.points.front().frequency, 0.05);
  EXPECT_NEAR(sweep.points.back().frequency, 0.5, 1e-9);
}

TEST(FrequencySweep, FindsTheFoldsOfTheDuffingCurveInBothDirections) {
  // The backbone's peak a = F / (c w) bounds the upper branch; the lower fold lies on the right branch.
  double peak = 1.0;
  for (int i = 0; i < 200; ++i) peak = duffing_load / (duffing_damping * std::sqrt(1.0 + 0.75 * peak * peak));
  const double upper = duffing_fold(1, 0.9 * peak, peak, 1.0);
  const double lower = duffing_fold(1, 0.2, 0.9 * peak, -1.0);
  ASSERT_LT(lower, 0.95 * upper);
  for (const bool rising : {true, false}) {
    const FrequencySweep sweep = rising ? duffing_sweep(0.05, 0.5) : duffing_sweep(0.5, 0.05);
    ASSERT_EQ(sweep.status, SweepStatus::reached_end);
    ASSERT_EQ(sweep.turning_points.size(), 2u);
    EXPECT_NEAR(sweep.turning_points[rising ? 0 : 1].frequency, upper, 1e-7);
    EXPECT_NEAR(sweep.turning_points[rising ? 1 : 0].frequency, lower, 1e-7);
  }
}

// m = k = 1 of each, uncoupled, with a stop of `stiffness` at a gap of 1.
struct StoppedOscillators {
  double stiffness = 10.0;
  int count = 1;

  FrequencySweep sweep(TimePair pair, double from, double to, Corners corners = Corners::at_turns) const {
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(count, count);
    LinearStructure structure;
    structure.mass = structure.stiffness = identity.sparseView();
    structure.damping = 0.04 * structure.mass;
    structure.load = Eigen::VectorXd::Constant(count, 0.1);
    structure.contact_dofs.clear();
    for (int c = 0; c < count; ++c) structure.contact_dofs.push_back(c);
    CondensedProblem problem(std::move(pair), structure, testing::cosine_load());
    FrequencySweepOptions options;
    options.from = from;
    options.to = to;
    options.arc_length.corners = corners;
    if (corners == Corners::every) options.smallest_return = 1e-12;
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

// Their samples reach the gaps together, and at each turn three curves meet: all touch, one does, none does.
TEST(FrequencySweep, OfTwinsThatTouchTogetherIsThatOfOne) {
  for (const bool haar : {false, true})
    for (const bool rising : {true, false}) {
      const auto pair = [&] {
        return haar ? testing::make_pair(testing::HaarBasis{16}, spectral::FourierBasis(16), 64)
                    : testing::fourier_pair(15, 64);
      };
      const double from = rising ? 0.1 : 0.35, to = rising ? 0.35 : 0.1;
      const FrequencySweep one = StoppedOscillators{10.0, 1}.sweep(pair(), from, to, Corners::every);
      const FrequencySweep two = StoppedOscillators{10.0, 2}.sweep(pair(), from, to, Corners::every);
      const FrequencySweep three = StoppedOscillators{10.0, 3}.sweep(pair(), from, to);
      EXPECT_EQ(one.status, SweepStatus::reached_end) << to_string(one.status);
      EXPECT_EQ(two.status, SweepStatus::reached_end) << to_string(two.status);
      EXPECT_EQ(three.status, SweepStatus::reached_end) << to_string(three.status);
      EXPECT_GT(one.turning_points.size(), 10u);
      expect_near(turning_frequencies(one), turning_frequencies(two), 1e-8);
    }
}

TEST(FrequencySweep, OfEveryCornerIsTheSameUpAndDown) {
  for (const double stiffness : {1.0, 10.0, 100.0}) {
    const StoppedOscillators one{stiffness};
    for (const int functions : {7, 15}) {
      const auto pair = testing::fourier_pair(functions, 32);
      const FrequencySweep up = one.sweep(pair, 0.1, 0.35, Corners::every),
                           down = one.sweep(pair, 0.35, 0.1, Corners::every);
      ASSERT_EQ(up.status, SweepStatus::reached_end);
      ASSERT_EQ(down.status, SweepStatus::reached_end);
      std::vector<double> reversed = turning_frequencies(down);
      std::reverse(reversed.begin(), reversed.end());
      expect_near(turning_frequencies(up), reversed, 1e-8);
    }
  }
}

// All responses at a frequency, without following anything: each set of neighbouring samples in contact, and
// none, gives a linear system, whose solution is a response if it presses there and nowhere else.
int count_responses(CondensedProblem& problem, double frequency, const testing::LinearContact& law) {
  problem.set_frequency(frequency);
  const Eigen::MatrixXd compliance = testing::compliance_matrix(problem);
  const int points = problem.points();
  int found = problem.free_response().maxCoeff() <= law.start ? 1 : 0;
  for (int first = 0; first < points; ++first)
    for (int length = 1; length < points; ++length) {
      Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(points);
      for (int i = 0; i < length; ++i) stiffness[(first + i) % points] = law.stiffness;
      const Eigen::MatrixXd jacobian =
          Eigen::MatrixXd::Identity(points, points) + compliance * stiffness.asDiagonal();
      const Eigen::VectorXd u =
          jacobian.partialPivLu().solve(problem.free_response() + law.start * (compliance * stiffness));
      found += ((u.array() > law.start) == (stiffness.array() > 0.0)).all() ? 1 : 0;
    }
  return found;
}

TEST(FrequencySweep, OfEveryCornerPassesAllResponsesThatThereAre) {
  const testing::LinearContact law{1.0, 1.0};
  const TimePair pair = testing::fourier_pair(15, 32);
  const FrequencySweep sweep = StoppedOscillators{1.0}.sweep(pair, 0.1, 0.35, Corners::every);
  ASSERT_EQ(sweep.status, SweepStatus::reached_end);
  std::vector<double> curve = turning_frequencies(sweep);
  EXPECT_EQ(curve.size(), 12u);
  std::vector<double> sorted = curve;
  std::sort(sorted.begin(), sorted.end());
  curve.insert(curve.begin(), 0.1);
  curve.push_back(0.35);
  CondensedProblem problem(pair, oscillator(0.04, 0.1), testing::cosine_load());
  for (std::size_t i = 0; i + 1 < sorted.size(); ++i) {
    const double frequency = 0.5 * (sorted[i] + sorted[i + 1]);
    int passes = 0;
    for (std::size_t k = 0; k + 1 < curve.size(); ++k)
      passes += (curve[k] < frequency) != (curve[k + 1] < frequency) ? 1 : 0;
    EXPECT_EQ(count_responses(problem, frequency, law), passes) << frequency << " Hz";
  }
}

// Long steps may leave out small returns, but what they report is on the curve.
TEST(FrequencySweep, TurnsReportedWithLongStepsAreTurnsOfTheCurve) {
  const StoppedOscillators one{1.0};
  for (const TimePair& pair : {testing::fourier_pair(15, 32), testing::fourier_pair(31, 128)}) {
    const FrequencySweep every = one.sweep(pair, 0.1, 0.35, Corners::every);
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

// A linear stop at a gap, one harmonic and the mean, in the limit of many points: with u = a0 + A cos(x) in
// contact for |x| < b, the mean and the first harmonic of the force are A k_c / pi (sin b - b cos b) and
// A k_c / pi (b - sin b cos b), a0 = gap - A cos b, and balance gives A and the frequencies for each b.
struct LinearStop {
  double stiffness = 2.0, start = 1.0;
  double force(double u) const { return u > start ? stiffness * (u - start) : 0.0; }
  double tangent(double u) const { return u >= start ? stiffness : 0.0; }
  double potential(double u) const { return u > start ? 0.5 * stiffness * (u - start) * (u - start) : 0.0; }
  double gap() const { return start; }

  // Hz on the branch of the higher frequency; NaN where the load does not reach that far.
  double frequency(double b, double load, double damping) const {
    const double share = stiffness / std::numbers::pi;
    const double amplitude = start / (std::cos(b) - share * (std::sin(b) - b * std::cos(b)));
    const double k = 1.0 + share * (b - std::sin(b) * std::cos(b));
    const double half = k - 0.5 * damping * damping, ratio = load / amplitude;
    if (amplitude < 0.0) return std::nan("");
    return std::sqrt(half + std::sqrt(half * half - k * k + ratio * ratio)) / two_pi;
  }
};

TEST(FrequencySweep, FindsTheFoldsOfALinearStopInBothDirections) {
  const LinearStop stop;
  const double load = 0.1, damping = 0.05;
  double lower = 1.0, upper = 0.0;
  for (double b = 0.0; b < std::numbers::pi; b += 1e-5) {
    const double f = stop.frequency(b, load, damping);
    if (std::isnan(f)) break;
    upper = std::max(upper, f);
    lower = std::min(lower, f);
  }
  EXPECT_LT(lower, stop.frequency(0.0, load, damping));  // the fold lies beyond grazing
  CondensedProblem problem(testing::fourier_pair(3, 512), oscillator(damping, load), testing::cosine_load());
  for (const bool rising : {true, false}) {
    FrequencySweepOptions options;
    options.from = rising ? 0.1 : 0.3;
    options.to = rising ? 0.3 : 0.1;
    const FrequencySweep sweep = frequency_sweep(problem, stop, options);
    ASSERT_EQ(sweep.status, SweepStatus::reached_end);
    ASSERT_GE(sweep.turning_points.size(), 2u);
    const auto& [first, last] = std::pair{sweep.turning_points.front(), sweep.turning_points.back()};
    EXPECT_NEAR((rising ? first : last).frequency, upper, 1e-5);  // 512 points find b to about (2 pi / 512)^2
    EXPECT_NEAR((rising ? last : first).frequency, lower, 1e-5);
  }
}

// Downwards from the low branch between the folds: round the lower fold and back on the unstable branch.
TEST(FrequencySweep, SaysWhenTheCurveReturnsToWhereItStarted) {
  CondensedProblem problem(testing::fourier_pair(3, 16), oscillator(duffing_damping, duffing_load),
                           testing::cosine_load());
  FrequencySweepOptions options;
  options.from = 0.3;
  options.to = 0.05;
  const FrequencySweep sweep = frequency_sweep(problem, Cubic{}, options);
  ASSERT_LT(sweep.points.front().max_displacement, 0.5) << "the low branch";
  EXPECT_EQ(sweep.status, SweepStatus::returned);
  EXPECT_EQ(sweep.turning_points.size(), 1u);
  EXPECT_NEAR(sweep.points.back().frequency, 0.3, 1e-9);
  EXPECT_GT(sweep.points.back().max_displacement, 2.0 * sweep.points.front().max_displacement);
}

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

// Where the largest sample of the contact-free response reaches the gap, by bisection.
double grazing_frequency(CondensedProblem& problem, double gap, double low, double high) {
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    problem.set_frequency(middle);
    (problem.free_response().maxCoeff() > gap ? low : high) = middle;
  }
  return low;
}

TEST(FrequencySweep, TurnsAtTheGrazingCornerOfTheBar) {
  for (const bool haar : {false, true})
    for (const bool rising : {true, false}) {
      BarSweep sweep(haar ? testing::make_pair(testing::HaarBasis{64}, spectral::FourierBasis(64), 256)
                          : testing::fourier_pair(63, 256));
      if (!rising) std::swap(sweep.options.from, sweep.options.to);
      const FrequencySweep result = sweep.run();
      ASSERT_EQ(result.status, SweepStatus::reached_end);
      ASSERT_GE(result.turning_points.size(), 2u);
      const TurningPoint& corner = rising ? result.turning_points.back() : result.turning_points.front();
      const double grazing = grazing_frequency(sweep.problem, testing::jl14_case_2.law.start, 1300.0, 1400.0);
      EXPECT_TRUE(corner.corner);
      EXPECT_NEAR(corner.frequency, grazing, haar ? 1e-4 : 2e-2);
      EXPECT_NEAR(corner.max_displacement, testing::jl14_case_2.law.start, 2e-5);
      for (const SweepPoint& point : result.points) EXPECT_LE(point.residual, 1e-10);
    }
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

// Else a stiff law with thousands of samples in contact would keep the homotopy for minutes.
TEST_F(BarCurve, EndsWhereItsOperationsAreUsedUp) {
  options_.most_operations = 1e5;  // an LU of the 25 samples in contact takes 1e4
  ArcLength curve(*system_, parameter_, options_);
  ASSERT_EQ(curve.start(first_, 1275.0, 1.0), ArcLength::Status::advanced);
  int points = 0;
  while (curve.advance() == ArcLength::Status::advanced) ++points;
  EXPECT_GT(points, 0);
  EXPECT_LT(points, 30);  // of some hundred
  EXPECT_GT(system_->operations(), 1e5);
  EXPECT_LT(system_->operations(), 2e5);
}

// Points, unit tangents and corners of the curve, each checked with a problem of its own.
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
  sweep.options.observer = [&](const SweepPoint& point) {
    EXPECT_GE(point.frequency, 1100.0);
    return ++seen < 5;
  };
  const FrequencySweep cancelled = sweep.run();
  EXPECT_EQ(cancelled.status, SweepStatus::cancelled);
  EXPECT_EQ(cancelled.points.size(), 5u);
}

TEST(FrequencySweep, ObserverMayStopAtTheFirstPoint) {
  BarSweep sweep(testing::fourier_pair(31, 128));
  sweep.options.observer = [](const SweepPoint&) { return false; };
  const FrequencySweep result = sweep.run();
  EXPECT_EQ(result.status, SweepStatus::cancelled);
  EXPECT_EQ(result.points.size(), 1u);
}

TEST(FrequencySweep, SaysWhenThereIsNoStart) {
  BarSweep sweep(testing::fourier_pair(31, 128));
  sweep.options.from = 1275.0;
  sweep.options.start.newton.max_iterations = 1;
  sweep.options.start.homotopy = false;
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

// Six contacts of a reduced structure: dense matrices of contact coordinates and modes, as a Craig-Bampton
// reduction leaves them. Its first mode moves all contacts, by different amounts.
LinearStructure reduced_structure() {
  constexpr int contacts = 6, modes = 4, size = contacts + modes;
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(size, size), mass = stiffness;
  const auto random = [&](int rows, int columns) {
    return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(generator); }).eval();
  };
  const Eigen::MatrixXd shapes = random(contacts, contacts), coupling = random(contacts, modes);
  stiffness.topLeftCorner(contacts, contacts) =
      40.0 * (shapes * shapes.transpose() + Eigen::MatrixXd::Identity(contacts, contacts));
  mass.topLeftCorner(contacts, contacts) = 2.0 * Eigen::MatrixXd::Identity(contacts, contacts);
  mass.topRightCorner(contacts, modes) = 0.4 * coupling;
  mass.bottomLeftCorner(modes, contacts) = 0.4 * coupling.transpose();
  mass.bottomRightCorner(modes, modes).setIdentity();
  for (int j = 0; j < modes; ++j) stiffness(contacts + j, contacts + j) = (j + 1) * (j + 1);
  LinearStructure structure;
  structure.mass = mass.sparseView();
  structure.stiffness = stiffness.sparseView();
  structure.damping = (0.005 * stiffness).sparseView();
  structure.load = Eigen::VectorXd::Unit(size, contacts);
  structure.contact_dofs = {0, 1, 2, 3, 4, 5};
  return structure;
}

TEST(FrequencySweep, OfAReducedStructureWithManyContactsReachesItsEndWithTheDefaultSteps) {
  CondensedProblem problem(testing::fourier_pair(15, 64), reduced_structure(), testing::cosine_load());
  double free = 0.0;
  for (double frequency = 0.15; frequency < 0.17; frequency += 0.0002) {
    problem.set_frequency(frequency);
    free = std::max(free, problem.free_response().maxCoeff());
  }
  const testing::LinearContact stop{1000.0, free / 3.0};
  std::vector<double> largest;
  for (const bool rising : {true, false}) {
    FrequencySweepOptions options;
    options.from = rising ? 0.12 : 0.25;
    options.to = rising ? 0.25 : 0.12;
    const FrequencySweep sweep = frequency_sweep(problem, stop, options);
    ASSERT_EQ(sweep.status, SweepStatus::reached_end) << to_string(sweep.status);
    largest.push_back(0.0);
    for (std::size_t i = 0; i < sweep.points.size(); ++i) {
      const SweepPoint& point = sweep.points[i];
      EXPECT_LE(point.residual, 1e-10);
      largest.back() = std::max(largest.back(), point.max_displacement);
      if (i % 20 != 0) continue;
      problem.set_frequency(point.frequency);
      const PeriodicResponse single = forced_response(problem, stop, {});
      ASSERT_TRUE(single.converged());
      // 1024 points of the period against its 64 samples
      EXPECT_NEAR(single.displacement.maxCoeff(), point.max_displacement, 0.02 * point.max_displacement);
    }
  }
  EXPECT_GT(largest[0], 1.05 * stop.start) << "hardly a contact";
  EXPECT_NEAR(largest[0], largest[1], 0.01 * largest[0]);
}

// Equal sectors under equal loads: the coupling does not act while all move alike, but curves of unlike
// motions leave the common one at its turns.
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
  LinearStructure ring = oscillator(0.04, 0.1);
  ring.stiffness = stiffness.sparseView();
  ring.mass = Eigen::MatrixXd::Identity(sectors, sectors).sparseView();
  ring.damping = 0.04 * ring.mass;
  ring.load = Eigen::VectorXd::Constant(sectors, 0.1);
  ring.contact_dofs = {0, 1, 2, 3};
  const TimePair pair = testing::fourier_pair(7, 32);
  CondensedProblem problem(pair, ring, testing::cosine_load());
  FrequencySweepOptions options;
  options.from = 0.35;
  options.to = 0.1;
  const FrequencySweep whole = frequency_sweep(problem, testing::LinearContact{10.0, 1.0}, options);
  const FrequencySweep sector = StoppedOscillators{10.0}.sweep(pair, 0.35, 0.1, Corners::every);
  ASSERT_EQ(whole.status, SweepStatus::reached_end) << to_string(whole.status);
  ASSERT_EQ(sector.status, SweepStatus::reached_end) << to_string(sector.status);
  expect_near(turning_frequencies(whole), turning_frequencies(sector), 1e-8);
}

// An even number of functions leaves the Nyquist coefficient of the bar without damping.
TEST(FrequencySweep, SaysWhenTheCurveGrowsPastAllBounds) {
  BarSweep even(testing::fourier_pair(64, 256)), odd(testing::fourier_pair(63, 256));
  even.options.arc_length.corners = odd.options.arc_length.corners = Corners::every;
  EXPECT_EQ(even.run().status, SweepStatus::unbounded);
  EXPECT_EQ(odd.run().status, SweepStatus::reached_end);
}

// Steps grow to more than the frequency itself: a trial point below zero is a step too long, not an error.
TEST(FrequencySweep, GoesDownToAHundredthOfTheFirstFrequency) {
  CondensedProblem problem(testing::fourier_pair(7, 32), testing::jl14_case_1.structure(),
                           testing::cosine_load());
  FrequencySweepOptions options;
  options.from = 100.0;
  options.to = 0.1;
  const FrequencySweep result = frequency_sweep(problem, testing::jl14_case_1.law, options);
  EXPECT_EQ(result.status, SweepStatus::reached_end);
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

TEST(SweepStatus, IsSpelledAsInTheSource) {
  EXPECT_EQ(to_string(SweepStatus::reached_end), "reached_end");
  EXPECT_EQ(to_string(SweepStatus::returned), "returned");
  EXPECT_EQ(to_string(SweepStatus::no_start), "no_start");
  EXPECT_EQ(to_string(SweepStatus::lost), "lost");
  EXPECT_EQ(to_string(SweepStatus::unbounded), "unbounded");
  EXPECT_EQ(to_string(SweepStatus::point_limit), "point_limit");
  EXPECT_EQ(to_string(SweepStatus::cancelled), "cancelled");
}

}  // namespace
}  // namespace wavebalance::solvers

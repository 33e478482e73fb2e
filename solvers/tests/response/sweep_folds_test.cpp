#include <array>

#include "dense_algebra.hpp"
#include "support/duffing_spring.hpp"
#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "support/solved.hpp"
#include "testing.hpp"
#include "wavebalance/contact/cubic_law.hpp"

namespace wavebalance::solvers {
namespace {

// u'' + 2 zeta u' + u + u^3 = cos, time in units of 1/omega_0: with one harmonic and enough points for the
// third, balance is exact and has a closed form.
constexpr double duffing_load = 0.3, duffing_damping = 0.05;

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
  CondensedProblem problem =
      testing::fourier_problem(testing::unit_oscillator(duffing_damping, duffing_load), 3, 16);
  FrequencySweepOptions options = testing::between(from, to);
  return frequency_sweep(problem, testing::DuffingSpring{}, options);
}

void expect_closed_form(const FrequencySweep& sweep, double cubic, double damping, double load) {
  EXPECT_EQ(sweep.turning_points.size(), 2u);
  for (const SweepPoint& point : sweep.points) {
    const double a = std::sqrt(2.0) * point.rms_displacement, w = two_pi * point.frequency;
    const double k = 1.0 + 0.75 * cubic * a * a - w * w;
    EXPECT_NEAR(a * std::hypot(k, damping * w), load, 1e-8) << point.frequency;
    EXPECT_NEAR(point.max_displacement, a, 1e-5 * a);  // 1024 points miss the top by less than (pi/1024)^2/2
    EXPECT_FALSE(point.grazing);
  }
}

TEST(FrequencySweep, PointsLieOnTheClosedFormOfTheDuffingCurve) {
  const FrequencySweep sweep = duffing_sweep(0.05, 0.5);
  ASSERT_EQ(sweep.status, SweepStatus::reached_end) << to_string(sweep.status);
  ASSERT_GT(sweep.points.size(), 30u);
  expect_closed_form(sweep, 1.0, duffing_damping, duffing_load);
  EXPECT_EQ(sweep.points.front().frequency, 0.05);
  EXPECT_NEAR(sweep.points.back().frequency, 0.5, 1e-9);
}

TEST(FrequencySweep, PointsLieOnTheClosedFormOfASofteningDuffingCurve) {
  CondensedProblem problem = testing::fourier_problem(testing::unit_oscillator(0.04, 0.035), 3, 16);
  for (const auto& [from, to] : {std::pair{0.08, 0.22}, std::pair{0.22, 0.08}})
    expect_closed_form(testing::complete_sweep(problem, contact::CubicLaw(-0.2), testing::between(from, to)),
                       -0.2, 0.04, 0.035);
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

// Downwards from the low branch between the folds: round the lower fold and back on the unstable branch.
TEST(FrequencySweep, SaysWhenTheCurveReturnsToWhereItStarted) {
  CondensedProblem problem =
      testing::fourier_problem(testing::unit_oscillator(duffing_damping, duffing_load), 3, 16);
  const FrequencySweep sweep =
      frequency_sweep(problem, testing::DuffingSpring{}, testing::between(0.3, 0.05));
  ASSERT_LT(sweep.points.front().max_displacement, 0.5) << "the low branch";
  EXPECT_EQ(sweep.status, SweepStatus::returned);
  EXPECT_EQ(sweep.turning_points.size(), 1u);
  EXPECT_NEAR(sweep.points.back().frequency, 0.3, 1e-9);
  EXPECT_GT(sweep.points.back().max_displacement, 2.0 * sweep.points.front().max_displacement);
}

// A steel pipe of 6 m in three rows with its weight: in the middle of its length between stops, with its end
// on a rest, driven between them. All modes have the same damping ratio.
LinearStructure pipe_on_supports() {
  constexpr double damping_ratio = 0.02, load = 120.0;
  Eigen::Matrix3d mass, stiffness;
  mass << 32.1597593071, -0.541306082163, -2.2023280058, -0.541306082163, 6.80790218635, 3.49064483296,
      -2.2023280058, 3.49064483296, 23.9028798078;
  stiffness << 1278086.08556603, 389782.986971706, -1246435.6289054, 389782.986971706, 290953.244826094,
      -638380.014551808, -1246435.6289054, -638380.014551808, 1624080.99112254;
  const auto modes = oracle::generalized_eigen(stiffness, mass);
  const Eigen::Matrix3d shapes = mass * modes.vectors;
  const Eigen::Vector3d damping = 2.0 * damping_ratio * modes.values.cwiseSqrt();
  LinearStructure pipe;
  pipe.mass = mass.sparseView();
  pipe.stiffness = stiffness.sparseView();
  pipe.damping = Eigen::MatrixXd(shapes * damping.asDiagonal() * shapes.transpose()).sparseView();
  pipe.load = Eigen::Vector3d(0.0, 0.0, load);
  pipe.forces.push_back(
      {Eigen::Vector3d(-375.7836254295, -102.1279537959, -213.379188262), Eigen::VectorXcd::Ones(1)});
  Eigen::MatrixXd contacts(3, 3);
  contacts << 1.0, 0.0, 0.0, -1.0, 0.0, 0.0, 0.0, -1.0, 0.0;
  pipe.contact_directions = contacts.sparseView();
  return pipe;
}

// Superharmonic resonances of light modes are narrower than an 80th of a wide interval.
TEST(FrequencySweep, OfAPipeOnSupportsDoesNotPassOverALoopThatIsNarrowBesideTheInterval) {
  CondensedProblem problem = testing::fourier_problem(pipe_on_supports(), 63, 252);
  const ContactLaws stops(std::vector<AnyContactLaw>{testing::LinearContact{1e6, 3e-3},
                                                     testing::LinearContact{1e6, 3e-3},
                                                     testing::LinearContact{1e6, 5e-3}});
  FrequencySweepOptions options = testing::between(2.0, 25.0);
  options.output_points = 64;
  options.smallest_return = 0.04;
  const FrequencySweep usual = frequency_sweep(problem, stops, options);
  options.arc_length.max_step = options.arc_length.max_step / 4.0;
  const FrequencySweep fine = frequency_sweep(problem, stops, options);
  EXPECT_EQ(usual.status, SweepStatus::reached_end);
  ASSERT_EQ(usual.turning_points.size(), fine.turning_points.size());
  for (std::size_t i = 0; i < fine.turning_points.size(); ++i)
    EXPECT_NEAR(usual.turning_points[i].frequency, fine.turning_points[i].frequency, 0.03) << i;
  EXPECT_LT(1.5 * double(usual.points.size()), double(fine.points.size()));
}

}  // namespace
}  // namespace wavebalance::solvers

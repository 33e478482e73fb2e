#include <gtest/gtest.h>
#include <ostream>

#include "period_oracle/shooting.hpp"
#include "support/jl14_bar.hpp"
#include "support/solved.hpp"

namespace wavebalance::solvers {
namespace testing {

void PrintTo(const Jl14Case& scene, std::ostream* out) { *out << scene.frequency_hz << " Hz"; }

}  // namespace testing

namespace {

using testing::Jl14Case;

double rms(const Eigen::MatrixXd& values) { return values.norm() / std::sqrt(values.size()); }

/// The published figures have seven digits; the force ratio and the contact fraction four, and the latter was
/// counted on a grid of its own.
void expect_reference(const Motion& motion, const Jl14Case& scene, double tolerance) {
  const Eigen::MatrixXd& u = motion.displacement;
  EXPECT_NEAR(u.maxCoeff(), scene.max_displacement, tolerance * scene.max_displacement);
  EXPECT_NEAR(u.cwiseAbs().maxCoeff(), scene.max_abs_displacement, tolerance * scene.max_abs_displacement);
  EXPECT_NEAR(rms(u), scene.rms_displacement, tolerance * scene.rms_displacement);
  EXPECT_NEAR(motion.force.maxCoeff() / 250e3, scene.max_force_ratio, 1e-4 * scene.max_force_ratio);
  const double fraction = static_cast<double>((motion.force.array() > 0.0).count()) / u.size();
  EXPECT_NEAR(fraction, scene.contact_fraction, 2e-4);
}

oracle::ShootingResult shoot_case(const Jl14Case& scene, int points, double step_tolerance) {
  oracle::ShootingOptions options{.output_points = points, .step_tolerance = step_tolerance};
  return oracle::shoot(scene.structure(), scene.law, scene.frequency_hz, options);
}

class BarInContact : public ::testing::TestWithParam<Jl14Case> {};

TEST_P(BarInContact, ShootingGivesTheReferenceFigures) {
  // 16384 points, so that the largest sample is the maximum to 1e-7.
  const oracle::ShootingResult result = shoot_case(GetParam(), 16384, 1e-12);
  ASSERT_EQ(result.status, oracle::ShootingStatus::converged);
  expect_reference(result.contacts, GetParam(), 1e-6);
}

TEST_P(BarInContact, ShootingErrsByLessThan1e9) {
  const Motion motion = shoot_case(GetParam(), 1024, 1e-12).contacts;
  const Motion finer = shoot_case(GetParam(), 1024, 1e-14).contacts;
  EXPECT_LT(rms(motion.displacement - finer.displacement), 1e-10 * rms(finer.displacement));
  EXPECT_LT(rms(motion.velocity - finer.velocity), 1e-9 * rms(finer.velocity));
}

TEST_P(BarInContact, TimeSteppingGivesTheReferenceFigures) {
  const Jl14Case& scene = GetParam();
  const TimeSteppingResult result =
      testing::stepped_motion(scene.structure(), scene.law, scene.frequency_hz, 16384);
  EXPECT_LT(result.period_error.back(), 1e-7);
  expect_reference(result.contacts, scene, 1e-6);
}

INSTANTIATE_TEST_SUITE_P(JonesLegrand2014, BarInContact,
                         ::testing::Values(testing::jl14_case_1, testing::jl14_case_2),
                         [](const auto& scene) { return "Case" + std::to_string(scene.index + 1); });

}  // namespace
}  // namespace wavebalance::solvers

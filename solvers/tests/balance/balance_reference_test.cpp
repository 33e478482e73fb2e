#include "support/solved.hpp"
#include "testing.hpp"

// The bar of [JL14, section 4] in time and by harmonic balance, against figures computed by others.
namespace wavebalance::solvers {
namespace {

using testing::Jl14Case, testing::jl14_case_1, testing::jl14_case_2;

constexpr int output_points = 8192;  // so that the largest sample is the maximum to 4e-7

const Motion& stepped(const Jl14Case& one) {
  static const auto run = [](const Jl14Case& scene) {
    return testing::stepped_motion(scene.structure(), scene.law, scene.frequency_hz, output_points).contacts;
  };
  static const Motion first = run(jl14_case_1), second = run(jl14_case_2);
  return one.frequency_hz == jl14_case_1.frequency_hz ? first : second;
}

// The published figures have seven digits; the force ratio and the contact fraction four, and the latter
// was counted on a separate grid.
TEST(BarInContact, TimeSteppingGivesTheReferenceFigures) {
  for (const Jl14Case& scene : {jl14_case_1, jl14_case_2}) {
    const Eigen::MatrixXd &u = stepped(scene).displacement, &force = stepped(scene).force;
    EXPECT_NEAR(u.maxCoeff(), scene.max_displacement, 1e-6 * scene.max_displacement);
    EXPECT_NEAR(u.cwiseAbs().maxCoeff(), scene.max_abs_displacement, 1e-6 * scene.max_abs_displacement);
    EXPECT_NEAR(u.norm() / std::sqrt(u.size()), scene.rms_displacement, 1e-6 * scene.rms_displacement);
    EXPECT_NEAR(force.maxCoeff() / 250e3, scene.max_force_ratio, 1e-4 * scene.max_force_ratio);
    EXPECT_NEAR((force.array() > 0.0).cast<double>().mean(), scene.contact_fraction, 2e-4);
  }
}

// Two per cent of the relative rms of the displacement, and the rounding of its printed digits.
TEST(HarmonicBalanceError, IsThatOfAnIndependentComputation) {
  struct ErrorCase {
    const Jl14Case& scene;
    int harmonics, points;
    double error;
  };
  for (const auto& [scene, harmonics, points, error] : {ErrorCase{jl14_case_1, 31, 256, 1.675e-3},
                                                        {jl14_case_1, 31, 1024, 1.651e-3},
                                                        {jl14_case_1, 63, 1024, 2.930e-4},
                                                        {jl14_case_1, 127, 1024, 3.024e-5},
                                                        {jl14_case_2, 31, 256, 9.917e-5},
                                                        {jl14_case_2, 63, 1024, 1.842e-5},
                                                        {jl14_case_2, 127, 1024, 9.33e-6},
                                                        {jl14_case_2, 127, 4096, 1.06e-6}}) {
    SCOPED_TRACE(::testing::Message() << harmonics << " harmonics, " << points << " points");
    CondensedProblem problem =
        testing::fourier_problem(scene.structure(), 2 * harmonics + 1, points, scene.frequency_hz);
    const PeriodicResponse response = testing::solved_response(problem, scene.law);
    EXPECT_EQ(response.strategy, Strategy::newton);
    TrialEvaluator evaluate(problem.pair().trial(), output_points, 0);
    const Eigen::VectorXd exact = stepped(scene).displacement.row(0);
    EXPECT_NEAR((evaluate(response.coefficients) - exact).norm() / exact.norm(), error, 0.02 * error);
  }
}

}  // namespace
}  // namespace wavebalance::solvers

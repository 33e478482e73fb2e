#include "wavebalance/solvers/collocation/exact_structure_motion.hpp"
#include "support/collocation_cases.hpp"
#include "support/rigid_law.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"

namespace wavebalance::solvers {
namespace {

using testing::Jl14Case;

double relative(const Eigen::MatrixXd& values, const Eigen::MatrixXd& exact) {
  return (values - exact).norm() / exact.norm();
}

/// A structure with its laws, a balance of it and the intervals near that.
struct Solved {
  Solved(const LinearStructure& structure, const ContactLaws& laws, double frequency, int functions)
      : problem(testing::fourier_pair(functions, 4 * (functions + 1)), structure, testing::cosine_load()) {
    problem.set_frequency(frequency);
    response = forced_response(problem, laws, {});
    EXPECT_TRUE(response.converged());
    motion =
        exact_near_response(problem, laws, response, ContactDynamics(structure), {.tolerance = 1e-11}).motion;
    EXPECT_TRUE(motion.converged()) << to_string(motion.status);
  }

  CondensedProblem problem;
  PeriodicResponse response;
  ExactSolution motion;
};

Solved solved(const Jl14Case& jl14, int functions = 63) {
  return {jl14.structure(), ContactLaws(jl14.law), jl14.frequency_hz, functions};
}

/// Simpson's rule on the intervals of one contact.
std::complex<double> integrated_harmonic(const ExactSolution& motion, int n) {
  constexpr int intervals = 20000;
  std::complex<double> sum = 0.0;
  for (const ForceInterval& interval : motion.intervals) {
    const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(intervals + 1, interval.begin, interval.end);
    const Eigen::RowVectorXd force = motion.force(times).row(0);
    for (int k = 0; k <= intervals; ++k) {
      const double weight = k == 0 || k == intervals ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
      sum +=
          weight * interval.length() / (3.0 * intervals) * force[k] * std::polar(1.0, -two_pi * n * times[k]);
    }
  }
  return n == 0 ? sum : 2.0 * sum;
}

TEST(ExactStructureMotion, HaveTheFourierCoefficientsOfTheirForces) {
  for (const Jl14Case& jl14 : {testing::jl14_case_1, testing::jl14_case_2}) {
    const ExactSolution motion = solved(jl14).motion;
    const Eigen::MatrixXcd harmonics = motion.force_harmonics(1001);
    ASSERT_EQ(harmonics.cols(), 1001);
    const double size = std::abs(harmonics(0, 0));
    for (const int n : {0, 1, 2, 7, 40, 300, 1000})
      EXPECT_LT(std::abs(harmonics(0, n) - integrated_harmonic(motion, n)), 1e-8 * size) << n;
    // The force has kinks and no jumps, so that its coefficients fall like 1 / n^2.
    const auto largest = [&](int from) { return harmonics.middleCols(from, 100).cwiseAbs().maxCoeff(); };
    EXPECT_NEAR(largest(400) / largest(800), 4.0, 1.0);
  }
}

TEST(ExactStructureMotion, AgreeWithTheForcesAtTheContacts) {
  for (const Jl14Case& jl14 : {testing::jl14_case_1, testing::jl14_case_2}) {
    const Solved bar = solved(jl14);
    constexpr int points = 300;
    const ExactStructureMotion whole =
        exact_structure_motion(bar.problem, bar.motion, points, {.tolerance = 1e-9});
    EXPECT_LE(whole.left_out, 1e-9);
    EXPECT_EQ(whole.motion.points(), points);
    EXPECT_EQ(whole.motion.rows(), 25);
    const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(points, 0.0, 1.0 - 1.0 / points);
    EXPECT_LT(relative(whole.motion.displacement.row(24), bar.motion.displacement(times)), 2e-9);
    EXPECT_LT(relative(whole.motion.velocity.row(24), bar.motion.velocity(times)), 1e-5);
  }
}

TEST(ExactStructureMotion, LeaveOutErrorsThatFallLikeThePower3Point5OfTheHarmonics) {
  const Solved bar = solved(testing::jl14_case_2);
  const auto left_out = [&](int harmonics) {
    return exact_structure_motion(
               bar.problem, bar.motion, 64,
               {.tolerance = 1e-16, .first_harmonics = harmonics, .max_harmonics = harmonics})
        .left_out;
  };
  const double order = std::log2(left_out(256) / left_out(512));
  EXPECT_GT(order, 3.0);
  EXPECT_LT(order, 4.5);
}

TEST(ExactStructureMotion, AreNearTheStructureOfAFineBalanceEverywhere) {
  Solved bar = solved(testing::jl14_case_2, 1023);
  const ExactStructureMotion whole = exact_structure_motion(bar.problem, bar.motion, 256);
  const Motion balance = structure_motion(bar.problem, bar.response, 256);
  EXPECT_LT(relative(whole.motion.displacement, balance.displacement), 1e-5);
  EXPECT_LT(relative(whole.motion.velocity, balance.velocity), 1e-3);
}

TEST(ExactStructureMotion, AgreeAtContactsWithoutMassMoreSlowly) {
  const LinearStructure bar = testing::massless_tip(testing::jl14_case_2.structure());
  const Solved rigid(bar, ContactLaws(testing::Rigid{testing::jl14_case_2.law.start}), 1275.0, 255);
  const ExactStructureMotion whole =
      exact_structure_motion(rigid.problem, rigid.motion, 128, {.tolerance = 1e-6});
  EXPECT_LE(whole.left_out, 1e-6);
  EXPECT_GT(whole.harmonics, 256);
}

TEST(ExactStructureMotion, HoldAStructureThatIsFreeToMove) {
  const LinearStructure structure = testing::free_pair();
  const Solved pair(structure, ContactLaws(AnyContactLaw(testing::LinearContact{60.0, 0.01})), 1.1, 255);
  const ExactStructureMotion whole = exact_structure_motion(pair.problem, pair.motion, 200);
  EXPECT_LE(whole.left_out, 1e-9);
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(200, 0.0, 1.0 - 1.0 / 200);
  EXPECT_LT(
      relative(structure.contact_directions * whole.motion.displacement, pair.motion.displacement(times)),
      2e-9);
}

TEST(ExactStructureMotion, RefuseBadInput) {
  const Solved bar = solved(testing::jl14_case_1);
  EXPECT_THROW(exact_structure_motion(bar.problem, ExactSolution{}, 64), std::invalid_argument);
  EXPECT_THROW(exact_structure_motion(bar.problem, bar.motion, 0), std::invalid_argument);
  EXPECT_THROW(exact_structure_motion(bar.problem, bar.motion, 64, {.tolerance = 0.0}),
               std::invalid_argument);
  EXPECT_THROW(bar.motion.force_harmonics(0), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers

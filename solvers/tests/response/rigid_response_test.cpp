#include "wavebalance/solvers/response/rigid_response.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "support/jl14_bar.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"
#include "wavebalance/spectral/fourier_basis.hpp"

namespace wavebalance::solvers {
namespace {

CondensedProblem fourier_problem(const LinearStructure& structure, int functions, int points,
                                 double frequency) {
  const spectral::FourierBasis basis(functions);
  Eigen::VectorXcd load(2);
  load << 0.0, 1.0;
  CondensedProblem problem(TimePair(basis, basis, {.quadrature_points = points}), structure, load);
  problem.set_frequency(frequency);
  return problem;
}

struct RigidCase {
  double frequency, beta, gap;
  int functions, points;
  double mean_force, tolerance;  // over the load amplitude, independent figures

  friend void PrintTo(const RigidCase& scene, std::ostream* out) {
    *out << scene.frequency << " Hz, " << scene.functions << " functions, " << scene.points << " points";
  }
};

class RigidJl14 : public ::testing::TestWithParam<RigidCase> {};

TEST_P(RigidJl14, HoldsComplementarityAndTheMeanForceOfOtherComputations) {
  const RigidCase& scene = GetParam();
  auto problem =
      fourier_problem(testing::jl14_bar(25, scene.beta), scene.functions, scene.points, scene.frequency);
  const RigidResponse rigid = rigid_response(problem, scene.gap, {});
  ASSERT_TRUE(rigid.response.converged());
  EXPECT_LE(rigid.complementarity.max_penetration,
            1e-6 * problem.contact_free_response().cwiseAbs().maxCoeff());
  EXPECT_GE(rigid.complementarity.min_force, 0.0);
  EXPECT_LE(rigid.complementarity.product, 1e-6);
  EXPECT_NEAR(rigid.response.contact_force.mean() / 250e3, scene.mean_force, scene.tolerance);
  // The balance itself, independently of the path: u = u0 - K f.
  Eigen::VectorXd product(scene.points);
  problem.apply(rigid.response.contact_force, product);
  const Eigen::VectorXd residual = rigid.response.displacement - problem.contact_free_response() + product;
  EXPECT_LE(residual.cwiseAbs().maxCoeff(), 1e-9 * problem.contact_free_response().cwiseAbs().maxCoeff());
}

INSTANTIATE_TEST_SUITE_P(Cases, RigidJl14,
                         ::testing::Values(RigidCase{150.0, 1e-4, 1e-3, 63, 128, 0.0510, 0.0010},
                                           RigidCase{150.0, 1e-4, 1e-3, 63, 256, 0.0510, 0.0010},
                                           RigidCase{1275.0, 5e-6, 14.5e-3, 63, 128, 0.355, 0.004},
                                           RigidCase{1275.0, 5e-6, 14.5e-3, 63, 256, 0.355, 0.004}));

TEST(RigidResponse, WithoutContactItIsTheFreeResponse) {
  auto problem = fourier_problem(testing::jl14_bar(25, 1e-4), 15, 64, 150.0);
  const RigidResponse rigid = rigid_response(problem, 1.0, {});
  ASSERT_TRUE(rigid.response.converged());
  EXPECT_TRUE(rigid.response.displacement.isApprox(problem.contact_free_response(), 0.0));
  EXPECT_TRUE(rigid.response.contact_force.isZero(0.0));
}

// No law gives it: between the quadrature points the motion has the force of the nearest one.
TEST(RigidResponse, ItsMotionHasTheForceOfTheBalance) {
  auto problem = fourier_problem(testing::jl14_bar(25, 1e-4), 63, 128, 150.0);
  const RigidResponse rigid = rigid_response(problem, 1e-3, {});
  ASSERT_TRUE(rigid.response.converged());
  EXPECT_TRUE(rigid.response.force_by_balance);
  const Motion motion = contact_motion(problem, rigid.response, {}, 256);
  EXPECT_GT(motion.force.maxCoeff(), 0.0);
  for (int l = 0; l < 128; ++l) {
    EXPECT_EQ(motion.force(0, 2 * l), rigid.response.contact_force[l]);
    EXPECT_NEAR(motion.displacement(0, 2 * l), rigid.response.displacement[l], 1e-12);
  }
}

TEST(RigidResponse, StaticPushAgainstTheObstacleIsHeldAtTheGap) {
  // One degree of freedom, k = 1, quasi-static load 3 + cos: always pressed against the gap 1 with force load
  // - 1.
  LinearStructure structure;
  for (auto* matrix : {&structure.mass, &structure.damping, &structure.stiffness}) {
    matrix->resize(1, 1);
    matrix->insert(0, 0) = 0.0;
  }
  structure.mass.coeffRef(0, 0) = structure.damping.coeffRef(0, 0) = 1e-9;
  structure.stiffness.coeffRef(0, 0) = 1.0;
  structure.load = Eigen::VectorXd::Ones(1);
  const spectral::FourierBasis basis(7);
  Eigen::VectorXcd load(2);
  load << 3.0, 1.0;
  CondensedProblem problem(TimePair(basis, basis, {.quadrature_points = 7}), structure, load);
  problem.set_frequency(1.0);
  const RigidResponse rigid = rigid_response(problem, 1.0, {});
  ASSERT_TRUE(rigid.response.converged());
  EXPECT_EQ(rigid.active_samples, 7);
  EXPECT_NEAR(rigid.response.contact_force.mean(), 2.0, 1e-6);
  EXPECT_NEAR(rigid.response.contact_force[0], 3.0, 1e-6);
}

// Without a load nothing moves on its own, free of an open gap and of one that it just fills. An obstacle
// that stands in the way pushes it back for good, against the static stiffness 70e9 * 25e-4 / 1 m.
TEST(RigidResponse, WithoutLoadItRestsWhereTheObstacleAllows) {
  LinearStructure bar = testing::jl14_bar(5, 1e-4);
  bar.load.setZero();
  auto problem = fourier_problem(bar, 7, 32, 150.0);
  for (const double gap : {1e-3, 0.0, -1e-3, -1e200}) {
    const RigidResponse rigid = rigid_response(problem, gap, {});
    ASSERT_TRUE(rigid.response.converged()) << gap << " " << to_string(rigid.response.status);
    const double held = std::min(gap, 0.0);
    EXPECT_NEAR(rigid.response.displacement.maxCoeff(), held, 1e-9 * std::abs(held)) << gap;
    EXPECT_NEAR(rigid.response.contact_force.mean(), -held * 70e9 * 25e-4,
                1e-6 * std::abs(held) * 70e9 * 25e-4)
        << gap;
    EXPECT_LE(rigid.complementarity.product, 1e-9) << gap;
  }
}

// With four points per function there are more samples in contact than functions. With one point per function
// the path of an evenly lowered obstacle may not end. Each of these cases stalled once.
TEST(RigidResponse, HoldsComplementarityWithOneToFourPointsAFunction) {
  struct Size {
    int functions, points;
  };
  for (const Size size : {Size{63, 63}, {127, 127}, {127, 255}, {63, 256}, {255, 1024}}) {
    auto problem = fourier_problem(testing::jl14_bar(25, 1e-4), size.functions, size.points, 150.0);
    const RigidResponse rigid = rigid_response(problem, 1e-3, {});
    ASSERT_TRUE(rigid.response.converged()) << size.functions << "/" << size.points;
    const double largest = problem.contact_free_response().cwiseAbs().maxCoeff();
    EXPECT_LE(rigid.complementarity.max_penetration, 1e-9 * largest) << size.functions << "/" << size.points;
    EXPECT_GE(rigid.complementarity.min_force, 0.0);
    EXPECT_LE(rigid.complementarity.product, 1e-9);
    EXPECT_NEAR(rigid.response.contact_force.mean() / 250e3, 0.0510, 0.0030);
  }
}

// Force and motion against obstacles scale with load and gap together; a power of two changes no digit.
TEST(RigidResponse, ScalesWithLoadAndGapUpToTheLargestNumbers) {
  const auto solve = [](double scale) {
    LinearStructure bar = testing::jl14_bar(25, 1e-4);
    bar.load *= scale;
    auto problem = fourier_problem(bar, 63, 128, 150.0);
    return rigid_response(problem, 1e-3 * scale, {});
  };
  const RigidResponse plain = solve(1.0);
  ASSERT_TRUE(plain.response.converged());
  for (const int power : {-900, 900}) {
    const double scale = std::ldexp(1.0, power);
    const RigidResponse scaled = solve(scale);
    ASSERT_TRUE(scaled.response.converged()) << power;
    EXPECT_TRUE((scaled.response.contact_force / scale).isApprox(plain.response.contact_force, 1e-9))
        << power;
    EXPECT_TRUE((scaled.response.displacement / scale).isApprox(plain.response.displacement, 1e-12)) << power;
  }
}

TEST(RigidResponse, AnInfiniteGapIsAnError) {
  auto problem = fourier_problem(testing::jl14_bar(5, 1e-4), 5, 16, 150.0);
  EXPECT_THROW(rigid_response(problem, INFINITY, {}), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::solvers

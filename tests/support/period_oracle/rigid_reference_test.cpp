#include "period_oracle/rigid_reference.hpp"

#include <gtest/gtest.h>

#include <complex>

#include "constants.hpp"
#include "dense_algebra.hpp"
#include "support/rigid_law.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/phases/response_phases.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"

namespace wavebalance::oracle {
namespace {

using namespace solvers;
namespace testing = solvers::testing;

// Two masses of 1 kg, and a tip without mass behind a damped spring.
LinearStructure chain_with_massless_tip() {
  LinearStructure chain;
  chain.mass = Eigen::MatrixXd(Eigen::Vector3d(1.0, 1.0, 0.0).asDiagonal()).sparseView();
  chain.stiffness = Eigen::MatrixXd(Eigen::Matrix3d{{2, -1, 0}, {-1, 2, -1}, {0, -1, 1}}).sparseView();
  chain.damping = 0.2 * chain.stiffness;
  chain.load = Eigen::Vector3d(0.3, 0.0, 0.5);
  chain.contact_directions = contact_rows({2}, 3);
  return chain;
}

constexpr double driven = 0.11;  // Hz

// The contact-free motion of the tip at uniform times.
Eigen::VectorXd free_motion(const LinearStructure& chain, int points) {
  const std::complex<double> rate(0.0, two_pi * driven);
  const Eigen::MatrixXcd impedance = Eigen::MatrixXcd(chain.stiffness.cast<std::complex<double>>()) +
                                     rate * Eigen::MatrixXcd(chain.damping.cast<std::complex<double>>()) +
                                     rate * rate * Eigen::MatrixXcd(chain.mass.cast<std::complex<double>>());
  const Eigen::VectorXcd amplitudes =
      oracle::solve(impedance, Eigen::VectorXcd(chain.load.cast<std::complex<double>>()));
  return Eigen::VectorXd::NullaryExpr(points, [&](Eigen::Index l) {
    return std::real(amplitudes[2] * std::polar(1.0, two_pi * double(l) / points));
  });
}

TEST(RigidReference, OfAnObstacleThatIsNotReachedIsTheLinearResponse) {
  const LinearStructure chain = chain_with_massless_tip();
  const Eigen::VectorXd expected = free_motion(chain, 64);
  const RigidReference found = rigid_reference(chain, 2.0 * expected.maxCoeff(), driven, 64);
  ASSERT_TRUE(found.converged);
  EXPECT_TRUE(found.instants.empty());
  EXPECT_TRUE(found.contact_force.isZero(0.0));
  EXPECT_LE((found.displacement - expected).norm(), 1e-9 * expected.norm());
}

TEST(RigidReference, IsTheMotionThatTheContactPhasesFind) {
  const LinearStructure chain = chain_with_massless_tip();
  const double gap = 0.4 * free_motion(chain, 512).maxCoeff();
  const RigidReference joined = rigid_reference(chain, gap, driven, 256);
  CondensedProblem problem(testing::fourier_pair(63, 256), chain, testing::cosine_load());
  problem.set_frequency(driven);
  const testing::Rigid law{gap};
  const PeriodicResponse response = forced_response(problem, law, {});
  ASSERT_TRUE(response.converged());
  const PhaseMotion phases = response_phases(problem, law, response, ContactDynamics(chain), {}).motion;
  ASSERT_TRUE(phases.converged());
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(256, 0.0, 1.0 - 1.0 / 256);
  EXPECT_LE((phases.displacement(times).transpose() - joined.displacement).norm(),
            1e-8 * joined.displacement.norm());
}

// A balance of 511 functions errs by its truncation, like 1 / 511^2 at the jumps of the velocity.
TEST(RigidReference, IsTheLimitOfTheBalance) {
  const LinearStructure chain = chain_with_massless_tip();
  constexpr int points = 2048;
  const double gap = 0.4 * free_motion(chain, points).maxCoeff();
  const RigidReference exact = rigid_reference(chain, gap, driven, points);
  ASSERT_TRUE(exact.converged);
  EXPECT_EQ(exact.instants.size(), 2u);
  EXPECT_LE(exact.displacement.maxCoeff(), gap * (1.0 + 1e-9));
  CondensedProblem problem(testing::fourier_pair(511, points), chain, testing::cosine_load());
  problem.set_frequency(driven);
  const PeriodicResponse response = forced_response(problem, testing::Rigid{gap}, {});
  ASSERT_TRUE(response.converged());
  EXPECT_LE((response.displacement - exact.displacement).norm(), 1e-4 * exact.displacement.norm());
  EXPECT_NEAR(response.contact_force.mean(), exact.contact_force.mean(), 1e-3 * exact.contact_force.mean());
}

}  // namespace
}  // namespace wavebalance::oracle

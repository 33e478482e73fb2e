#include "wavebalance/contact/signorini.hpp"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace wavebalance::contact {
namespace {

using Array = std::vector<double>;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(GapFunction, IsNegativeWhereContactIsOpen) {
  Array g(3);
  gap_function(Array{0.5, 1.0, 1.25}, Array{1.0}, g);
  EXPECT_EQ(g, (Array{-0.5, 0.0, 0.25}));
  gap_function(Array{0.5, 1.0, 1.25}, Array{1.0, 0.5, 2.0}, g);
  EXPECT_EQ(g, (Array{-0.5, 0.5, -0.75}));
}

TEST(SignoriniMeasures, VanishForRigidContactOnly) {
  const SignoriniMeasures exact = signorini_measures(Array{-1.0, 0.0, 0.0, -2.0}, Array{0.0, 3.0, 0.0, 0.0});
  EXPECT_EQ(exact.max_penetration, 0.0);
  EXPECT_EQ(exact.max_adhesion, 0.0);
  EXPECT_EQ(exact.complementarity, 0.0);
  const SignoriniMeasures off =
      signorini_measures(Array{-1.0, 0.25, 0.125, -2.0}, Array{0.5, 3.0, -0.75, 0.0});
  EXPECT_EQ(off.max_penetration, 0.25);
  EXPECT_EQ(off.max_adhesion, 0.75);
  EXPECT_EQ(off.complementarity, 3.0 * 0.25 / (3.0 * 2.0));
}

TEST(SignoriniMeasures, HaveTheirValuesWithoutContactAndWithoutEntries) {
  EXPECT_EQ(max_penetration(Array{-1.0, -2.0}), 0.0);
  EXPECT_EQ(complementarity(Array{-1.0, -2.0}, Array{0.0, 0.0}), 0.0);
  EXPECT_EQ(min_force(Array{3.0, 2.0}), 2.0);
  EXPECT_EQ(min_force(Array{3.0, -2.0}), -2.0);
  EXPECT_EQ(max_penetration({}), 0.0);
  EXPECT_EQ(min_force({}), infinity);
  EXPECT_EQ(signorini_measures({}, {}).max_adhesion, 0.0);
}

TEST(SignoriniMeasures, DoNotDependOnTheUnitsAndDoNotOverflow) {
  const Array g{-1.0, 0.25}, force{0.5, 3.0};
  for (double metre : {1e-200, 1e-3, 1e200})
    for (double newton : {1e-200, 1e9, 1e200}) {
      const Array scaled_g{g[0] * metre, g[1] * metre}, scaled_force{force[0] * newton, force[1] * newton};
      EXPECT_NEAR(complementarity(scaled_g, scaled_force), 0.25, 1e-15);
    }
}

TEST(SignoriniMeasures, PassOnWhatIsNotANumber) {
  for (const Array& bad : {Array{nan, 1.0}, Array{1.0, nan}}) {
    EXPECT_TRUE(std::isnan(max_penetration(bad)));
    EXPECT_TRUE(std::isnan(min_force(bad)));
    EXPECT_TRUE(std::isnan(complementarity(bad, Array{1.0, 1.0})));
    EXPECT_TRUE(std::isnan(complementarity(Array{1.0, 1.0}, bad)));
    EXPECT_TRUE(std::isnan(signorini_measures(Array{1.0, 1.0}, bad).max_adhesion));
  }
  EXPECT_TRUE(std::isnan(signorini_residual(nan, 1.0, 1.0).value));
  EXPECT_TRUE(std::isnan(signorini_residual(1.0, nan, 1.0).by_force));
}

TEST(SignoriniResidual, IsTheMaxForm) {
  for (double g : {-2.0, -0.25, 0.0, 0.25, 2.0})
    for (double force : {-2.0, -0.5, 0.0, 0.5, 2.0})
      for (double c : {0.25, 1.0, 16.0})
        EXPECT_EQ(signorini_residual(g, force, c).value, force - std::fmax(0.0, force + c * g));
}

TEST(SignoriniResidual, DerivativeAtTheKinkIsThatInContact) {
  const SignoriniResidual kink = signorini_residual(0.0, 0.0, 5.0);
  EXPECT_EQ(kink.by_gap, -5.0);
  EXPECT_EQ(kink.by_force, 0.0);
}

TEST(SignoriniResidual, OfArraysIsThatOfThePairs) {
  const Array g{-2.0, 0.0, 0.5, -0.1}, force{1.0, 0.0, 2.0, 3.0};
  Array value(4), by_gap(4), by_force(4), projected(4);
  signorini_residual(g, force, 10.0, value, by_gap, by_force);
  signorini_projection(g, force, 10.0, projected);
  for (int i = 0; i < 4; ++i) {
    const SignoriniResidual one = signorini_residual(g[i], force[i], 10.0);
    EXPECT_EQ(value[i], one.value);
    EXPECT_EQ(by_gap[i], one.by_gap);
    EXPECT_EQ(by_force[i], one.by_force);
    EXPECT_NEAR(force[i] - projected[i], one.value, 1e-15);
  }
}

// A chain of five unit springs and masses pressed by loads against obstacles at every node: Newton's method
// on (equilibrium, phi) ends at rigid contact in a few steps, whatever c is.
TEST(SignoriniResidual, LeadsNewtonsMethodToRigidContact) {
  const int n = 5;
  Eigen::MatrixXd stiffness = 2.0 * Eigen::MatrixXd::Identity(n, n);
  stiffness.diagonal(1).setConstant(-1.0);
  stiffness.diagonal(-1).setConstant(-1.0);
  const Eigen::VectorXd load = (Eigen::VectorXd(n) << 1.0, 0.1, -0.6, 0.9, 0.8).finished();
  const Array gap{0.4, 0.6, 0.5, 0.7, 0.3};
  for (double c : {0.1, 1.0, 1e4}) {
    Array u(n, 0.0), force(n, 0.0), g(n), phi(n), by_gap(n), by_force(n);
    int iteration = 0;
    for (; iteration < 30; ++iteration) {
      gap_function(u, gap, g);
      signorini_residual(g, force, c, phi, by_gap, by_force);
      Eigen::VectorXd r(2 * n);
      Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(2 * n, 2 * n);
      const Eigen::Map<Eigen::VectorXd> us(u.data(), n), forces(force.data(), n);
      r << stiffness * us + forces - load, Eigen::Map<Eigen::VectorXd>(phi.data(), n);
      if (r.norm() < 1e-13) break;
      jacobian.topLeftCorner(n, n) = stiffness;
      jacobian.topRightCorner(n, n).setIdentity();
      jacobian.bottomLeftCorner(n, n).diagonal() = Eigen::Map<Eigen::VectorXd>(by_gap.data(), n);
      jacobian.bottomRightCorner(n, n).diagonal() = Eigen::Map<Eigen::VectorXd>(by_force.data(), n);
      const Eigen::VectorXd step = jacobian.partialPivLu().solve(-r);
      for (int i = 0; i < n; ++i) {
        u[i] += step[i];
        force[i] += step[n + i];
      }
    }
    EXPECT_LT(iteration, 12) << c;
    const SignoriniMeasures measures = signorini_measures(g, force);
    EXPECT_LT(measures.max_penetration, 1e-13);
    EXPECT_LT(measures.max_adhesion, 1e-13);
    EXPECT_LT(measures.complementarity, 1e-13);
    EXPECT_GT(force[0], 0.1);  // some in contact,
    EXPECT_LT(g[2], -0.1);     // some open
  }
}

TEST(Signorini, RejectsArraysOfUnequalLengthsAndAScaleThatIsNone) {
  Array three(3), two(2);
  const Array g(3), gaps(2);
  EXPECT_THROW(gap_function(g, gaps, three), std::invalid_argument);
  EXPECT_THROW(gap_function(g, Array{1.0}, two), std::invalid_argument);
  EXPECT_THROW(gap_function(g, {}, three), std::invalid_argument);
  EXPECT_THROW(complementarity(g, gaps), std::invalid_argument);
  EXPECT_THROW(signorini_measures(g, gaps), std::invalid_argument);
  Array a(3), b(3);
  EXPECT_THROW(signorini_residual(g, gaps, 1.0, three, a, b), std::invalid_argument);
  EXPECT_THROW(signorini_residual(g, g, 1.0, two, a, b), std::invalid_argument);
  EXPECT_THROW(signorini_residual(g, g, 1.0, a, two, b), std::invalid_argument);
  EXPECT_THROW(signorini_residual(g, g, 1.0, a, b, two), std::invalid_argument);
  EXPECT_THROW(signorini_projection(g, g, 1.0, two), std::invalid_argument);
  for (double c : {0.0, -1.0, nan, infinity}) {
    EXPECT_THROW(signorini_residual(0.0, 0.0, c), std::invalid_argument);
    EXPECT_THROW(signorini_residual(g, g, c, three, a, b), std::invalid_argument);
    EXPECT_THROW(signorini_projection(g, g, c, three), std::invalid_argument);
  }
  try {
    signorini_projection(g, g, 1.0, two);
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "signorini_projection: projected has 2 entries; it must have 3");
  }
}

}  // namespace
}  // namespace wavebalance::contact

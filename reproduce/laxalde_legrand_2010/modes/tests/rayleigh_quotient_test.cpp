#include "rayleigh_quotient.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "constants.hpp"
#include "ll10_rod.hpp"

namespace wavebalance::ll10 {
namespace {

struct RandomProblem {
  Eigen::MatrixXd stiffness, mass;
  FourierLayout layout;
  RayleighQuotient quotient;
  Eigen::VectorXd x;

  RandomProblem(int dofs, int harmonics, bool cosine_only, unsigned seed)
      : stiffness(symmetric(dofs, seed)),
        mass(symmetric(dofs, seed + 1)),
        layout{harmonics, cosine_only},
        quotient(stiffness, mass, layout),
        x(Eigen::VectorXd::Random(quotient.unknowns())) {}

  static Eigen::MatrixXd symmetric(int dofs, unsigned seed) {
    std::srand(seed);
    const Eigen::MatrixXd a = Eigen::MatrixXd::Random(dofs, dofs);
    return a * a.transpose() + Eigen::MatrixXd::Identity(dofs, dofs);
  }
};

class RandomMotion : public ::testing::TestWithParam<bool> {};

// r from the motion itself, by sums over 64 samples of u and of du/d(omega t).
TEST_P(RandomMotion, QuotientIsMeanPotentialOverMeanKineticEnergy) {
  const RandomProblem p(3, 4, GetParam(), 11);
  const int n = 3, samples = 64;
  double potential = 0.0, kinetic = 0.0;
  for (int k = 0; k < samples; ++k) {
    const double t = 2.0 * M_PI * k / samples;
    Eigen::VectorXd u = p.x.head(n), velocity = Eigen::VectorXd::Zero(n);
    for (int harmonic = 1; harmonic <= 4; ++harmonic) {
      const int cosine = GetParam() ? harmonic : 2 * harmonic - 1;
      u += std::cos(harmonic * t) * p.x.segment(n * cosine, n);
      velocity -= harmonic * std::sin(harmonic * t) * p.x.segment(n * cosine, n);
      if (GetParam()) continue;
      u += std::sin(harmonic * t) * p.x.segment(n * (cosine + 1), n);
      velocity += harmonic * std::cos(harmonic * t) * p.x.segment(n * (cosine + 1), n);
    }
    potential += u.dot(p.stiffness * u) / samples;
    kinetic += velocity.dot(p.mass * velocity) / samples;
  }
  EXPECT_NEAR(p.quotient.stiffness().value(p.x), potential, 100 * eps * potential);
  EXPECT_NEAR(p.quotient.mass().value(p.x), kinetic, 100 * eps * kinetic);
  EXPECT_NEAR(p.quotient.value(p.x), potential / kinetic, 200 * eps * potential / kinetic);
}

// With modal matrices both are held to automatic differentiation in the tests of the functional.
TEST_P(RandomMotion, GradientAndHessianAreTheDerivatives) {
  const RandomProblem p(2, 3, GetParam(), 5);
  const Eigen::VectorXd gradient = p.quotient.gradient(p.x);
  const Eigen::MatrixXd hessian = p.quotient.hessian(p.x);
  constexpr double step = 1e-6;
  for (Eigen::Index i = 0; i < p.x.size(); ++i) {
    const Eigen::VectorXd aside = step * Eigen::VectorXd::Unit(p.x.size(), i), up = p.x + aside,
                          down = p.x - aside;
    EXPECT_NEAR((p.quotient.value(up) - p.quotient.value(down)) / (2.0 * step), gradient[i], 1e-8);
    const Eigen::VectorXd column = (p.quotient.gradient(up) - p.quotient.gradient(down)) / (2.0 * step);
    EXPECT_LE((column - hessian.col(i)).norm(), 1e-8 * hessian.norm());
  }
}

TEST_P(RandomMotion, ScaleChangesNothingAndHessianTimesVectorIsTheMatrixProduct) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const RandomProblem p(4, 3, GetParam(), seed);
    const double r = p.quotient.value(p.x);
    for (const double scale : {-3.7, 1e-8, 1e8}) EXPECT_NEAR(p.quotient.value(scale * p.x), r, 50 * eps * r);
    const Eigen::VectorXd gradient = p.quotient.gradient(p.x);
    EXPECT_NEAR(gradient.dot(p.x), 0.0, 100 * eps * gradient.norm() * p.x.norm());
    const Eigen::MatrixXd hessian = p.quotient.hessian(p.x);
    // grad r (c x) = grad r (x) / c, differentiated by c.
    EXPECT_LE((hessian * p.x + gradient).norm(), 1e3 * eps * hessian.norm() * p.x.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Layout, RandomMotion, ::testing::Values(false, true));

// A mode is a critical point but no minimum: its shape in harmonic n has 1/n^2 of the quotient, critical too.
TEST(RayleighQuotient, EnergyInAHigherHarmonicLowersTheQuotient) {
  const solvers::testing::UnitRod rod(6);
  const int harmonics = 3, n = 6;
  const RayleighQuotient quotient(rod.stiffness, rod.mass, {harmonics});
  for (int harmonic = 1; harmonic <= harmonics; ++harmonic) {
    Eigen::VectorXd x = Eigen::VectorXd::Zero(quotient.unknowns());
    x.segment(n * (2 * harmonic - 1), n) = rod.shapes.col(0);
    const double expected = rod.model.omega_squared[0] / (harmonic * harmonic);
    EXPECT_NEAR(quotient.value(x), expected, 100 * eps * expected);
    EXPECT_LE(quotient.gradient(x).norm(), 1e-12 * rod.stiffness.norm());
  }
}

TEST(RayleighQuotient, SizesThatDisagreeAreErrors) {
  const Eigen::MatrixXd two = Eigen::MatrixXd::Identity(2, 2), three = Eigen::MatrixXd::Identity(3, 3);
  EXPECT_THROW(RayleighQuotient(two, three, {2}), std::invalid_argument);
  EXPECT_THROW(RayleighQuotient(two, two, {0}), std::invalid_argument);
  EXPECT_THROW(RayleighQuotient(Eigen::MatrixXd::Ones(2, 3), two, {1}), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::ll10

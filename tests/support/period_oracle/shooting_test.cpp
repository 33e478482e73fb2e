#include "period_oracle/shooting.hpp"

#include "support/jl14_bar.hpp"
#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"

namespace wavebalance::oracle {
namespace {

using solvers::AnyContactLaw, solvers::contact_rows, solvers::LinearStructure, solvers::Motion;
using solvers::testing::jl14_bar, solvers::testing::LinearContact, solvers::testing::Oscillator;
namespace testing = solvers::testing;

TEST(Shooting, GivesTheClosedFormOfALinearOscillator) {
  Oscillator oscillator;
  const double critical = 2.0 * std::sqrt(oscillator.stiffness * oscillator.mass);
  for (const double damping : {0.0, 30.0, critical, 100.0 * critical}) {
    oscillator.damping = damping;
    ShootingOptions options{.output_points = 60, .initial_displacement = Eigen::VectorXd::Constant(1, 3e-3)};
    const ShootingResult result =
        shoot(oscillator.structure(), AnyContactLaw(), oscillator.frequency, options);
    ASSERT_EQ(result.status, ShootingStatus::converged) << damping;
    const double amplitude = std::abs(oscillator.amplitude());
    const double omega = 2.0 * std::numbers::pi * oscillator.frequency;
    for (int l = 0; l < 60; ++l) {
      const double t = l / (60.0 * oscillator.frequency);
      EXPECT_NEAR(result.contacts.displacement(0, l), oscillator.steady_displacement(t), 1e-10 * amplitude);
      EXPECT_NEAR(result.contacts.velocity(0, l), oscillator.steady_velocity(t), 1e-10 * omega * amplitude);
    }
  }
}

TEST(Shooting, MultipliersOfALinearOscillatorAreItsDecay) {
  const Oscillator oscillator;
  const ShootingResult result = shoot(oscillator.structure(), AnyContactLaw(), oscillator.frequency);
  const double expected = std::exp(-0.5 * oscillator.damping / oscillator.mass / oscillator.frequency);
  ASSERT_EQ(result.floquet_multipliers.size(), 2);
  EXPECT_NEAR(std::abs(result.floquet_multipliers[0]), expected, 1e-12);
  EXPECT_NEAR(std::abs(result.floquet_multipliers[1]), expected, 1e-12);
}

TEST(Shooting, SamplesDoNotDependOnTheirNumber) {
  const testing::Jl14Case& scene = testing::jl14_case_2;
  const LinearStructure bar = scene.structure(6);
  ShootingOptions coarse, fine;
  coarse.output_points = 10;
  fine.output_points = 4000;
  const ShootingResult a = shoot(bar, scene.law, scene.frequency_hz, coarse);
  const ShootingResult b = shoot(bar, scene.law, scene.frequency_hz, fine);
  ASSERT_EQ(a.status, ShootingStatus::converged);
  ASSERT_EQ(b.status, ShootingStatus::converged);
  EXPECT_GT(b.contacts.force.maxCoeff(), 0.0);
  const double scale = b.contacts.displacement.cwiseAbs().maxCoeff();
  for (int l = 0; l < 10; ++l)
    EXPECT_NEAR(a.contacts.displacement(0, l), b.contacts.displacement(0, 400 * l), 1e-10 * scale);
}

TEST(Shooting, FullHistoryHoldsTheContactSamplesAndTheInitialState) {
  ShootingOptions options{.output_points = 32, .full_history = true};
  const ShootingResult result = shoot(jl14_bar(4, 1e-4), testing::ExponentialLaw{}, 150.0, options);
  ASSERT_EQ(result.status, ShootingStatus::converged);
  ASSERT_EQ(result.structure.displacement.rows(), 4);
  ASSERT_EQ(result.structure.velocity.cols(), 32);
  const double eps = std::numeric_limits<double>::epsilon();
  const Motion &all = result.structure, &contact = result.contacts;
  EXPECT_LT((all.displacement.row(3) - contact.displacement).norm(), 100 * eps * contact.displacement.norm());
  EXPECT_LT((all.velocity.row(3) - contact.velocity).norm(), 100 * eps * contact.velocity.norm());
  EXPECT_LT((all.displacement.col(0) - result.displacement).norm(), 100 * eps * result.displacement.norm());
  EXPECT_LT((all.velocity.col(0) - result.velocity).norm(), 100 * eps * result.velocity.norm());
}

TEST(Shooting, StartsOnEitherBranchOfABistableResponse) {
  // Between its folds near 1315 and 1338 Hz case 2 has one motion in contact and one without.
  const testing::Jl14Case& scene = testing::jl14_case_2;
  const LinearStructure bar = scene.structure();
  const ShootingResult below = shoot(bar, scene.law, 1300.0);
  ASSERT_EQ(below.status, ShootingStatus::converged);
  ShootingOptions options{.initial_displacement = below.displacement, .initial_velocity = below.velocity};
  const ShootingResult contact = shoot(bar, scene.law, 1320.0, options);
  const ShootingResult free = shoot(bar, scene.law, 1320.0);
  ASSERT_EQ(contact.status, ShootingStatus::converged);
  ASSERT_EQ(free.status, ShootingStatus::converged);
  EXPECT_GT(contact.contacts.force.maxCoeff(), 1e5);
  EXPECT_EQ(free.contacts.force.maxCoeff(), 0.0);
  EXPECT_LT(std::abs(contact.floquet_multipliers[0]), 1.0);
  EXPECT_LT(std::abs(free.floquet_multipliers[0]), 1.0);
}

TEST(Shooting, TooFewIterationsAreNotConverged) {
  const testing::Jl14Case& scene = testing::jl14_case_2;
  ShootingOptions options{.settling_periods = 0, .max_iterations = 1};
  const ShootingResult result = shoot(scene.structure(6), scene.law, scene.frequency_hz, options);
  EXPECT_EQ(result.status, ShootingStatus::iteration_limit);
  EXPECT_GT(result.residual, options.tolerance);
  EXPECT_EQ(result.residual_history.back(), result.residual);
}

TEST(Shooting, LawThatJumpsIsAStepFailure) {
  struct Jump {
    double force(double u) const { return u > 1e-3 ? 1e5 : 0.0; }
    double tangent(double) const { return 0.0; }
    double potential(double u) const { return u > 1e-3 ? 1e5 * (u - 1e-3) : 0.0; }
    double gap() const { return 1e-3; }
  };
  const ShootingResult result = shoot(jl14_bar(4, 1e-4), Jump{}, 150.0);
  EXPECT_EQ(result.status, ShootingStatus::step_failure);
  EXPECT_EQ(result.contacts.points(), 0);
}

// As the modes of a stiff structure leave it between the fastest ones, by which modal damping was built.
TEST(Shooting, TakesDampingOfWhichRoundingAloneCouplesTheModes) {
  const auto damped = [](double coupling) {
    Eigen::Matrix3d damping = Eigen::Vector3d(10.0, 1e5, 1e5).asDiagonal();
    damping(1, 2) = damping(2, 1) = 1e5 * coupling;
    return testing::structure(Eigen::Matrix3d::Identity(), damping,
                              Eigen::Vector3d(1e5, 1e13, 2e13).asDiagonal(), Eigen::Vector3d(1.0, 0.0, 0.0),
                              contact_rows({0}, 3));
  };
  EXPECT_EQ(shoot(damped(2e-9), AnyContactLaw(), 30.0).status, ShootingStatus::converged);
  EXPECT_THROW(shoot(damped(2e-8), AnyContactLaw(), 30.0), std::invalid_argument);
}

TEST(Shooting, RejectsStructuresItCannotTreat) {
  const LinearStructure bar = jl14_bar(3, 1e-4);
  for (const double bad : {0.0, -150.0, nan, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(shoot(bar, AnyContactLaw(), bad), std::invalid_argument) << bad;
  LinearStructure coupled = bar;
  coupled.damping.coeffRef(0, 0) *= 2.0;
  EXPECT_THROW(shoot(coupled, AnyContactLaw(), 150.0), std::invalid_argument);
  LinearStructure massless = bar;
  massless.mass.coeffRef(1, 1) = -1.0;
  EXPECT_THROW(shoot(massless, AnyContactLaw(), 150.0), std::invalid_argument);
  LinearStructure unsymmetric = bar;
  unsymmetric.stiffness.coeffRef(0, 1) *= 1.1;
  EXPECT_THROW(shoot(unsymmetric, AnyContactLaw(), 150.0), std::invalid_argument);
  LinearStructure with_loss = bar;
  with_loss.loss_factor = 0.01;
  EXPECT_THROW(shoot(with_loss, AnyContactLaw(), 150.0), std::invalid_argument);
  LinearStructure two_contacts = bar;
  two_contacts.contact_directions = contact_rows({1, 2}, 3);
  EXPECT_THROW(shoot(two_contacts, AnyContactLaw(), 150.0), std::invalid_argument);
  LinearStructure misfit = bar;
  misfit.load = Eigen::VectorXd::Zero(2);
  EXPECT_THROW(shoot(misfit, AnyContactLaw(), 150.0), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::oracle

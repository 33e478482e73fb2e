#include "wavebalance/solvers/modes/mode_stability.hpp"

#include <functional>

#include "ll10_rod.hpp"
#include "support/oscillator.hpp"
#include "support/rigid_law.hpp"
#include "support/runge_kutta.hpp"
#include "support/small_problems.hpp"
#include "testing.hpp"
#include "wavebalance/solvers/stability/monodromy.hpp"

namespace wavebalance::solvers {
namespace {

using testing::fourier_pair;
using testing::LinearContact;
using testing::UnitRod;

ElasticBackboneOptions up_to(double energy) { return {.max_energy = energy, .max_frequency_ratio = 10.0}; }

/// Two equal masses, each with a stop of stiffness k at 1. Alike they move at 1, against each other at
/// omega_2.
struct Twins {
  double second_squared, stop;

  ElasticMode mode(int functions = 127) const {
    const Eigen::Matrix2d shapes{{std::sqrt(0.5), std::sqrt(0.5)}, {std::sqrt(0.5), -std::sqrt(0.5)}};
    const ModalModel model{Eigen::Vector2d(1.0, second_squared), shapes, Eigen::Vector2d::Ones()};
    return {model, fourier_pair(functions, 8 * functions + 8), LinearContact{stop, 1.0}};
  }

  /// The sum of the two multipliers of a difference between the masses while they move alike: two arcs at
  /// omega_2 and, in contact, at sqrt(omega_2^2 + k) [Hill's equation with a step].
  double trace(double energy_ratio) const {
    const double natural = std::sqrt(1.0 + stop);
    const double flight = 2.0 * std::acos(-1.0 / std::sqrt(energy_ratio));
    const double contact =
        2.0 * std::atan2(std::sqrt(energy_ratio - 1.0) / natural, 1.0 / (1.0 + stop)) / natural;
    const double a = std::sqrt(second_squared), b = std::sqrt(second_squared + stop);
    return 2.0 * std::cos(a * flight) * std::cos(b * contact) -
           (a / b + b / a) * std::sin(a * flight) * std::sin(b * contact);
  }
};

double root_between(double low, double high, const std::function<double(double)>& value) {
  const bool rises = value(high) > value(low);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    ((value(middle) > 0.0) == rises ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

TEST(ModeStability, MultipliersOfTwinsThatMoveAlikeAreThoseOfHillsEquation) {
  const Twins stable{3.7, 2.0}, doubled{2.45, 8.0}, branched{4.8, 8.0};
  int unstable = 0;
  for (const Twins& twins : {stable, doubled, branched}) {
    const ElasticMode mode = twins.mode();
    const ModeMultipliers multipliers(mode);
    for (const ModePoint& point : mode.backbone(up_to(20.0)).points) {
      const ModeStability found = multipliers(point);
      ASSERT_EQ(found.status, StabilityStatus::converged);
      ASSERT_EQ(found.multipliers.size(), 2);
      const double trace = twins.trace(point.energy_ratio);
      EXPECT_NEAR(found.multipliers.sum().real(), trace, 3e-4) << point.energy_ratio;
      EXPECT_NEAR(std::abs(found.multipliers.prod() - 1.0), 0.0, 1e-10);
      if (std::abs(std::abs(trace) - 2.0) > 1e-3) {
        EXPECT_EQ(found.unstable, std::abs(trace) > 2.0 ? 1 : 0);
      }
      EXPECT_EQ(found.contacts, 2);
      unstable += found.unstable;
    }
  }
  EXPECT_GT(unstable, 4);
}

void expect_special_point(const Twins& twins, double border, SpecialPointType type) {
  const auto beyond = [&](double energy) { return border * twins.trace(energy) - 2.0; };
  const ElasticMode mode = twins.mode();
  const ElasticBackbone curve = mode.backbone(up_to(20.0));
  const BackboneStability stability = backbone_stability(mode, curve);
  EXPECT_EQ(stability.status(), StabilityStatus::converged);
  ASSERT_FALSE(stability.special_points.empty());
  for (const ModeSpecialPoint& point : stability.special_points) {
    EXPECT_EQ(point.type, type);
    EXPECT_TRUE(point.located);
    EXPECT_NEAR(std::abs(point.multiplier - border), 0.0, 3e-3);
    const double e = point.energy_ratio;
    const double exact = root_between(0.95 * e, 1.05 * e, beyond);
    EXPECT_NEAR(e, exact, 1e-3 * e);
  }
}

TEST(ModeStability, PeriodDoublingOfTwinsLiesWhereTheTraceIsMinusTwo) {
  expect_special_point({2.45, 8.0}, -1.0, SpecialPointType::period_doubling);
}

TEST(ModeStability, BranchPointOfTwinsLiesWhereTheTraceIsTwo) {
  expect_special_point({4.8, 8.0}, 1.0, SpecialPointType::branch);
}

TEST(ModeStability, OscillatorWithAStopIsStableAtEveryEnergy) {
  const ModalModel model{Eigen::VectorXd::Ones(1), Eigen::MatrixXd::Ones(1, 1), Eigen::VectorXd::Ones(1)};
  const ElasticMode mode(model, fourier_pair(63, 512), LinearContact{10.0, 1.0});
  const BackboneStability stability = backbone_stability(mode, mode.backbone(up_to(20.0)));
  EXPECT_EQ(stability.status(), StabilityStatus::converged);
  EXPECT_TRUE(stability.special_points.empty());
  for (const ModeStability& point : stability.points) {
    EXPECT_EQ(point.unstable, 0);
    EXPECT_EQ(point.contacts, 1);
    EXPECT_EQ(point.multipliers.size(), 0);
  }
}

/// The largest distance from 1 of the two multipliers of an oscillator's free motions, phase and energy.
double distance_from_one(int functions) {
  const ModalModel model{Eigen::VectorXd::Ones(1), Eigen::MatrixXd::Ones(1, 1), Eigen::VectorXd::Ones(1)};
  const ElasticMode mode(model, fourier_pair(functions, 8 * functions + 8), LinearContact{10.0, 1.0});
  const auto dynamics = ContactDynamics::undamped(model.omega_squared, model.contact_shapes, 1);
  double distance = 0.0;
  for (const double energy : {1.3, 2.0, 5.0}) {
    const ModePoint point = mode.at_energy(energy, up_to(energy));
    const Eigen::VectorXcd both = monodromy(dynamics, mode.contact_stiffness(point), point.omega / two_pi);
    EXPECT_NEAR(std::abs(both.prod() - 1.0), 0.0, 1e-12);
    distance = std::max(distance, (both.array() - 1.0).abs().maxCoeff());
  }
  return distance;
}

TEST(ModeStability, PhaseAndEnergyHaveTheMultiplierOneUpToTheRootOfTheError) {
  const double coarse = distance_from_one(31), fine = distance_from_one(255);
  EXPECT_LT(coarse, 0.2);
  EXPECT_LT(fine, 0.02);
}

/// The largest closure along the curve of a rod, whose multipliers come as reciprocal pairs everywhere.
double largest_closure(int functions) {
  const UnitRod rod(4);
  const ElasticMode mode(rod.model, fourier_pair(functions, 8 * functions + 8), LinearContact{2.0, 1.0});
  const ElasticBackbone curve = mode.backbone(up_to(4.0));
  const BackboneStability stability = backbone_stability(mode, curve);
  EXPECT_EQ(stability.points.size(), curve.points.size());
  double largest = 0.0;
  for (const ModeStability& point : stability.points) {
    EXPECT_EQ(point.status, StabilityStatus::converged);
    const Eigen::VectorXcd& mu = point.multipliers;
    EXPECT_EQ(mu.size(), 6);
    for (Eigen::Index i = 0; i < mu.size(); ++i) {
      EXPECT_LT((mu.array() * mu[i] - 1.0).abs().minCoeff(), 1e-7);
      EXPECT_LT((mu.array() - std::conj(mu[i])).abs().minCoeff(), 1e-12);
    }
    largest = std::max(largest, point.closure);
  }
  return largest;
}

TEST(ModeStability, MultipliersAreReciprocalPairsAndTheVelocityReturnsBetterWithMoreHarmonics) {
  const double coarse = largest_closure(31), fine = largest_closure(127);
  EXPECT_LT(coarse, 0.05);
  EXPECT_LT(fine, 0.2 * coarse);
}

TEST(ModeStability, CountIsThatOfTheWholeMonodromyAwayFromOne) {
  const UnitRod rod(4);
  const ElasticMode mode(rod.model, fourier_pair(127, 1024), LinearContact{10.0, 1.0});
  const ElasticBackbone curve =
      mode.backbone({.max_energy = 5.0, .max_frequency_ratio = 10.0, .max_step = 0.04});
  const ModeMultipliers multipliers(mode);
  const auto dynamics = ContactDynamics::undamped(rod.model.omega_squared, rod.model.contact_shapes, 4);
  int compared = 0, unstable = 0;
  for (const ModePoint& point : curve.points) {
    const ModeStability found = multipliers(point);
    ASSERT_EQ(found.status, StabilityStatus::converged);
    const Eigen::VectorXcd all = monodromy(dynamics, mode.contact_stiffness(point), point.omega / two_pi);
    const auto outside = all.array().abs() > 1.005 && (all.array() - 1.0).abs() > 0.1;
    const auto reduced =
        found.multipliers.array().abs() > 1.005 && (found.multipliers.array() - 1.0).abs() > 0.1;
    EXPECT_EQ(outside.count(), reduced.count()) << point.energy_ratio;
    unstable += static_cast<int>(reduced.count());
    ++compared;
  }
  EXPECT_GT(compared, 10);
  EXPECT_GT(unstable, 0);
}

TEST(ModeStability, LinearMotionsAreOnTheUnitCircle) {
  const UnitRod rod(4);
  const ElasticMode mode(rod.model, fourier_pair(31, 256), LinearContact{2.0, 1.0});
  const ModeStability found = ModeMultipliers(mode)(mode.linear_mode(0.5));
  EXPECT_EQ(found.status, StabilityStatus::converged);
  EXPECT_EQ(found.unstable, 0);
  EXPECT_EQ(found.contacts, 0);
  EXPECT_LT((found.multipliers.cwiseAbs().array() - 1.0).abs().maxCoeff(), 1e-14);
}

TEST(ModeStability, MotionOfTooFewHarmonicsHasAnUnknownStability) {
  const UnitRod rod(20);
  const ElasticMode mode(rod.model, fourier_pair(11, 80), LinearContact{10.0, 1.0});
  const BackboneStability stability =
      backbone_stability(mode, mode.backbone(up_to(3.0)), {.max_closure = 0.01});
  EXPECT_EQ(stability.status(), StabilityStatus::too_few_harmonics);
  for (const ModeStability& point : stability.points) EXPECT_EQ(point.unstable >= 0, point.closure <= 0.01);
}

/// The rod with a spring at its tip, without mass.
ModalModel with_spring(ModalModel model, double stiffness) {
  const Eigen::Index modes = model.omega_squared.size();
  const double far = 1e10 * model.omega_squared[modes - 1];
  model.omega_squared.conservativeResize(modes + 1);
  model.contact_shapes.conservativeResize(Eigen::NoChange, modes + 1);
  model.omega_squared[modes] = far;
  model.contact_shapes(0, modes) = std::sqrt(far / stiffness);
  model.springs = 1;
  return model;
}

TEST(ModeStability, OfRigidContactOnASpringIsThatOfALinearStop) {
  const UnitRod rod(4);
  constexpr double stiffness = 2.0;
  const TimePair pair = fourier_pair(127, 1024);
  const ElasticMode rigid(with_spring(rod.model, stiffness), pair, testing::Rigid{1.0});
  const ElasticMode stop(rod.model, pair, LinearContact{stiffness, 1.0});
  for (const double energy : {1.5, 2.2}) {
    const ModePoint a = rigid.at_energy(energy, up_to(energy)), b = stop.at_energy(energy, up_to(energy));
    ASSERT_EQ(a.status, ModeStatus::converged);
    EXPECT_NEAR(a.omega, b.omega, 1e-6 * b.omega);
    const ModeStability held = ModeMultipliers(rigid)(a), elastic = ModeMultipliers(stop)(b);
    ASSERT_EQ(held.status, StabilityStatus::converged);
    EXPECT_EQ(held.unstable, elastic.unstable);
    ASSERT_EQ(held.multipliers.size(), elastic.multipliers.size());
    for (const std::complex<double> mu : elastic.multipliers)
      EXPECT_LT((held.multipliers.array() - mu).abs().minCoeff(), 1e-4) << energy;
  }
}

TEST(ModeStability, EffortIsLimitedAndBadOptionsAreRefused) {
  const Twins twins{3.7, 2.0};
  const ElasticMode mode = twins.mode(15);
  const ModePoint point = mode.at_energy(2.0, up_to(2.0));
  EXPECT_EQ(ModeMultipliers(mode, {.max_states = 2})(point).status, StabilityStatus::effort_limit);
  EXPECT_THROW(ModeMultipliers(mode, {.growth = 0.0}), std::invalid_argument);
  EXPECT_THROW(ModeMultipliers(mode, {.tolerance = -1.0}), std::invalid_argument);
  EXPECT_THROW(ModeMultipliers(mode, {.max_closure = 0.0}), std::invalid_argument);
  EXPECT_THROW(ModeMultipliers(mode, {.max_states = -1}), std::invalid_argument);
  ModeStabilityOptions options;
  options.observer = [](const Progress&) { return false; };
  const BackboneStability cancelled = backbone_stability(mode, mode.backbone(up_to(3.0)), options);
  EXPECT_TRUE(cancelled.cancelled);
  EXPECT_EQ(cancelled.points.size(), 1u);
}

}  // namespace
}  // namespace wavebalance::solvers

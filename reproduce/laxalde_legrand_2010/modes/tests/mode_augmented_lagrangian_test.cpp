#include "mode_augmented_lagrangian.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>
#include <set>

#include "enumerators.hpp"
#include "ll10_rod.hpp"
#include "wavebalance/contact/multipliers.hpp"

namespace wavebalance::ll10 {
namespace {

using solvers::ModePoint;
using solvers::NonlinearMode;
using solvers::testing::UnitRod;

contact::MultiplierUpdate strategy(const LagrangianMode& mode, double penalty = 300.0) {
  const auto count = static_cast<std::size_t>(mode.constraints());
  return contact::MultiplierUpdate(std::vector<double>(count, penalty), {penalty});
}

std::vector<double> energies(double last, double step) {
  std::vector<double> ratios;
  for (int i = 0; 1.0 + i * step <= last + 1e-9; ++i) ratios.push_back(1.0 + i * step);
  return ratios;
}

std::vector<LagrangianPoint> cold_branch(const LagrangianMode& mode, double last, double step) {
  return mode.branch(energies(last, step), strategy(mode), mode.linear_start(1.0));
}

Eigen::MatrixXcd force_harmonics(const LagrangianPoint& point) {
  const Eigen::Index harmonics = point.amplitudes.cols(), samples = point.force.cols();
  Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(point.force.rows(), harmonics);
  for (Eigen::Index n = 0; n < harmonics; ++n)
    for (Eigen::Index k = 0; k < samples; ++k)
      result.col(n) += point.force.col(k) *
                       std::polar(1.0 / double(samples),
                                  -2.0 * std::numbers::pi * double(n * k % samples) / double(samples));
  return result;
}

// ||K u_n + force_n - n^2 omega^2 M u_n|| over ||K u||, by the matrices of the rod; least: with the omega^2
// that makes it least.
double equation_residual(const UnitRod& rod, const LagrangianPoint& point, bool least = false) {
  const Eigen::MatrixXcd u = rod.shapes * point.amplitudes, force = force_harmonics(point);
  Eigen::MatrixXcd statics = rod.stiffness * u, inertia = rod.mass * u;
  const double scale = statics.norm();
  statics.bottomRows(1) += force;
  for (Eigen::Index n = 0; n < u.cols(); ++n) inertia.col(n) *= double(n * n);
  const double best = inertia.conjugate().cwiseProduct(statics).sum().real() / inertia.squaredNorm();
  return (statics - (least ? best : point.omega * point.omega) * inertia).norm() / scale;
}

double relative(double a, double b) { return std::abs(a / b - 1.0); }

TEST(LagrangianMode, BelowContactTheLinearModeIsTheCriticalPoint) {
  const UnitRod rod(20);
  for (const auto formulation : {ModeFormulation::consistent, ModeFormulation::published}) {
    const LagrangianMode mode(rod.model, {.harmonics = 3, .formulation = formulation});
    auto outer = strategy(mode);
    for (const double ratio : {0.1, 0.7, 1.0}) {
      const LagrangianPoint point = mode.solve(ratio, outer, mode.linear_start(4.0));
      EXPECT_EQ(point.status, LagrangianStatus::linear);
      EXPECT_LE(relative(point.omega, mode.linear_omega()), 1e-14);
      EXPECT_NEAR(point.energy_ratio, ratio, 1e-14);
      EXPECT_NEAR(point.max_penetration, std::sqrt(ratio) - 1.0, 1e-13);
      EXPECT_LE(equation_residual(rod, point), 1e-12);
    }
  }
}

struct Cold {
  int harmonics;
  bool cosine_only;

  friend void PrintTo(const Cold& start, std::ostream* out) {
    *out << "N = " << start.harmonics << (start.cosine_only ? ", cosine" : ", full");
  }
};

class ColdBranch : public ::testing::TestWithParam<Cold> {};

TEST_P(ColdBranch, AgreesWithTheCondensedSolverToSevenDigits) {
  const UnitRod rod(20);
  const auto [harmonics, cosine_only] = GetParam();
  const LagrangianMode mode(rod.model, {.harmonics = harmonics, .cosine_only = cosine_only});
  const NonlinearMode condensed(rod.model, {.harmonics = harmonics, .cosine_only = cosine_only});
  const auto curve = backbone(condensed, {});
  const auto points = cold_branch(mode, 4.0, 0.25);
  ASSERT_EQ(points.size(), 13u);
  for (const LagrangianPoint& point : points) {
    ASSERT_TRUE(point.accepted()) << to_string(point.status) << " at " << point.prescribed_ratio;
    const ModePoint expected = at_energy(condensed, curve, point.prescribed_ratio);
    ASSERT_TRUE(expected.accepted());
    EXPECT_NEAR(point.energy_ratio, point.prescribed_ratio, 1e-8);
    EXPECT_LE(relative(point.omega, expected.omega), 1e-7);
    EXPECT_LE(relative(point.rayleigh, expected.rayleigh), 2e-7);
    EXPECT_LE(equation_residual(rod, point), 1e-9);
    EXPECT_LE(point.virial_residual, 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Rod, ColdBranch,
                         ::testing::Values(Cold{1, true}, Cold{1, false}, Cold{2, true}, Cold{2, false}));

struct Warm {
  int harmonics;
  bool cosine_only;
  double lumped_fraction;

  friend void PrintTo(const Warm& start, std::ostream* out) {
    *out << "N = " << start.harmonics << (start.cosine_only ? ", cosine" : ", full") << ", lumped "
         << start.lumped_fraction;
  }
};

class WarmStart : public ::testing::TestWithParam<Warm> {};

// From a condensed point on to an energy 0.05 higher, where the active set may be another.
TEST_P(WarmStart, AgreesWithTheCondensedSolverToSevenDigits) {
  const auto [harmonics, cosine_only, lumped_fraction] = GetParam();
  const UnitRod rod(20, lumped_fraction);
  const NonlinearMode condensed(rod.model, {.harmonics = harmonics, .cosine_only = cosine_only});
  const auto curve = backbone(condensed, {});
  const LagrangianMode mode(rod.model, {.harmonics = harmonics, .cosine_only = cosine_only});
  for (const double ratio : {1.5, 3.0, 5.0, 10.0}) {
    const ModePoint start = at_energy(condensed, curve, ratio - 0.05);
    const ModePoint expected = at_energy(condensed, curve, ratio);
    ASSERT_TRUE(start.accepted() && expected.accepted());
    auto outer = strategy(mode);
    const LagrangianPoint point = mode.solve(ratio, outer, {start.amplitudes, start.force});
    ASSERT_EQ(point.status, LagrangianStatus::converged) << ratio;
    EXPECT_LE(relative(point.omega, expected.omega), 1e-7);
    EXPECT_LE(relative(point.rayleigh, expected.rayleigh), 2e-7);
    EXPECT_LE(equation_residual(rod, point), 1e-9);
    EXPECT_LE(point.equation_residual, 1e-9);
    EXPECT_LE(point.max_penetration, 1e-9);
    EXPECT_GE(point.min_force, 0.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Rod, WarmStart,
                         ::testing::Values(Warm{5, true, 0.0}, Warm{5, false, 0.0}, Warm{10, true, 0.5}));

TEST(LagrangianMode, PublishedEquationsHaveASolutionThatIsNoMotionAtAnyFrequency) {
  const UnitRod rod(20);
  for (const int harmonics : {1, 2}) {
    const LagrangianMode mode(rod.model, {.harmonics = harmonics, .formulation = ModeFormulation::published});
    for (const LagrangianPoint& point : cold_branch(mode, 4.0, 0.25)) {
      ASSERT_TRUE(point.accepted());
      EXPECT_DOUBLE_EQ(point.omega, std::sqrt(point.rayleigh));
      if (point.prescribed_ratio < 1.5) continue;
      EXPECT_GT(point.equation_residual, 1e-2);
      EXPECT_GT(equation_residual(rod, point), 1e-2);
      EXPECT_GT(equation_residual(rod, point, true), 1e-3);
      EXPECT_GT(std::abs(point.energy_ratio - point.prescribed_ratio), 1e-2);  // h without n^2 is no energy
    }
  }
}

// The frozen eigenvalue is taken up by the multiplier of h, which has the same form with n^2.
TEST(LagrangianMode, SequentialIsSimultaneousWhateverTheStepWhereHIsConsistent) {
  const UnitRod rod(20);
  const LagrangianMode together(rod.model, {.cosine_only = true});
  const LagrangianMode apart(rod.model, {.cosine_only = true, .eigenvalue = EigenvalueUpdate::sequential});
  const auto expected = cold_branch(together, 4.0, 0.5), points = cold_branch(apart, 4.0, 0.5);
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    ASSERT_TRUE(points[i].accepted());
    EXPECT_LE(relative(points[i].omega, expected[i].omega), 1e-9);
  }
}

TEST(LagrangianMode, SequentialTendsToSimultaneousWithTheStepWhereHIsPublished) {
  const UnitRod rod(20);
  LagrangianModeOptions options{.cosine_only = true, .formulation = ModeFormulation::published};
  const LagrangianMode together(rod.model, options);
  options.eigenvalue = EigenvalueUpdate::sequential;
  const LagrangianMode apart(rod.model, options);
  std::vector<double> distance;
  for (const double step : {0.2, 0.1, 0.05}) {
    const LagrangianPoint a = cold_branch(together, 3.0, step).back(),
                          b = cold_branch(apart, 3.0, step).back();
    ASSERT_TRUE(a.accepted() && b.accepted());
    distance.push_back((a.amplitudes - b.amplitudes).norm() / a.amplitudes.norm());
  }
  EXPECT_LT(distance[0], 1e-2);
  EXPECT_LT(distance[1], distance[0] / 3.0);  // a secant predicts to second order
  EXPECT_LT(distance[2], distance[1] / 3.0);
}

TEST(LagrangianMode, AnyNumberOfContactsAgreesWithTheCondensedSolver) {
  const UnitRod rod(10);
  ModalModel model = rod.model;
  model.contact_shapes.resize(2, 10);
  model.contact_shapes << rod.shapes.row(9), rod.shapes.row(4);
  model.gaps = Eigen::Vector2d(1.0, 0.75);  // the middle node follows once the tip is held
  const NonlinearMode condensed(model, {.harmonics = 2, .cosine_only = true});
  const LagrangianMode mode(model, {.harmonics = 2, .cosine_only = true});
  const auto points = cold_branch(mode, 3.0, 0.1);
  const auto curve = backbone(condensed, {.last_ratio = 1.4});
  ASSERT_EQ(points.size(), 21u);
  double both = 0.0;
  for (const LagrangianPoint& point : points) {
    ASSERT_TRUE(point.accepted());
    const ModePoint expected = at_energy(condensed, curve, point.prescribed_ratio);
    ASSERT_TRUE(expected.accepted());
    EXPECT_LE(relative(point.omega, expected.omega), 1e-7);
    both = std::max(both, point.force.rowwise().maxCoeff().minCoeff());
  }
  EXPECT_GT(both, 0.0);
}

TEST(LagrangianMode, UnitsOfTheModelDoNotMatter) {
  const UnitRod rod(10);
  ModalModel other = rod.model;  // rad/s, kg^-1/2 and m of a steel rod
  other.omega_squared *= 2.7e7;
  other.contact_shapes *= 0.4;
  other.gaps *= 1e-4;
  const LagrangianMode mode(rod.model, {}), scaled(other, {});
  const LagrangianPoint a = cold_branch(mode, 2.0, 0.25).back(), b = cold_branch(scaled, 2.0, 0.25).back();
  ASSERT_TRUE(a.accepted() && b.accepted());
  EXPECT_LE(relative(b.omega / scaled.linear_omega(), a.omega / mode.linear_omega()), 1e-9);
  EXPECT_LE(relative(b.energy_ratio, a.energy_ratio), 1e-9);
  // force ~ omega^2 amplitude / shape, amplitude ~ gap / shape
  EXPECT_LE(relative(b.force.maxCoeff(), a.force.maxCoeff() * 2.7e7 * 1e-4 / (0.4 * 0.4)), 1e-6);
}

TEST(LagrangianMode, HistoryEndsBelowTheTolerancesOfTheStrategy) {
  const UnitRod rod(20);
  const LagrangianMode mode(rod.model, {});
  auto outer = strategy(mode);
  const LagrangianPoint point = mode.solve(1.5, outer, mode.linear_start(1.2));
  ASSERT_TRUE(point.accepted());
  ASSERT_GE(point.history.size(), 2u);
  EXPECT_GT(point.history.front().inequality_measure, 1e-6);
  EXPECT_LT(point.history.back().inequality_measure, 1e-10);
  EXPECT_LT(point.history.back().equality_measure, 1e-10);
  for (const OuterIteration& iteration : point.history) EXPECT_LE(iteration.gradient, 1e-10);
}

TEST(LagrangianMode, AllEnergyInHarmonicTwoIsACriticalPointThatLeftTheMode) {
  const UnitRod rod(20);
  const LagrangianMode mode(rod.model, {});
  LagrangianStart start = mode.linear_start(2.0 / 4.0);
  start.amplitudes.col(1).swap(start.amplitudes.col(2));
  auto outer = strategy(mode);
  const LagrangianPoint point = mode.solve(2.0, outer, start);
  EXPECT_EQ(point.status, LagrangianStatus::left_mode);
  EXPECT_LE(relative(point.rayleigh, rod.model.omega_squared[0] / 4.0), 1e-10);
  EXPECT_FALSE(point.accepted());
}

TEST(LagrangianMode, RunningOutOfIterationsIsAStatus) {
  const UnitRod rod(20);
  const LagrangianMode newton(rod.model, {.max_inner_iterations = 1}),
      outer(rod.model, {.max_outer_iterations = 1});
  auto few = strategy(newton), one = strategy(outer);
  EXPECT_EQ(newton.solve(2.0, few, newton.linear_start(2.0)).status, LagrangianStatus::inner_limit);
  EXPECT_EQ(outer.solve(1.1, one, outer.linear_start(1.1)).status, LagrangianStatus::outer_limit);
}

// Cold, more harmonics follow the 3:1 resonance with mode 2, 2.7 Hz above the mode.
TEST(LagrangianMode, ColdWithThreeHarmonicsTheInternalResonanceIsNamed) {
  const UnitRod rod(20);
  const LagrangianMode mode(rod.model, {.harmonics = 3, .cosine_only = true});
  const LagrangianPoint point = cold_branch(mode, 3.0, 0.05).back();
  EXPECT_EQ(point.status, LagrangianStatus::internal_resonance);
  EXPECT_EQ(point.resonance.harmonic, 3);
  EXPECT_EQ(point.resonance.mode, 2);
  EXPECT_LE(point.equation_residual, 1e-9);
}

// With the half-lumped mass mode 2 is at three times mode 1, and no step beyond grazing succeeds.
TEST(LagrangianMode, ColdAtAnExactResonanceTheFailureIsNamed) {
  const UnitRod rod(20, 0.5);
  const LagrangianMode mode(rod.model, {.harmonics = 3, .cosine_only = true});
  const auto points = cold_branch(mode, 2.0, 0.25);
  EXPECT_EQ(points.front().status, LagrangianStatus::linear);
  EXPECT_EQ(to_string(points.back().status), "inner_stalled");
  EXPECT_LT(points.back().prescribed_ratio, 1.25);
}

TEST(LagrangianModeOptions, ValidateNamesTheFieldTheValueAndWhatIsAllowed) {
  const auto message = [](const LagrangianModeOptions& options) -> std::string {
    try {
      options.validate();
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message({}), "accepted");
  EXPECT_EQ(message({.mode = 0}), "LagrangianModeOptions: mode is 0; it must be at least 1");
  EXPECT_EQ(message({.harmonics = 0}), "LagrangianModeOptions: harmonics is 0; it must be at least 1");
  EXPECT_EQ(message({.harmonics = 10, .samples = 19}),
            "LagrangianModeOptions: samples is 19; it must be at least twice the harmonics, which are 10");
  EXPECT_EQ(message({.inner_tolerance = 0.0}),
            "LagrangianModeOptions: inner_tolerance is 0; it must be positive and finite");
  EXPECT_EQ(message({.max_inner_iterations = 0}),
            "LagrangianModeOptions: max_inner_iterations is 0; it must be at least 1");
  EXPECT_EQ(message({.max_outer_iterations = -1}),
            "LagrangianModeOptions: max_outer_iterations is -1; it must be at least 1");
  EXPECT_EQ(message({.max_step_halvings = -1}),
            "LagrangianModeOptions: max_step_halvings is -1; it must be at least 0");
}

TEST(LagrangianMode, BadArgumentsAreErrors) {
  const UnitRod rod(4);
  const LagrangianMode mode(rod.model, {});
  auto outer = strategy(mode);
  contact::MultiplierUpdate small({1.0}, {1.0});
  contact::MultiplierUpdate unnormalised(std::vector<double>(20, 1.0));
  const LagrangianStart start = mode.linear_start(1.5);
  EXPECT_THROW(mode.solve(1.5, small, start), std::invalid_argument);
  EXPECT_THROW(mode.solve(1.5, unnormalised, start), std::invalid_argument);
  EXPECT_THROW(mode.solve(0.0, outer, start), std::invalid_argument);
  EXPECT_THROW(mode.solve(std::nan(""), outer, start), std::invalid_argument);
  EXPECT_THROW(mode.solve(1.5, outer, {Eigen::MatrixXcd::Zero(3, 2), {}}), std::invalid_argument);
  EXPECT_THROW(mode.solve(1.5, outer, {start.amplitudes, Eigen::MatrixXd::Zero(1, 3)}),
               std::invalid_argument);
  EXPECT_THROW(mode.linear_start(-1.0), std::invalid_argument);
  EXPECT_THROW(LagrangianMode(rod.model, {.mode = 5}), std::invalid_argument);
  EXPECT_THROW(LagrangianMode(rod.model, {.harmonics = 11}), std::invalid_argument);
  EXPECT_THROW(LagrangianMode(rod.model, {.inner_tolerance = 0.0}), std::invalid_argument);
}

TEST(LagrangianStatus, EveryEnumeratorHasANameOfItsOwn) {
  std::set<std::string_view> names{"unknown"};
  for (const auto status : enumerators<LagrangianStatus>())
    EXPECT_TRUE(names.insert(to_string(status)).second) << to_string(status);
}

}  // namespace
}  // namespace wavebalance::ll10

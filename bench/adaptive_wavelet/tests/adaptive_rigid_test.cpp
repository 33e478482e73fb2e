#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "adaptive_rigid.hpp"
#include "pairs.hpp"
#include "period_oracle/rigid_reference.hpp"

// Force cells against a rigid obstacle, held to the exact flows of the bar without mass at its tip.
namespace wavebalance::pairs {
namespace {

constexpr int points = 2048;

// `structure` with the mass of its last degree of freedom moved to its neighbour: what lets a rigid obstacle
// stop it without an impulse. Its load and contact must be there.
solvers::LinearStructure without_tip_mass(solvers::LinearStructure structure) {
  const int tip = structure.size() - 1;
  structure.mass.coeffRef(tip - 1, tip - 1) +=
      structure.mass.coeff(tip, tip) + 2.0 * structure.mass.coeff(tip, tip - 1);
  for (const auto& [row, column] : {std::pair{tip, tip}, {tip, tip - 1}, {tip - 1, tip}})
    structure.mass.coeffRef(row, column) = 0.0;
  structure.mass.prune(0.0);
  return structure;
}

struct RigidCase {
  Case scene;
  double mean_force, tolerance;  // over the load's amplitude, of other computations
};

class ForceCells : public ::testing::TestWithParam<RigidCase> {
 protected:
  static solvers::LinearStructure structure(const Case& scene) { return without_tip_mass(scene.structure()); }
  static solvers::CondensedProblem problem(const Case& scene) {
    const spectral::FourierBasis basis(1023);
    solvers::CondensedProblem result(solvers::TimePair(basis, basis, {.quadrature_points = points}),
                                     structure(scene), cosine_load());
    result.set_frequency(scene.frequency_hz);
    return result;
  }
  const Case scene_ = GetParam().scene;
  const oracle::RigidReference exact_ =
      oracle::rigid_reference(structure(scene_), scene_.gap, scene_.frequency_hz, points);
  double error(const solvers::CellResponse& response) const {
    return (response.displacement - exact_.displacement).norm() / exact_.displacement.norm();
  }
};

TEST_P(ForceCells, AreHeldToAReferenceThatRepeatsAndHasTheMeanForceOfOtherComputations) {
  ASSERT_TRUE(exact_.converged);
  EXPECT_EQ(exact_.instants.size(), 2u);
  EXPECT_LE(exact_.displacement.maxCoeff(), scene_.gap * (1.0 + 1e-12));
  EXPECT_GE(exact_.contact_force.minCoeff(), 0.0);
  EXPECT_NEAR(exact_.contact_force.mean() / 250e3, GetParam().mean_force, GetParam().tolerance);
}

TEST_P(ForceCells, KeepTheObstacleAtTheirEndsAndPushOnly) {
  auto bar = problem(scene_);
  const auto cells = solvers::uniform_cells(points, 64);
  const auto response = solvers::cell_response(bar, scene_.gap, cells);
  ASSERT_TRUE(response.converged());
  EXPECT_GE(response.cell_force.minCoeff(), 0.0);
  const double size = bar.contact_free_response().cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const int end = i + 1 < cells.size() ? cells[i + 1] : 0;
    const double opening = scene_.gap - response.displacement[end];
    EXPECT_GE(opening, -1e-9 * size);
    if (response.cell_force[static_cast<Eigen::Index>(i)] > 0.0) {
      EXPECT_LE(opening, 1e-9 * size);
    }
  }
}

// Measured over both cases: 64 uniform cells 1.6e-3 and 8e-4, 256 cells 6e-5 and 1.2e-4, adaptive cells 8e-5
// with 61 and 7e-5 with 44.
TEST_P(ForceCells, ConvergeAndNeedAQuarterOfThemWhenAdapted) {
  auto bar = problem(scene_);
  const auto coarse = solvers::cell_response(bar, scene_.gap, solvers::uniform_cells(points, 32));
  const auto fine = solvers::cell_response(bar, scene_.gap, solvers::uniform_cells(points, 128));
  ASSERT_TRUE(coarse.converged() && fine.converged());
  EXPECT_LE(4.0 * error(fine), error(coarse));  // order 1 at least over two halvings
  solvers::AdaptiveRigidOptions options;
  options.tolerance = 1e-7;
  options.max_cells = 64;
  const auto adapted = solvers::adaptive_rigid_response(bar, scene_.gap, options);
  const auto uniform = solvers::cell_response(bar, scene_.gap, solvers::uniform_cells(points, 256));
  ASSERT_TRUE(uniform.converged() && adapted.rounds.back().response.converged());
  EXPECT_LE(adapted.rounds.back().response.cells.size(), 64u);
  EXPECT_LE(error(adapted.rounds.back().response), 1.5 * error(uniform));
}

INSTANTIATE_TEST_SUITE_P(Cases, ForceCells,
                         ::testing::Values(RigidCase{cases[0], 0.0510, 0.0010},
                                           RigidCase{cases[1], 0.355, 0.004}),
                         [](const auto& instance) {
                           return instance.param.scene.frequency_hz < 1000.0 ? "case_1" : "case_2";
                         });

TEST(AdaptiveRigid, WithoutContactIsTheFreeResponse) {
  const spectral::FourierBasis basis(15);
  solvers::CondensedProblem bar(solvers::TimePair(basis, basis, {.quadrature_points = 64}),
                                cases[0].structure(), cosine_load());
  bar.set_frequency(150.0);
  const auto response = solvers::cell_response(bar, 1.0, solvers::uniform_cells(64, 8));
  ASSERT_TRUE(response.converged());
  EXPECT_TRUE(response.displacement.isApprox(bar.contact_free_response(), 0.0));
}

TEST(AdaptiveRigid, NamesWhatDoesNotFit) {
  const spectral::FourierBasis basis(15);
  solvers::CondensedProblem bar(solvers::TimePair(basis, basis, {.quadrature_points = 64}),
                                cases[0].structure(), cosine_load());
  bar.set_frequency(150.0);
  EXPECT_THROW(solvers::cell_response(bar, INFINITY, {0}), std::invalid_argument);
  EXPECT_THROW(solvers::cell_response(bar, 1e-3, {}), std::invalid_argument);
  EXPECT_THROW(solvers::cell_response(bar, 1e-3, {1}), std::invalid_argument);
  EXPECT_THROW(solvers::cell_response(bar, 1e-3, {0, 8, 8}), std::invalid_argument);
  EXPECT_THROW(solvers::cell_response(bar, 1e-3, {0, 64}), std::invalid_argument);
  EXPECT_THROW(solvers::uniform_cells(64, 7), std::invalid_argument);
  auto touching_twice = cases[0].structure();
  touching_twice.contact_directions = solvers::contact_rows({23, 24}, touching_twice.size());
  solvers::CondensedProblem twice(solvers::TimePair(basis, basis, {.quadrature_points = 64}), touching_twice,
                                  cosine_load());
  twice.set_frequency(150.0);
  EXPECT_THROW(solvers::cell_response(twice, 1e-3, {0}), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::pairs

#include "block_lanczos.hpp"
#include "blade_of.hpp"

#include "dense_algebra.hpp"
#include "sparse_product.hpp"
#include "testing.hpp"
#include "wavebalance/fem/blade.hpp"
#include "wavebalance/fem/craig_bampton.hpp"

namespace wavebalance::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

Blade lanczos_blade() { return blade(blade_of(SolidElement::hexahedron8, 4, 2, 8)); }

/// The eigenvalues of K^-1 M, descending, by the dense solver.
Eigen::VectorXd dense_values(const Matrices& matrices) {
  return oracle::generalized_eigen(Eigen::MatrixXd(matrices.mass), Eigen::MatrixXd(matrices.stiffness))
      .values.reverse();
}

/// K v = M v / value, to a few times the rounding of K: a solve with K, by whatever factor, is exact for a
/// matrix that differs from K by so much.
void expect_equilibrium(const detail::LanczosResult& found, const Matrices& matrices) {
  const Eigen::MatrixXd scaled = found.vectors * found.values.asDiagonal();
  EXPECT_LE((matrices.stiffness * scaled - matrices.mass * found.vectors).norm(),
            16.0 * std::numeric_limits<double>::epsilon() * matrices.stiffness.norm() * scaled.norm());
}

/// Values, and vectors as the inner product of M sees them: rows without mass may hold rounding, which one
/// more application of K^-1 M removes.
void expect_eigenpairs(const detail::LanczosResult& found, const Matrices& matrices, int count) {
  ASSERT_TRUE(found.complete);
  ASSERT_EQ(found.values.size(), count);
  const Eigen::VectorXd expected = dense_values(matrices);
  const Eigen::MatrixXd momenta = matrices.mass * found.vectors;
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(count, count);
  const double rounding = 1e8 * std::numeric_limits<double>::epsilon();  // the condition of the stiffness
  EXPECT_LE((found.values - expected.head(count)).norm(), rounding * expected[0]);
  EXPECT_LE((found.vectors.transpose() * momenta - identity).norm(), 1e-11);
  const Eigen::MatrixXd images = detail::SymmetricFactor(matrices.stiffness).solve(momenta);
  const Eigen::MatrixXd rest = images - found.vectors * found.values.asDiagonal();
  const double seen = std::sqrt(rest.cwiseProduct(matrices.mass * rest).sum());
  EXPECT_LE(seen, 1e-12 * found.values[0]);
}

TEST(BlockLanczos, FindsTheEigenpairsOfTheDenseSolver) {
  const Matrices matrices = solid_matrices(lanczos_blade().model);
  const detail::SymmetricFactor factor(matrices.stiffness);
  for (const int count : {1, 2, 7, 40}) {
    const auto found = detail::block_lanczos(factor, matrices.mass, count, {});
    expect_eigenpairs(found, matrices, count);
    expect_equilibrium(found, matrices);
  }
}

// A basis of 24 vectors is filled many times before 12 pairs as close as these have converged.
TEST(BlockLanczos, RestartsUntilCloseEigenvaluesHaveConverged) {
  constexpr int size = 3000, count = 6;
  Matrices matrices;
  matrices.mass.resize(size, size);
  matrices.mass.setIdentity();
  matrices.stiffness = matrices.mass;
  for (int i = 0; i < size; ++i) matrices.stiffness.coeffRef(i, i) = 1.0 + 1e-3 * i;
  const detail::SymmetricFactor factor(matrices.stiffness);
  EXPECT_FALSE(detail::block_lanczos(factor, matrices.mass, count, {.max_cycles = 3}).complete);
  const auto found = detail::block_lanczos(factor, matrices.mass, count, {});
  ASSERT_TRUE(found.complete);
  for (int i = 0; i < count; ++i) EXPECT_NEAR(found.values[i], 1.0 / (1.0 + 1e-3 * i), 1e-13) << i;
}

// A block that projection turned by 1e-9 left as much in the next one: an error of 4e-11 in this vector.
TEST(BlockLanczos, VectorsOfAChainWithALightAndStiffMassAreExact) {
  Matrices chain;
  chain.stiffness = Eigen::MatrixXd{
      {590747.0, -33145.0, 0.0, 0.0},
      {-33145.0, 258940.0, -225795.0, 0.0},
      {0.0, -225795.0, 310522.0, -84727.0},
      {0.0, 0.0, -84727.0,
       84727.0}}.sparseView();
  chain.mass = Eigen::MatrixXd(Eigen::Vector4d(0.1, 1.2112, 6.4623, 2.0649).asDiagonal()).sparseView();
  const detail::SymmetricFactor factor(chain.stiffness);
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto found = detail::block_lanczos(factor, chain.mass, 1, {1e-14, 1000, seed});
    ASSERT_TRUE(found.complete);
    const Eigen::VectorXd rest =
        factor.solve(chain.mass * found.vectors) - found.values[0] * found.vectors.col(0);
    EXPECT_LE(std::sqrt(rest.dot(chain.mass * rest)), 1e-13 * found.values[0]) << seed;
  }
}

// Two thirds of the unknowns have no mass, and the basis ends with the rank of the mass.
TEST(BlockLanczos, EndsWithTheRankOfTheMass) {
  Matrices matrices = solid_matrices(lanczos_blade().model);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < 30; ++i) entries.emplace_back(9 * i, 9 * i, 1.0 + i);
  matrices.mass.setZero();
  matrices.mass.setFromTriplets(entries.begin(), entries.end());
  const detail::SymmetricFactor factor(matrices.stiffness);
  auto all = detail::block_lanczos(factor, matrices.mass, 30, {});
  expect_eigenpairs(all, matrices, 30);
  all.vectors = factor.solve(matrices.mass * all.vectors) * all.values.cwiseInverse().asDiagonal();
  expect_equilibrium(all, matrices);
  const auto found = detail::block_lanczos(factor, matrices.mass, 31, {});
  EXPECT_FALSE(found.complete);
  EXPECT_EQ(found.values.size(), 30);
}

TEST(BlockLanczos, FindsAllCopiesOfAnEigenvalueThatABlockHolds) {
  constexpr int size = 400;
  Sparse stiffness(size, size), mass(size, size);
  mass.setIdentity();
  for (int i = 0; i < size; ++i) stiffness.insert(i, i) = 1.0 + i / 3;
  const auto found = detail::block_lanczos(detail::SymmetricFactor(stiffness), mass, 30, {});
  ASSERT_TRUE(found.complete);
  for (int i = 0; i < 30; ++i) EXPECT_NEAR(found.values[i], 1.0 / (1 + i / 3), 1e-13) << i;
}

TEST(SparseProduct, EqualsThePlainProducts) {
  const Sparse mass = solid_matrices(lanczos_blade().model).mass;
  for (const int columns : {1, 8, 37}) {
    const Eigen::MatrixXd right = Eigen::MatrixXd::Random(mass.rows(), columns);
    const Eigen::MatrixXd plain = mass * right, projected = right.transpose() * plain;
    EXPECT_LE((detail::symmetric_product(mass, right) - plain).norm(), 1e-14 * plain.norm());
    EXPECT_LE((detail::projection(mass, right) - projected).norm(),
              1e-14 * mass.norm() * right.squaredNorm());
    EXPECT_EQ(detail::projection(mass, right), detail::projection(mass, right).transpose());
  }
}

TEST(CraigBamptonProgress, RisesToTheEndAndChangesNoDigit) {
  const Blade whole = lanczos_blade();
  const Matrices matrices = solid_matrices(whole.model);
  std::vector<double> shares;
  std::vector<std::string> phases;
  CraigBamptonOptions options;
  options.modes = 20;
  const CraigBampton silent = craig_bampton(matrices, whole.boundary_unknowns, options);
  options.observer = [&](std::string_view phase, double done) {
    shares.push_back(done);
    if (phases.empty() || phases.back() != phase) phases.emplace_back(phase);
    return true;
  };
  const CraigBampton reduced = craig_bampton(matrices, whole.boundary_unknowns, options);
  EXPECT_EQ(reduced.status, EigenmodesStatus::converged);
  EXPECT_EQ(reduced.stiffness, silent.stiffness);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_GE(shares.front(), 0.0);
  EXPECT_LE(shares.back(), 1.0);
  EXPECT_EQ(phases, (std::vector<std::string>{"factorising the stiffness", "constraint modes", "modes",
                                              "refining and counting the modes", "projecting the matrices"}));
}

TEST(CraigBamptonProgress, CancelsBetweenAnyTwoSteps) {
  const Blade whole = lanczos_blade();
  const Matrices matrices = solid_matrices(whole.model);
  int calls = 0, last = 1000;
  CraigBamptonOptions options;
  options.modes = 20;
  options.observer = [&](std::string_view, double) { return ++calls < last; };
  ASSERT_EQ(craig_bampton(matrices, whole.boundary_unknowns, options).status, EigenmodesStatus::converged);
  const int all = calls;
  for (last = 1; last <= all; ++last) {
    calls = 0;
    EXPECT_EQ(craig_bampton(matrices, whole.boundary_unknowns, options).status, EigenmodesStatus::cancelled);
    EXPECT_EQ(calls, last);
  }
}

}  // namespace
}  // namespace wavebalance::fem

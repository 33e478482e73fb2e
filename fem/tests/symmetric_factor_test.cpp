#include "symmetric_factor.hpp"
#include "blade_of.hpp"

#include <thread>

#include "dense_algebra.hpp"
#include "testing.hpp"
#include "wavebalance/fem/blade.hpp"
#include "wavebalance/fem/static_displacements.hpp"

namespace wavebalance::fem {
namespace {

using detail::inertia;
using detail::SymmetricFactor;
using Sparse = Eigen::SparseMatrix<double>;

Matrices small_blade() { return solid_matrices(blade(blade_of(SolidElement::hexahedron8, 4, 2, 6)).model); }

/// A symmetric matrix of random entries, about four off the diagonal in each row.
Sparse random_matrix(int size, unsigned seed) {
  std::mt19937 generator(seed);
  const auto uniform = [&] { return 2.0 * static_cast<double>(generator()) / std::mt19937::max() - 1.0; };
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < size; ++i) {
    entries.emplace_back(i, i, 2.0 * uniform());
    for (int k = 0; k < 2; ++k) {
      const int j = static_cast<int>(generator() % static_cast<unsigned>(size));
      const double value = uniform();
      entries.emplace_back(i, j, value);
      entries.emplace_back(j, i, value);
    }
  }
  Sparse matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEST(Inertia, CountsTheModesBelowAnyShift) {
  const auto [mass, damping, stiffness] = small_blade();
  const Eigen::VectorXd squares =
      oracle::generalized_eigen(Eigen::MatrixXd(stiffness), Eigen::MatrixXd(mass)).values;
  EXPECT_EQ(inertia(stiffness).negative, 0);
  for (const Eigen::Index below : {1, 2, 7, 40, 150, 269}) {
    const auto found = inertia(stiffness - 0.5 * (squares[below - 1] + squares[below]) * mass);
    EXPECT_TRUE(found.complete);
    EXPECT_EQ(found.negative, below);
    EXPECT_LT(found.smallest, 0.0);
  }
  EXPECT_EQ(inertia(stiffness - 2.0 * squares.tail(1)[0] * mass).negative, squares.size());
}

TEST(Inertia, CountsTheNegativeEigenvaluesOfRandomIndefiniteMatrices) {
  for (unsigned seed = 0; seed < 40; ++seed) {
    const Sparse matrix = random_matrix(3 + 7 * static_cast<int>(seed), seed);
    const Eigen::VectorXd values = oracle::symmetric_eigenvalues(Eigen::MatrixXd(matrix));
    const auto found = inertia(matrix);
    EXPECT_TRUE(found.complete);
    EXPECT_EQ(found.negative, (values.array() < 0.0).count()) << seed;
  }
}

TEST(Inertia, SaysWhenAPivotIsZero) {
  Sparse zero(3, 3);
  EXPECT_FALSE(inertia(zero).complete);
  zero.insert(0, 1) = zero.insert(1, 0) = 1.0;  // indefinite with a zero diagonal
  EXPECT_FALSE(inertia(zero).complete);
}

TEST(SymmetricFactor, SolvesWithManyColumnsAndFromSeveralThreads) {
  const Sparse stiffness = small_blade().stiffness;
  const SymmetricFactor factor(stiffness);
  ASSERT_TRUE(factor.positive_definite());
  const Eigen::MatrixXd exact = Eigen::MatrixXd::Random(stiffness.rows(), 150);
  const Eigen::MatrixXd right = stiffness * exact;
  const double bound =
      1e8 * std::numeric_limits<double>::epsilon() * exact.norm();  // the condition of the stiffness
  EXPECT_LT((factor.solve(right) - exact).norm(), bound);
  EXPECT_EQ(static_displacements(stiffness, right), factor.solve(right));
  std::vector<Eigen::MatrixXd> found(4);
  std::vector<std::thread> threads;
  for (auto& one : found) threads.emplace_back([&] { one = factor.solve(right); });
  for (auto& thread : threads) thread.join();
  for (const auto& one : found) EXPECT_EQ(one, found[0]);
}

TEST(SymmetricFactor, SaysWhetherAMatrixIsPositiveDefinite) {
  const auto [mass, damping, stiffness] = small_blade();
  EXPECT_TRUE(SymmetricFactor(mass).positive_definite());
  EXPECT_FALSE(SymmetricFactor(stiffness - 1e12 * mass).positive_definite());
  EXPECT_FALSE(SymmetricFactor(-stiffness).positive_definite());
  EXPECT_FALSE(SymmetricFactor(Sparse(3, 3)).positive_definite());
  Sparse diagonal(3, 3);
  for (int i = 0; i < 3; ++i) diagonal.insert(i, i) = 3.0 - i;
  EXPECT_DOUBLE_EQ(SymmetricFactor(diagonal).smallest_pivot(), 1.0);
  diagonal.coeffRef(1, 1) = -1e-3;
  EXPECT_FALSE(SymmetricFactor(diagonal).positive_definite());
  diagonal.coeffRef(1, 1) = 0.0;
  EXPECT_FALSE(SymmetricFactor(diagonal).positive_definite());
}

}  // namespace
}  // namespace wavebalance::fem

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>
#include <unsupported/Eigen/AutoDiff>

#include "dense_system.hpp"
#include "pairs.hpp"

// Derivatives by frequency against forward differentiation of an elimination of the assembled system.
namespace wavebalance::pairs {
namespace {

using ScalarDual = Eigen::AutoDiffScalar<Eigen::Matrix<double, 1, 1>>;
using DualMatrix = Eigen::Matrix<ScalarDual, Eigen::Dynamic, Eigen::Dynamic>;

ScalarDual constant(double value) { return ScalarDual(value, Eigen::Matrix<double, 1, 1>::Zero()); }

// G = f^2 M (x) A_2 + f C (x) A_1 + K (x) A_0 with the frequency as the variable, beside its right sides.
DualMatrix assembled(const solvers::LinearStructure& structure, const dense::InnerProductMatrices& a,
                     double frequency, const Eigen::MatrixXd& right) {
  const ScalarDual f(frequency, Eigen::Matrix<double, 1, 1>::Ones());
  const Eigen::Index n = structure.size(), m = a[0].rows();
  const Eigen::MatrixXd mass = structure.mass, damping = structure.damping, stiffness = structure.stiffness;
  DualMatrix g(n * m, n * m + right.cols());
  for (Eigen::Index row = 0; row < n * m; ++row) {
    for (Eigen::Index col = 0; col < n * m; ++col) {
      const Eigen::Index i = row / m, j = col / m, p = row % m, q = col % m;
      g(row, col) = f * f * (mass(i, j) * a[2](p, q)) + f * (damping(i, j) * a[1](p, q)) +
                    constant(stiffness(i, j) * a[0](p, q));
    }
    for (Eigen::Index col = 0; col < right.cols(); ++col) g(row, n * m + col) = constant(right(row, col));
  }
  return g;
}

// Gauss elimination with partial pivoting; the solutions stand in the last columns.
DualMatrix solve(DualMatrix g) {
  const Eigen::Index size = g.rows();
  for (Eigen::Index k = 0; k < size; ++k) {
    Eigen::Index pivot = k;
    for (Eigen::Index i = k + 1; i < size; ++i)
      if (std::abs(g(i, k).value()) > std::abs(g(pivot, k).value())) pivot = i;
    g.row(k).swap(g.row(pivot));
    for (Eigen::Index i = 0; i < size; ++i) {
      if (i == k) continue;
      const ScalarDual factor = g(i, k) / g(k, k);
      for (Eigen::Index j = k; j < g.cols(); ++j) g(i, j) -= factor * g(k, j);
    }
  }
  DualMatrix x = g.rightCols(g.cols() - size);
  for (Eigen::Index i = 0; i < size; ++i)
    for (Eigen::Index j = 0; j < x.cols(); ++j) x(i, j) /= g(i, i);
  return x;
}

TEST(FrequencySlopes, AreThoseOfADifferentiatedElimination) {
  const Case& scene = cases[1];
  const int elements = 3, functions = 8, points = 32;
  const solvers::LinearStructure structure = scene.structure(elements);
  std::mt19937 generator(5);
  std::normal_distribution<double> normal;
  const Eigen::VectorXd force = Eigen::VectorXd::NullaryExpr(points, [&] { return 1e5 * normal(generator); });
  for (const Pair& pair : table_2) {
    const auto how = options(pair, functions, points, solvers::InnerProducts::exact);
    const auto time =
        dense::discretise(basis(pair.trial, functions), basis(pair.weight, functions), how, cosine_load());
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(elements * functions, 2);
    const int first = (elements - 1) * functions;
    right.block(first, 0, functions, 1) = 250e3 * time.load;
    right.block(first, 1, functions, 1) = time.weight.transpose() * force / points;
    const DualMatrix x = solve(assembled(structure, time.products, 1100.0, right));
    Eigen::MatrixXd values(functions, 2), slopes(functions, 2);
    for (int j = 0; j < functions; ++j)
      for (int c = 0; c < 2; ++c) {
        values(j, c) = x(first + j, c).value();
        slopes(j, c) = x(first + j, c).derivatives()[0];
      }
    const Eigen::MatrixXd u = time.trial * values, rate = time.trial * slopes;

    solvers::CondensedProblem problem(time_pair(pair, functions, how), structure, cosine_load());
    problem.set_frequency(1100.0);
    Eigen::VectorXd product, product_slope;
    problem.apply(force, product);
    problem.apply_slope(force, product_slope);
    constexpr double slope_tolerance = 1e-10;
    EXPECT_LE((problem.contact_free_response() - u.col(0)).norm(), slope_tolerance * u.col(0).norm())
        << pair.name;
    EXPECT_LE((problem.contact_free_response_slope() - rate.col(0)).norm(),
              slope_tolerance * rate.col(0).norm())
        << pair.name;
    EXPECT_LE((product - u.col(1)).norm(), slope_tolerance * u.col(1).norm()) << pair.name;
    EXPECT_LE((product_slope - rate.col(1)).norm(), slope_tolerance * rate.col(1).norm()) << pair.name;
  }
}

}  // namespace
}  // namespace wavebalance::pairs

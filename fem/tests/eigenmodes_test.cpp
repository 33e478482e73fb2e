#include "wavebalance/fem/eigenmodes.hpp"

#include "testing.hpp"
#include "uniform_bar.hpp"

namespace wavebalance::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

EigenmodesResult modes_of(const BarOptions& options, int count, int dense_up_to = 200) {
  const Matrices matrices = bar(options);
  EigenmodesOptions solver{.dense_up_to = dense_up_to};
  return eigenmodes(matrices.stiffness, matrices.mass, count, solver);
}

// Both matrices twice on the diagonal: every frequency is double.
Sparse twice(const Sparse& matrix) {
  Sparse result(2 * matrix.rows(), 2 * matrix.cols());
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry)
      for (Eigen::Index shift : {Eigen::Index(0), matrix.rows()})
        result.insert(entry.row() + shift, entry.col() + shift) = entry.value();
  return result;
}

class BothSolvers : public testing::TestWithParam<int> {};  // the parameter is dense_up_to
INSTANTIATE_TEST_SUITE_P(Eigenmodes, BothSolvers, testing::Values(1000, 0),
                         [](const auto& chosen) { return chosen.param > 0 ? "dense" : "sparse"; });

// Rounding of the matrices moves omega^2 by eps times the ratio of the highest to the lowest omega^2, n^2
// here.
TEST_P(BothSolvers, GiveTheDiscreteDispersionOfTheUniformBar) {
  for (int elements : {20, 25, 100})
    for (double lumped : {0.0, 0.5, 1.0}) {
      BarOptions options{.elements = elements, .lumped_fraction = lumped};
      const EigenmodesResult found = modes_of(options, 8, GetParam());
      ASSERT_EQ(found.status, EigenmodesStatus::converged);
      ASSERT_EQ(found.omega.size(), 8);
      for (int mode = 1; mode <= 8; ++mode)
        EXPECT_NEAR(found.omega[mode - 1] / discrete_omega(options, mode), 1.0, 2 * eps * elements * elements)
            << elements << " elements, lumped " << lumped << ", mode " << mode;
    }
}

TEST_P(BothSolvers, GiveSinesAsShapes) {
  const BarOptions options;
  const EigenmodesResult found = modes_of(options, 5, GetParam());
  for (int mode = 1; mode <= 5; ++mode) {
    Eigen::VectorXd sine(options.elements);
    for (int i = 0; i < options.elements; ++i) sine[i] = std::sin(phase_per_element(options, mode) * (i + 1));
    const Eigen::VectorXd shape = found.shapes.col(mode - 1);
    const double cosine = shape.dot(sine) / (shape.norm() * sine.norm());
    EXPECT_NEAR(std::abs(cosine), 1.0, 64 * eps) << "mode " << mode;
    EXPECT_GT(shape.maxCoeff(), -shape.minCoeff() * (1 - 1e-9)) << "mode " << mode;
  }
}

TEST_P(BothSolvers, GiveMassOrthonormalShapesThatDiagonaliseTheStiffness) {
  BarOptions options{.elements = 300};
  const Matrices matrices = bar(options);
  const EigenmodesResult found = modes_of(options, 12, GetParam());
  const Eigen::MatrixXd mass = found.shapes.transpose() * (matrices.mass * found.shapes);
  EXPECT_LE((mass - Eigen::MatrixXd::Identity(12, 12)).cwiseAbs().maxCoeff(), 1e4 * eps);
  const Eigen::MatrixXd stiffness = found.shapes.transpose() * (matrices.stiffness * found.shapes);
  const Eigen::MatrixXd squares = found.omega.cwiseAbs2().asDiagonal();
  EXPECT_LE((stiffness - squares).cwiseAbs().maxCoeff(), 1e5 * eps * squares.maxCoeff());
  EXPECT_LE(found.residuals.maxCoeff(), 1e2 * eps);
  EXPECT_LE((found.frequencies_hz * 2 * std::numbers::pi - found.omega).norm(), 4 * eps * found.omega.norm());
}

TEST_P(BothSolvers, FindBothCopiesOfADoubleMode) {
  BarOptions options{.elements = 60};
  const Matrices matrices = bar(options);
  EigenmodesOptions solver{.dense_up_to = GetParam()};
  const EigenmodesResult found = eigenmodes(twice(matrices.stiffness), twice(matrices.mass), 6, solver);
  ASSERT_EQ(found.status, EigenmodesStatus::converged);
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(found.omega[i] / discrete_omega(options, i / 2 + 1), 1.0, 1e-10) << i;
}

// A coarse tolerance accepts the first copies before the others appear; the count of modes sends it back for
// them.
TEST(Eigenmodes, AreCompleteAtACoarseToleranceToo) {
  BarOptions options{.elements = 500};
  const Matrices matrices = bar(options);
  const Sparse stiffness = twice(matrices.stiffness);
  const Sparse mass = twice(matrices.mass);
  for (int count : {2, 3, 5, 8, 12}) {
    const EigenmodesResult found = eigenmodes(stiffness, mass, count, {.tolerance = 1e-2, .dense_up_to = 0});
    ASSERT_EQ(found.status, EigenmodesStatus::converged) << count;
    for (int i = 0; i < count; ++i)
      EXPECT_NEAR(found.omega[i] / discrete_omega(options, i / 2 + 1), 1.0, 1e-6) << count << " modes, " << i;
  }
}

// A free bar: its rigid translation has frequency zero, the others belong to standing waves, m pi/n an
// element.
TEST_P(BothSolvers, FindTheRigidModeOfAFreeBarWithANegativeShift) {
  const int nodes = 40;
  Sparse stiffness(nodes, nodes), mass(nodes, nodes);
  for (int i = 0; i < nodes; ++i) {
    const bool end = i == 0 || i == nodes - 1;
    stiffness.insert(i, i) = end ? 1.0 : 2.0;
    mass.insert(i, i) = end ? 0.5 : 1.0;
    if (i + 1 < nodes) stiffness.insert(i, i + 1) = stiffness.insert(i + 1, i) = -1.0;
  }
  EigenmodesOptions solver{.dense_up_to = GetParam()};
  EXPECT_THROW(eigenmodes(stiffness, mass, 3, solver), std::domain_error);
  solver.shift = -0.01;
  const EigenmodesResult found = eigenmodes(stiffness, mass, 3, solver);
  ASSERT_EQ(found.status, EigenmodesStatus::converged);
  EXPECT_LE(found.omega[0], 1e-7);
  for (int mode = 1; mode < 3; ++mode)
    EXPECT_NEAR(found.omega[mode], 2 * std::sin(mode * std::numbers::pi / (2 * (nodes - 1))), 1e-11);
}

TEST_P(BothSolvers, AllowNodesWithoutMass) {
  BarOptions options{.elements = 60};
  Matrices matrices = bar(options);
  options.lumped_fraction = 1.0;
  matrices.mass = bar(options).mass;
  for (int i = 0; i < 60; i += 2) matrices.mass.coeffRef(i, i) = 0.0;  // statically between their neighbours
  for (int i = 1; i < 60; i += 2) matrices.mass.coeffRef(i, i) *= 2.0;
  EigenmodesOptions solver{.dense_up_to = GetParam()};
  const EigenmodesResult found = eigenmodes(matrices.stiffness, matrices.mass, 4, solver);
  options.elements = 30;  // the same chain of every second node
  for (int mode = 1; mode <= 4; ++mode)
    EXPECT_NEAR(found.omega[mode - 1] / discrete_omega(options, mode), 1.0, 1e-10) << mode;
}

TEST(Eigenmodes, FitABarOfOneHundredThousandElements) {
  BarOptions options{.elements = 100'000};
  const EigenmodesResult found = modes_of(options, 3);
  ASSERT_EQ(found.status, EigenmodesStatus::converged);
  for (int mode = 1; mode <= 3; ++mode)
    EXPECT_NEAR(found.omega[mode - 1] / discrete_omega(options, mode), 1.0, 2e-8) << mode;
}

TEST(Eigenmodes, GiveAllModesOfASmallStructure) {
  const BarOptions options;
  const EigenmodesResult found = modes_of(options, options.elements);
  ASSERT_EQ(found.omega.size(), options.elements);
  for (int mode = 1; mode <= options.elements; ++mode)
    EXPECT_NEAR(found.omega[mode - 1] / discrete_omega(options, mode), 1.0, 1e-11) << mode;
}

// A bar of 60 elements whose stiffness grows by 1e10 from end to end.
TEST(Eigenmodes, OfAWideSpectrumAreOrthogonalAtItsUpperEndToo) {
  constexpr int size = 60;
  Sparse stiffness(size, size), mass(size, size);
  for (int i = 0; i < size; ++i) {
    const double spring = std::pow(10.0, 10.0 * i / (size - 1));
    stiffness.coeffRef(i, i) += spring;
    if (i > 0) {
      stiffness.coeffRef(i - 1, i - 1) += spring;
      stiffness.coeffRef(i, i - 1) = stiffness.coeffRef(i - 1, i) = -spring;
    }
    mass.insert(i, i) = 1.0;
  }
  const EigenmodesResult modes = eigenmodes(stiffness, mass, size);
  EXPECT_GT(modes.omega[size - 1], 1e5 * modes.omega[0]);
  const Eigen::MatrixXd products = modes.shapes.transpose() * mass * modes.shapes;
  EXPECT_LT((products - Eigen::MatrixXd::Identity(size, size)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Eigenmodes, SayWhenTheIterationEndedEarly) {
  BarOptions options{.elements = 5000};
  const Matrices matrices = bar(options);
  EigenmodesOptions solver{.max_restarts = 1};
  solver.tolerance = 1e-15;
  const EigenmodesResult found = eigenmodes(matrices.stiffness, matrices.mass, 9, solver);
  EXPECT_EQ(found.status, EigenmodesStatus::not_converged);
  EXPECT_LT(found.omega.size(), 9);
  EXPECT_EQ(found.shapes.cols(), found.omega.size());
}

TEST(Eigenmodes, RejectWhatTheyCannotSolve) {
  const Matrices matrices = bar(BarOptions{});
  const auto solve = [&](int count, EigenmodesOptions options = {}) {
    return eigenmodes(matrices.stiffness, matrices.mass, count, options);
  };
  EXPECT_THROW(solve(0), std::invalid_argument);
  EXPECT_THROW(solve(26), std::invalid_argument);
  EXPECT_THROW(solve(1, {.tolerance = 0.0}), std::invalid_argument);
  EXPECT_THROW(solve(1, {.max_restarts = 0}), std::invalid_argument);
  EXPECT_THROW(solve(1, {.dense_up_to = -1}), std::invalid_argument);
  EXPECT_THROW(solve(1, {.shift = 1.0}), std::invalid_argument);
  EXPECT_THROW(eigenmodes(Sparse(), Sparse(), 1), std::invalid_argument);
  EXPECT_THROW(eigenmodes(matrices.stiffness, Sparse(3, 3), 1), std::invalid_argument);
  EXPECT_THROW(eigenmodes(matrices.stiffness, Sparse(25, 25), 1), std::domain_error);
  EXPECT_THROW(eigenmodes(matrices.stiffness, Sparse(-matrices.mass), 1), std::domain_error);
  const Sparse upper = matrices.stiffness.triangularView<Eigen::Upper>();
  EXPECT_THROW(eigenmodes(upper, matrices.mass, 1), std::invalid_argument);
  Sparse broken = matrices.stiffness;
  broken.coeffRef(3, 3) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(eigenmodes(broken, matrices.mass, 1), std::invalid_argument);
}

TEST(Eigenmodes, RejectAnEmptyMassInTheSparseSolverToo) {
  const Matrices matrices = bar(BarOptions{});
  EXPECT_THROW(eigenmodes(matrices.stiffness, Sparse(25, 25), 1, {.dense_up_to = 0}), std::domain_error);
}

}  // namespace
}  // namespace wavebalance::fem

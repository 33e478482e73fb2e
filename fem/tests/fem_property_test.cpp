#include <rapidcheck/gtest.h>

#include "dense_algebra.hpp"
#include "random_values.hpp"
#include "testing.hpp"
#include "uniform_bar.hpp"
#include "wavebalance/fem/eigenmodes.hpp"

namespace wavebalance::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

// A chain of any springs and masses, the first spring on the ground, with both ratios up to 100.
Matrices any_chain(int size) {
  Matrices chain{Sparse(size, size), Sparse(size, size), Sparse(size, size)};
  for (int i = 0; i < size; ++i) {
    const double spring = std::pow(10.0, any_between(4, 6));
    chain.mass.insert(i, i) = std::pow(10.0, any_between(-1, 1));
    chain.stiffness.coeffRef(i, i) += spring;
    if (i == 0) continue;
    chain.stiffness.coeffRef(i - 1, i - 1) += spring;
    chain.stiffness.coeffRef(i, i - 1) = chain.stiffness.coeffRef(i - 1, i) = -spring;
  }
  return chain;
}

RC_GTEST_PROP(EigenmodesProperty, DenseAndSparseAgreeWithTheStandardProblem, ()) {
  const int size = *rc::gen::inRange(3, 60);
  const int count = *rc::gen::inRange(1, (size + 1) / 2);
  const Matrices chain = any_chain(size);
  const Eigen::VectorXd root = Eigen::VectorXd(chain.mass.diagonal()).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd standard = root.asDiagonal() * Eigen::MatrixXd(chain.stiffness) * root.asDiagonal();
  const Eigen::VectorXd expected = oracle::symmetric_eigenvalues(standard);
  const double rounding = 1e-13 * expected[size - 1];
  for (int dense_up_to : {0, 1000}) {
    const EigenmodesResult found =
        eigenmodes(chain.stiffness, chain.mass, count, {.dense_up_to = dense_up_to});
    RC_ASSERT(found.status == EigenmodesStatus::converged);
    for (int i = 0; i < count; ++i)
      RC_ASSERT(std::abs(found.omega[i] * found.omega[i] - expected[i]) <= rounding + 1e-11 * expected[i]);
    // Both solvers iterate on 1/omega^2, so rounding is relative to the lowest mode.
    const Eigen::VectorXd ratios = found.omega.cwiseAbs2() / (found.omega[0] * found.omega[0]);
    RC_ASSERT((found.residuals.array() <= 1e-13 + 4e-15 * ratios.array()).all());
  }
}

RC_GTEST_PROP(BarProperty, FrequenciesScaleWithTheWaveSpeedOverTheLength, ()) {
  BarOptions options{.elements = *rc::gen::inRange(2, 40), .lumped_fraction = any_between(0, 1)};
  options.youngs_modulus = std::pow(10.0, any_between(-6, 13));
  options.density = std::pow(10.0, any_between(-6, 5));
  options.area = std::pow(10.0, any_between(-9, 6));
  options.length = std::pow(10.0, any_between(-6, 4));
  const Matrices matrices = bar(options);
  const EigenmodesResult found = eigenmodes(matrices.stiffness, matrices.mass, 2);
  for (int mode : {1, 2})
    RC_ASSERT(std::abs(found.omega[mode - 1] / discrete_omega(options, mode) - 1.0) <= 1e-12);
}

}  // namespace
}  // namespace wavebalance::fem

#include "wavebalance/solvers/structure/rigid_modes.hpp"

#include <random>
#include <stdexcept>
#include <string>

#include "linalg/dense.hpp"
#include "linalg/sparse.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::solvers {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

[[noreturn]] void fail(const std::string& what) { throw std::invalid_argument("find_rigid_modes: " + what); }

detail::SymmetricEigen modes_of(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass) {
  auto modes = detail::symmetric_eigen(stiffness, mass);
  if (!modes) fail("the mass is not positive definite");
  return *std::move(modes);
}

// The lowest modes by inverse iteration on a subspace of K + shift M.
detail::SymmetricEigen lowest_modes(const Sparse& mass, const Sparse& stiffness, double shift) {
  constexpr int vectors = 12, iterations = 20;
  const detail::PositiveFactor factor(stiffness + shift * mass);
  if (!factor.exists()) fail("the stiffness has a negative eigenvalue");
  std::minstd_rand generator(1);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd basis =
      Eigen::MatrixXd::NullaryExpr(mass.rows(), vectors, [&](auto, auto) { return normal(generator); });
  detail::SymmetricEigen modes;
  for (int i = 0; i < iterations; ++i) {
    const Eigen::MatrixXd next = factor.solve(Eigen::MatrixXd(mass * basis));
    modes = modes_of(detail::transposed_product(next, stiffness * next),
                     detail::transposed_product(next, mass * next));
    basis = detail::product(next, modes.vectors);
  }
  modes.vectors = std::move(basis);
  return modes;
}

}  // namespace

Eigen::MatrixXd find_rigid_modes(const Sparse& mass, const Sparse& stiffness, double tolerance) {
  constexpr Eigen::Index most_dense = 1000;
  if (mass.rows() != stiffness.rows() || mass.cols() != mass.rows() || stiffness.cols() != stiffness.rows())
    fail("mass and stiffness must be square and of one size");
  if (!is_symmetric(stiffness)) fail("the stiffness is not symmetric");
  const Eigen::VectorXd masses = mass.diagonal();
  if (!(masses.array() > 0.0).all()) fail("the mass is not positive definite");
  const double largest = (stiffness.diagonal().array() / masses.array()).abs().maxCoeff();
  const detail::SymmetricEigen modes = mass.rows() <= most_dense
                                           ? modes_of(Eigen::MatrixXd(stiffness), Eigen::MatrixXd(mass))
                                           : lowest_modes(mass, stiffness, 100.0 * tolerance * largest);
  const double zero = tolerance * largest;
  if (modes.values.size() > 0 && modes.values[0] < -zero) fail("the stiffness has a negative eigenvalue");
  return modes.vectors.leftCols((modes.values.array() <= zero).count());
}

}  // namespace wavebalance::solvers

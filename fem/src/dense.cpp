// The dense factorizations of the module, compiled once.
#include "dense.hpp"

#include <Eigen/Eigenvalues>

namespace wavebalance::fem::detail {

std::optional<GeneralizedEigen> generalized_eigen(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  if (Eigen::LLT<Eigen::MatrixXd>(b).info() != Eigen::Success) return std::nullopt;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(a, b);
  return GeneralizedEigen{solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::MatrixXd cholesky_solve(const Eigen::MatrixXd& b, const Eigen::MatrixXd& right) {
  return Eigen::LLT<Eigen::MatrixXd>(b).solve(right);
}

Eigen::MatrixXd product(const ConstMatrix& a, const ConstMatrix& b) { return a * b; }

Eigen::MatrixXd transposed_product(const ConstMatrix& a, const ConstMatrix& b) { return a.transpose() * b; }

Eigen::MatrixXd product_transposed(const ConstMatrix& a, const ConstMatrix& b) { return a * b.transpose(); }

}  // namespace wavebalance::fem::detail

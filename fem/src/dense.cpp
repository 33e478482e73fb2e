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

}  // namespace wavebalance::fem::detail

#include "dense_algebra.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <unsupported/Eigen/MatrixFunctions>

namespace wavebalance::oracle {

Eigen::MatrixXd solve(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right) {
  return matrix.partialPivLu().solve(right);
}

Eigen::VectorXd solve(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right) {
  return matrix.partialPivLu().solve(right);
}

Eigen::VectorXcd solve(const Eigen::MatrixXcd& matrix, const Eigen::VectorXcd& right) {
  return matrix.partialPivLu().solve(right);
}

LongComplexMatrix solve(const LongComplexMatrix& matrix, const LongComplexMatrix& right) {
  return matrix.partialPivLu().solve(right);
}

Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix) { return matrix.inverse(); }

Eigen::MatrixXcd inverse(const Eigen::MatrixXcd& matrix) { return matrix.inverse(); }

LongComplexMatrix inverse(const LongComplexMatrix& matrix) {
  return solve(matrix, LongComplexMatrix::Identity(matrix.rows(), matrix.cols()));
}

double determinant(const Eigen::MatrixXd& matrix) { return matrix.determinant(); }

Eigen::MatrixXd exponential(const Eigen::MatrixXd& matrix) { return matrix.exp(); }

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix) { return matrix.eigenvalues(); }

Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix) {
  return matrix.selfadjointView<Eigen::Lower>().eigenvalues();
}

GeneralizedEigen generalized_eigen(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(stiffness, mass);
  return {modes.eigenvalues(), modes.eigenvectors()};
}

bool is_positive_definite(const Eigen::MatrixXd& matrix) { return matrix.llt().info() == Eigen::Success; }

Eigen::MatrixXd solve_positive_definite(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right) {
  return matrix.llt().solve(right);
}

Eigen::MatrixXd orthonormal_factor(const Eigen::MatrixXd& matrix) {
  return Eigen::HouseholderQR<Eigen::MatrixXd>(matrix).householderQ();
}

double spectral_norm(const Eigen::MatrixXd& matrix) { return matrix.operatorNorm(); }

}  // namespace wavebalance::oracle

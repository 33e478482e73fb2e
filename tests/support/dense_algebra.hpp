#pragma once
#include <Eigen/Core>
#include <complex>

/// Factorizations and eigenvalues by Eigen, as references of tests, compiled once: each of Eigen's
/// templates for them needs seconds in every source that includes them. The solvers use LAPACK.
namespace wavebalance::oracle {

using LongComplexMatrix = Eigen::Matrix<std::complex<long double>, Eigen::Dynamic, Eigen::Dynamic>;

/// A^-1 right by elimination with partial pivoting. O(n^3).
Eigen::MatrixXd solve(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);
Eigen::VectorXd solve(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& right);
Eigen::VectorXcd solve(const Eigen::MatrixXcd& matrix, const Eigen::VectorXcd& right);
LongComplexMatrix solve(const LongComplexMatrix& matrix, const LongComplexMatrix& right);

/// A^-1 by elimination with partial pivoting. O(n^3).
Eigen::MatrixXd inverse(const Eigen::MatrixXd& matrix);
Eigen::MatrixXcd inverse(const Eigen::MatrixXcd& matrix);
LongComplexMatrix inverse(const LongComplexMatrix& matrix);

double determinant(const Eigen::MatrixXd& matrix);

/// exp(A). O(n^3).
Eigen::MatrixXd exponential(const Eigen::MatrixXd& matrix);

/// The eigenvalues of a square matrix, in no order. O(n^3).
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix);

/// The eigenvalues of a symmetric matrix, ascending. O(n^3).
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& matrix);

/// K x = value M x with M positive definite: ascending values, and vectors with x^T M x = 1. O(n^3).
struct GeneralizedEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};
GeneralizedEigen generalized_eigen(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& mass);

/// Whether A has a Cholesky factor, and A^-1 right by it. O(n^3).
bool is_positive_definite(const Eigen::MatrixXd& matrix);
Eigen::MatrixXd solve_positive_definite(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right);

/// The orthonormal factor Q of A = Q R. O(n^3).
Eigen::MatrixXd orthonormal_factor(const Eigen::MatrixXd& matrix);

/// The largest singular value. O(n^3).
double spectral_norm(const Eigen::MatrixXd& matrix);

}  // namespace wavebalance::oracle

#pragma once
#include <Eigen/Core>
#include <optional>

namespace wavebalance::fem::detail {

/// A v = mu B v with V^T B V = I; mu ascending.
struct GeneralizedEigen {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

/// All eigenpairs of symmetric A and symmetric positive definite B, both n x n. Empty if B is not positive
/// definite. O(n^3).
std::optional<GeneralizedEigen> generalized_eigen(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// B^-1 right for a symmetric positive definite B. O(n^3).
Eigen::MatrixXd cholesky_solve(const Eigen::MatrixXd& b, const Eigen::MatrixXd& right);

/// A B, A^T B and A B^T of any sizes, compiled once. O(n^3).
using ConstMatrix = Eigen::Ref<const Eigen::MatrixXd>;
Eigen::MatrixXd product(const ConstMatrix& a, const ConstMatrix& b);
Eigen::MatrixXd transposed_product(const ConstMatrix& a, const ConstMatrix& b);
Eigen::MatrixXd product_transposed(const ConstMatrix& a, const ConstMatrix& b);

}  // namespace wavebalance::fem::detail

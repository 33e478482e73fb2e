#pragma once
#include <Eigen/SparseCore>
#include <memory>

namespace wavebalance::solvers::detail {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// A = L D L^T of a symmetric positive definite sparse matrix. Fill of the factor, O(fill) per solution.
class PositiveFactor {
 public:
  explicit PositiveFactor(const SparseMatrix& matrix);
  ~PositiveFactor();

  /// Whether the matrix was positive definite; without it there are no solutions.
  bool exists() const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

/// The LU factors of a sparse matrix that is not singular.
class SparseLu {
 public:
  explicit SparseLu(const SparseMatrix& matrix);
  ~SparseLu();

  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;
  Eigen::MatrixXd solve_transposed(const Eigen::MatrixXd& right);

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace wavebalance::solvers::detail

#include <gsl/gsl_eigen.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <limits>
#include <memory>

#include "linalg/dense.hpp"
#include "linalg/gsl_errors.hpp"

namespace wavebalance::solvers::detail {

std::optional<Eigen::MatrixXd> cholesky(const Eigen::MatrixXd& matrix) {
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
  if (factor.info() != Eigen::Success) return std::nullopt;
  return factor.matrixL();
}

Eigen::MatrixXd solve_lower(const Eigen::MatrixXd& lower, const Eigen::MatrixXd& right) {
  return lower.triangularView<Eigen::Lower>().solve(right);
}

Eigen::MatrixXd solve_lower_transposed(const Eigen::MatrixXd& lower, const Eigen::MatrixXd& right) {
  return lower.transpose().triangularView<Eigen::Upper>().solve(right);
}

std::optional<SymmetricEigen> symmetric_eigen(const Eigen::MatrixXd& matrix) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(matrix);
  if (solver.info() != Eigen::Success) return std::nullopt;
  return SymmetricEigen{solver.eigenvalues(), solver.eigenvectors()};
}

std::optional<SymmetricEigen> symmetric_eigen(const Eigen::MatrixXd& matrix, const Eigen::MatrixXd& metric) {
  const auto lower = cholesky(metric);
  if (!lower) return std::nullopt;
  auto result = symmetric_eigen(solve_lower(*lower, solve_lower(*lower, matrix).transpose()));
  if (!result) return std::nullopt;
  result->vectors = solve_lower_transposed(*lower, result->vectors);
  if (!result->vectors.allFinite()) return std::nullopt;
  return result;
}

// By GSL, whose compiled QR iteration takes no time to compile here.
Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& matrix) {
  const auto size = static_cast<std::size_t>(matrix.rows());
  Eigen::VectorXcd values =
      Eigen::VectorXcd::Constant(matrix.rows(), std::numeric_limits<double>::quiet_NaN());
  if (size == 0 || !matrix.allFinite()) return values;
  const SilencedGslErrors silenced;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> copy = matrix;
  const std::unique_ptr<gsl_eigen_nonsymm_workspace, void (*)(gsl_eigen_nonsymm_workspace*)> workspace(
      gsl_eigen_nonsymm_alloc(size), gsl_eigen_nonsymm_free);
  gsl_eigen_nonsymm_params(0, 1, workspace.get());  // eigenvalues alone, of the balanced matrix
  gsl_matrix_view matrix_view = gsl_matrix_view_array(copy.data(), size, size);
  gsl_vector_complex_view values_view =
      gsl_vector_complex_view_array(reinterpret_cast<double*>(values.data()), size);
  if (gsl_eigen_nonsymm(&matrix_view.matrix, &values_view.vector, workspace.get()) != GSL_SUCCESS)
    values.setConstant(std::numeric_limits<double>::quiet_NaN());
  return values;
}

}  // namespace wavebalance::solvers::detail

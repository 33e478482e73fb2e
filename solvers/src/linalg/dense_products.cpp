#include <unsupported/Eigen/MatrixFunctions>

#include "linalg/dense.hpp"
#include "linalg/lapack.hpp"

namespace wavebalance::solvers::detail {
namespace {

Eigen::MatrixXd multiply(const Eigen::MatrixXd& a, CBLAS_TRANSPOSE left, const Eigen::MatrixXd& b,
                         CBLAS_TRANSPOSE right) {
  const Eigen::Index rows = left == CblasTrans ? a.cols() : a.rows();
  const Eigen::Index columns = right == CblasTrans ? b.rows() : b.cols();
  const Eigen::Index inner = left == CblasTrans ? a.rows() : a.cols();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows, columns);
  if (result.size() > 0 && inner > 0)
    cblas_dgemm(CblasColMajor, left, right, lapack_size(rows), lapack_size(columns), lapack_size(inner), 1.0,
                a.data(), lapack_size(a.rows()), b.data(), lapack_size(b.rows()), 0.0, result.data(),
                lapack_size(rows));
  return result;
}

}  // namespace

Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return multiply(a, CblasNoTrans, b, CblasNoTrans);
}

Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return multiply(a, CblasTrans, b, CblasNoTrans);
}

Eigen::MatrixXd product_transposed(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return multiply(a, CblasNoTrans, b, CblasTrans);
}

Eigen::MatrixXd exponential(const Eigen::MatrixXd& matrix) { return matrix.exp(); }

}  // namespace wavebalance::solvers::detail

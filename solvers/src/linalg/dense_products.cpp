#include <algorithm>
#include <unsupported/Eigen/MatrixFunctions>

#include "linalg/dense.hpp"
#include "linalg/lapack.hpp"

namespace wavebalance::solvers::detail {
namespace {

Eigen::MatrixXd multiply(const Eigen::MatrixXd& a, bool a_transposed, const Eigen::MatrixXd& b,
                         bool b_transposed) {
  const lapack_int rows = lapack_size(a_transposed ? a.cols() : a.rows());
  const lapack_int columns = lapack_size(b_transposed ? b.rows() : b.cols());
  const lapack_int inner = lapack_size(a_transposed ? a.rows() : a.cols());
  const lapack_int a_stride = lapack_size(a.rows()), b_stride = lapack_size(b.rows());
  const double one = 1.0, zero = 0.0;
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(rows, columns);
  if (result.size() > 0 && inner > 0)
    dgemm_(a_transposed ? "T" : "N", b_transposed ? "T" : "N", &rows, &columns, &inner, &one, a.data(),
           &a_stride, b.data(), &b_stride, &zero, result.data(), &rows);
  return result;
}

}  // namespace

Eigen::MatrixXd product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return multiply(a, false, b, false);
}

Eigen::MatrixXd transposed_product(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return multiply(a, true, b, false);
}

Eigen::MatrixXd product_transposed(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return multiply(a, false, b, true);
}

Eigen::MatrixXd lower_product_transposed(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  constexpr Eigen::Index block = 48;
  const double one = 1.0, zero = 0.0;
  const Eigen::Index of_each = a.rows() / std::max<Eigen::Index>(1, b.rows());
  const lapack_int inner = lapack_size(a.cols()), a_stride = lapack_size(a.rows()),
                   b_stride = lapack_size(b.rows());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(a.rows(), b.rows());
  for (Eigen::Index first = 0; first < b.rows() && inner > 0; first += block) {
    const Eigen::Index above = of_each * first;
    const lapack_int rows = lapack_size(a.rows() - above),
                     columns = lapack_size(std::min(block, b.rows() - first));
    dgemm_("N", "T", &rows, &columns, &inner, &one, a.data() + above, &a_stride, b.data() + first, &b_stride,
           &zero, result.col(first).data() + above, &a_stride);
  }
  return result;
}

Eigen::MatrixXcd adjoint_product(const Eigen::MatrixXcd& a, const Eigen::MatrixXcd& b) {
  const lapack_int rows = lapack_size(a.cols()), columns = lapack_size(b.cols());
  const lapack_int inner = lapack_size(a.rows());
  const std::complex<double> one = 1.0, zero = 0.0;
  Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(rows, columns);
  if (result.size() > 0 && inner > 0)
    zgemm_("C", "N", &rows, &columns, &inner, &one, a.data(), &inner, b.data(), &inner, &zero, result.data(),
           &rows);
  return result;
}

Eigen::MatrixXd exponential(const Eigen::MatrixXd& matrix) { return matrix.exp(); }

}  // namespace wavebalance::solvers::detail

#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"
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

namespace {

// The Pade approximant of degree 13, exact to rounding for a 1-norm of at most 5.3, by BLAS.
Eigen::MatrixXd pade(const Eigen::MatrixXd& a) {
  constexpr double b[] = {64764752532480000.0,
                          32382376266240000.0,
                          7771770303897600.0,
                          1187353796428800.0,
                          129060195264000.0,
                          10559470521600.0,
                          670442572800.0,
                          33522128640.0,
                          1323241920.0,
                          40840800.0,
                          960960.0,
                          16380.0,
                          182.0,
                          1.0};
  const Eigen::MatrixXd a2 = product(a, a), a4 = product(a2, a2), a6 = product(a4, a2);
  Eigen::MatrixXd odd = b[7] * a6 + b[5] * a4 + b[3] * a2 + product(a6, b[13] * a6 + b[11] * a4 + b[9] * a2);
  odd.diagonal().array() += b[1];
  Eigen::MatrixXd even = b[6] * a6 + b[4] * a4 + b[2] * a2 + product(a6, b[12] * a6 + b[10] * a4 + b[8] * a2);
  even.diagonal().array() += b[0];
  odd = product(a, odd);
  return Lu<double>(even - odd).solve(Eigen::MatrixXd(even + odd));
}

}  // namespace

// Eigen's products of large matrices take several times as long as those of BLAS.
Eigen::MatrixXd exponential(const Eigen::MatrixXd& matrix) {
  constexpr Index small = 24;
  constexpr double largest = 5.3;
  if (matrix.rows() <= small) return matrix.exp();
  const double norm = matrix.cwiseAbs().colwise().sum().maxCoeff();
  if (!std::isfinite(norm)) return Eigen::MatrixXd::Constant(matrix.rows(), matrix.cols(), missing);
  const int squarings = norm > largest ? static_cast<int>(std::ceil(std::log2(norm / largest))) : 0;
  Eigen::MatrixXd result = pade(std::ldexp(1.0, -squarings) * matrix);
  for (int k = 0; k < squarings; ++k) result = product(result, result);
  return result;
}

}  // namespace wavebalance::solvers::detail

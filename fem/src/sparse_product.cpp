#include "sparse_product.hpp"

#include <algorithm>

namespace wavebalance::fem::detail {
namespace {

constexpr Eigen::Index strip_columns = 8, projected_columns = 32;
using Strip = Eigen::Matrix<double, Eigen::Dynamic, strip_columns, Eigen::RowMajor>;
using Row = Eigen::Array<double, 1, strip_columns>;

}  // namespace

Eigen::MatrixXd symmetric_product(const Eigen::SparseMatrix<double>& a, const ConstMatrix& b) {
  Eigen::MatrixXd result(a.rows(), b.cols());
  Strip strip = Strip::Zero(a.rows(), strip_columns);
  for (Eigen::Index first = 0; first < b.cols(); first += strip_columns) {
    const Eigen::Index count = std::min(strip_columns, b.cols() - first);
    strip.leftCols(count) = b.middleCols(first, count);
    for (int column = 0; column < a.outerSize(); ++column) {
      Row sum = Row::Zero();
      for (Eigen::SparseMatrix<double>::InnerIterator entry(a, column); entry; ++entry)
        sum += entry.value() * strip.row(entry.row()).array();
      for (Eigen::Index i = 0; i < count; ++i) result(column, first + i) = sum[i];
    }
  }
  return result;
}

Eigen::MatrixXd projection(const Eigen::SparseMatrix<double>& a, const Eigen::MatrixXd& t) {
  Eigen::MatrixXd projected(t.cols(), t.cols());
  for (Eigen::Index first = 0; first < t.cols(); first += projected_columns) {
    const Eigen::Index count = std::min(projected_columns, t.cols() - first);
    projected.middleCols(first, count) =
        transposed_product(t, symmetric_product(a, t.middleCols(first, count)));
  }
  return (projected + projected.transpose()) / 2.0;
}

}  // namespace wavebalance::fem::detail

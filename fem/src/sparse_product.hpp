#pragma once
#include <Eigen/SparseCore>

#include "dense.hpp"

namespace wavebalance::fem::detail {

/// A B of a symmetric sparse A (both triangles stored) and a dense B: eight columns of B at once, so that A
/// is read once per eight. O(entries of A times columns of B).
Eigen::MatrixXd symmetric_product(const Eigen::SparseMatrix<double>& a, const ConstMatrix& b);

/// T^T A T, symmetric to the last digit, without A T as a whole. O(entries of A times columns of T + n
/// columns^2).
Eigen::MatrixXd projection(const Eigen::SparseMatrix<double>& a, const Eigen::MatrixXd& t);

}  // namespace wavebalance::fem::detail

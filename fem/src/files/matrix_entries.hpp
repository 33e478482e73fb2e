#pragma once
#include <Eigen/SparseCore>
#include <string>
#include <vector>

namespace wavebalance::fem::detail {

using MatrixEntries = std::vector<Eigen::Triplet<double, int>>;

/// The compressed matrix of entries, each given once. A symmetric matrix has one of (i, j) and (j, i) in
/// `entries` and both in the result. Throws MatrixFileError "<name>: the entry (i, j) is given twice".
Eigen::SparseMatrix<double> matrix_of(MatrixEntries entries, int rows, int columns, bool symmetric,
                                      const std::string& name);

}  // namespace wavebalance::fem::detail

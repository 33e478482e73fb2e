#pragma once
#include <Eigen/SparseCore>
#include <string>
#include <vector>

namespace wavebalance::fem::detail {

using MatrixEntries = std::vector<Eigen::Triplet<double, int>>;

/// The compressed matrix of entries, each given once. A symmetric matrix has one of (i, j) and (j, i) in
/// `entries`, or everywhere both, and both in the result. Throws MatrixFileError "<name>: the entry (i, j) is
/// given twice, as a and b", or of two triangles that differ "<name>: the entry (i, j) is a and (j, i) is b".
Eigen::SparseMatrix<double> matrix_of(MatrixEntries entries, int rows, int columns, bool symmetric,
                                      const std::string& name);

}  // namespace wavebalance::fem::detail

#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <filesystem>
#include <iosfwd>
#include <string>

#include "wavebalance/fem/matrix_file.hpp"

namespace wavebalance::fem {

/// Reads `matrix coordinate|array real|integer general|symmetric|skew-symmetric` [BPR96]. In the coordinate
/// format indices count from 1 and zeros are kept; the array format lists the values column by column and
/// its zeros are left out. A symmetric file holds one triangle, on or below the diagonal, and a
/// skew-symmetric one the part below it; the result has both triangles. The result is compressed. O(nnz log
/// nnz). Throws MatrixFileError for: a path that is not a regular file (a device or a pipe), a file that
/// cannot be opened or is larger than largest_matrix_file, another header, sizes that are not whole
/// numbers, above 10^8 or not square where they must be, an index out of range, an entry above the
/// diagonal, of a skew-symmetric file also on it, an entry given twice, a value that is not a finite
/// number, too few entries, text after the last one.
Eigen::SparseMatrix<double> read_matrix_market(const std::filesystem::path& file);
/// The same from a stream; errors call it `name`.
Eigen::SparseMatrix<double> read_matrix_market(std::istream& input, const std::string& name);

/// `matrix coordinate real`, only the lower triangle of a matrix that is symmetric to the last bit, with
/// the fewest digits that give the same doubles. Throws std::invalid_argument for an entry that is not
/// finite.
std::string matrix_market_text(const Eigen::SparseMatrix<double>& matrix);

/// `matrix array real general`, column by column, with the same digits. Each line of `comment` becomes a
/// comment line. Values that are not finite are written as nan or inf, which read_matrix_market refuses.
std::string matrix_market_text(const Eigen::MatrixXd& matrix, const std::string& comment);

}  // namespace wavebalance::fem

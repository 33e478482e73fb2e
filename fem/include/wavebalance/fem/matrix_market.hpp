#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <filesystem>
#include <iosfwd>
#include <span>
#include <stdexcept>
#include <string>

#include "wavebalance/fem/matrices.hpp"

namespace wavebalance::fem {

/// What is wrong with a Matrix Market file: file, line, what was found and what is allowed.
class MatrixMarketError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads `matrix coordinate real|integer general|symmetric` [BPR96]; indices count from 1, a symmetric file
/// holds one triangle, on or below the diagonal. The result is compressed, with both triangles. Zeros are
/// kept. O(nnz). Throws MatrixMarketError for: a file that cannot be opened, another header, sizes that are
/// not whole numbers, above 10^8 or not square where they must be, an index out of range, an entry above the
/// diagonal of a symmetric file, an entry given twice, a value that is no finite number, too few entries,
/// text behind the last one.
Eigen::SparseMatrix<double> read_matrix_market(const std::filesystem::path& file);
/// The same from a stream; errors call it `name`.
Eigen::SparseMatrix<double> read_matrix_market(std::istream& input, const std::string& name);

/// Reads a vector: `matrix array real|integer general` with one column. Throws MatrixMarketError.
Eigen::VectorXd read_matrix_market_vector(const std::filesystem::path& file);
Eigen::VectorXd read_matrix_market_vector(std::istream& input, const std::string& name);

enum class MatrixMarketSymmetry {
  general,   ///< every stored entry
  symmetric  ///< the lower triangle; the matrix must be symmetric to the last bit
};

/// Writes with 17 digits, so that reading gives the same matrix. Throws std::invalid_argument for an entry
/// that is not finite or a matrix that is not symmetric as asked, MatrixMarketError if writing fails.
void write_matrix_market(const std::filesystem::path& file, const Eigen::SparseMatrix<double>& matrix,
                         MatrixMarketSymmetry symmetry = MatrixMarketSymmetry::general);
void write_matrix_market(std::ostream& output, const Eigen::SparseMatrix<double>& matrix,
                         MatrixMarketSymmetry symmetry = MatrixMarketSymmetry::general);

struct StructureChecks {
  bool allow_free = false;            ///< accept a singular stiffness: a structure that can move freely
  double symmetry_tolerance = 1e-10;  ///< of the largest entry, >= 0
  int first_index = 0;  ///< what errors call the first row: 1 for a reader of Matrix Market files
};

/// Throws std::invalid_argument naming the matrix if one is empty, not square or of another size than the
/// stiffness (damping may be 0 x 0), has an entry that is not finite, is not symmetric, or if the mass is not
/// positive definite; unless allow_free, also if the stiffness is singular or indefinite. Definite means that
/// every pivot of the matrix with its diagonal scaled to ones exceeds 1e-13. One or two sparse
/// factorisations.
void check_structure(const Matrices& matrices, const StructureChecks& checks = {});

/// Throws std::invalid_argument naming the list if an entry is not in 0..unknowns-1 or occurs twice.
void check_unknowns(std::span<const int> list, int unknowns, const std::string& name);

}  // namespace wavebalance::fem

#pragma once
#include <Eigen/SparseCore>
#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <stdexcept>
#include <string>
#include <string_view>

namespace wavebalance::fem {

/// An error in a file of a matrix, a vector or a dof map: file, line, value and allowed values.
class MatrixFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Largest file that is read, in bytes.
constexpr std::uintmax_t largest_matrix_file = 8'000'000'000;

/// Formats of matrix files of read_matrix().
enum class MatrixFormat { matrix_market, calculix, harwell_boeing, abaqus, substructure, dmig, output4 };
std::string_view to_string(MatrixFormat format);

/// The format of a file by its content: Matrix Market opens with "%%MatrixMarket", a Harwell-Boeing file
/// has the type of its matrix (RSA, RUA, ..) in the third line and formats in parentheses in the fourth,
/// CalculiX and Abaqus (*MATRIX OUTPUT, FORMAT=COORDINATE) have lines of row, column and value, Abaqus
/// otherwise of node, dof, node, dof and value or a user element, and Nastran DMIG entries or OUTPUT4, text
/// or binary. Comments of Abaqus and Nastran may come first. If the content fits none, the end of the name
/// decides: .mtx Matrix Market, .sti and .mas CalculiX, .rsa and .rua Harwell-Boeing, .pch, .bdf and .dmig
/// DMIG, .op4 OUTPUT4. Throws MatrixFileError if neither decides or the file cannot be read.
MatrixFormat matrix_format(const std::filesystem::path& file);

/// Reads a sparse matrix in any of these formats; the result is compressed and has both triangles.
/// "job.pch#KAAX" names one of several in a file [named_matrix.hpp]. Throws MatrixFileError, which names
/// the format. O(nnz log nnz).
Eigen::SparseMatrix<double> read_matrix(const std::filesystem::path& file);

/// Reads a vector: one column of a matrix that is not square, or the right-hand side of a Harwell-Boeing
/// file. "job.pch#PAX:2" names one of several columns. Throws MatrixFileError as read_matrix does.
Eigen::VectorXd read_vector(const std::filesystem::path& file);

/// Reads what CalculiX writes as .sti and .mas with *FREQUENCY, SOLVER=MATRIXSTORAGE: lines of row, column
/// (from 1) and value, one triangle of a symmetric matrix or both. There is no line of sizes: the largest
/// index is the number of rows. Entries that are zero are left out. Throws MatrixFileError for another line,
/// an index below 1 or above 10^8, a value that is not finite, an entry given twice, two triangles that
/// differ, a file without entries. Errors call the stream `name`.
Eigen::SparseMatrix<double> read_calculix_matrix(std::istream& input, const std::string& name);

/// Reads an assembled real matrix in the format of Harwell and Boeing [DGL89], type RSA (one triangle of a
/// symmetric matrix, or both) or RUA, as Ansys (HBMAT) and LS-DYNA write it. Numbers have the Fortran
/// formats of the header: I for indices, E, D, F or G for values, with repetition and a scale factor such
/// as 1P. Throws MatrixFileError for another type, formats other than these, a field that holds no such
/// number, pointers that do not increase or an index out of range, an entry given twice, two triangles of
/// an RSA file that differ, a file that ends early.
Eigen::SparseMatrix<double> read_harwell_boeing(std::istream& input, const std::string& name);

/// Reads the right-hand side at the end of such a file, where Ansys puts the load: one full vector (F).
/// Throws MatrixFileError as read_harwell_boeing does, and for a file that has none, several, or another
/// kind.
Eigen::VectorXd read_right_hand_side(std::istream& input, const std::string& name);

}  // namespace wavebalance::fem

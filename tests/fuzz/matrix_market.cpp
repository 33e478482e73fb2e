// Any bytes give a matrix or vector that survives being written and read, or a MatrixFileError.
#include "wavebalance/fem/matrix_market.hpp"

#include <sstream>

#include "fuzz.hpp"
#include "wavebalance/fem/check_structure.hpp"

namespace {

using namespace wavebalance::fem;
using Sparse = Eigen::SparseMatrix<double>;

bool equal(const Sparse& a, const Sparse& b) {
  if (a.rows() != b.rows() || a.cols() != b.cols() || a.nonZeros() != b.nonZeros()) return false;
  for (Eigen::Index i = 0; i < a.nonZeros(); ++i)
    if (a.innerIndexPtr()[i] != b.innerIndexPtr()[i] || a.valuePtr()[i] != b.valuePtr()[i]) return false;
  return true;
}

void matrix_survives(const std::string& text) {
  std::istringstream input(text);
  const Sparse matrix = read_matrix_market(input, "fuzz");
  std::istringstream written(matrix_market_text(matrix));
  require(equal(read_matrix_market(written, "written"), matrix), "a written matrix reads back equal");
  if (matrix.rows() > 64) return;
  try {
    check_structure({matrix, Sparse(), matrix});
    require(matrix.rows() > 0 && matrix.rows() == matrix.cols(), "a structure's matrices are square");
    require(matrix.diagonal().minCoeff() > 0.0, "a definite matrix has a positive diagonal");
  } catch (const std::invalid_argument& error) {
    require(*error.what() != '\0', "an error says something");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  try {
    matrix_survives(text);
  } catch (const MatrixFileError& error) {
    require(*error.what() != '\0', "an error says something");
  }
  return 0;
}

// Any bytes give a finite matrix or a map of its rows, or a MatrixFileError, in the formats of other codes.
#include "wavebalance/fem/matrix_file.hpp"

#include <algorithm>
#include <sstream>

#include "fuzz.hpp"
#include "wavebalance/fem/named_matrix.hpp"

namespace {

using namespace wavebalance::fem;
using Reader = Eigen::SparseMatrix<double> (*)(std::istream&, const std::string&);
using SeveralReader = std::vector<NamedMatrix> (*)(std::istream&, const std::string&);

template <typename Read>
void attempt(Read read) {
  try {
    read();
  } catch (const MatrixFileError& error) {
    require(*error.what() != '\0', "an error says something");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  for (const Reader reader : {Reader(read_calculix_matrix), Reader(read_harwell_boeing)})
    attempt([&] {
      std::istringstream input(text);
      const auto matrix = reader(input, "fuzz");
      require(matrix.nonZeros() == 0 || matrix.coeffs().allFinite(), "a matrix has finite entries");
      require(matrix.isCompressed(), "a matrix is compressed");
    });
  const auto read_dmigs = [](std::istream& input, const std::string& name) { return read_dmig(input, name); };
  const auto read_output4s = [](std::istream& input, const std::string& name) {
    return read_output4(input, name);
  };
  for (const SeveralReader reader : {SeveralReader(read_abaqus_matrix), SeveralReader(read_substructure),
                                     SeveralReader(read_dmigs), SeveralReader(read_output4s)})
    attempt([&] {
      std::istringstream input(text);
      for (const NamedMatrix& one : reader(input, "fuzz"))
        require(one.matrix.nonZeros() == 0 || one.matrix.coeffs().allFinite(), "a matrix has finite entries");
    });
  attempt([&] {
    std::istringstream input(text);
    const DofMap map = read_dof_map(input, "fuzz");
    for (int row = 0; row < std::min(map.rows(), 64); ++row)
      require(!map.name(row).empty(), "each row of a map has a name");
  });
  return 0;
}

#include <algorithm>

#include "entries.hpp"
#include "text_parts.hpp"
#include "wavebalance/fem/matrix_file.hpp"

namespace wavebalance::fem {

Eigen::SparseMatrix<double> read_calculix_matrix(std::istream& input, const std::string& name) {
  detail::Lines lines(input, name);
  detail::MatrixEntries entries;
  int size = 0;
  while (lines.next()) {
    if (lines.words().empty()) continue;
    lines.require_words(3, "row, column and value");
    const int row = lines.index(std::size_t{0}, "the row", detail::largest_side);
    const int column = lines.index(std::size_t{1}, "the column", detail::largest_side);
    const double value = lines.finite_of_column(lines.words()[2]);
    size = std::max({size, row + 1, column + 1});
    if (value != 0.0) entries.emplace_back(row, column, value);
  }
  if (size == 0) lines.fail("there is no entry; lines must hold row, column and value");
  const bool cut = !entries.empty() && detail::ends_within_a_row(entries);
  auto matrix = detail::matrix_of(std::move(entries), size, size, true, name);
  if (cut) lines.fail(detail::cut_row);
  return matrix;
}

}  // namespace wavebalance::fem

#include "matrix_entries.hpp"

#include <algorithm>
#include <utility>

#include "wavebalance/fem/matrix_file.hpp"

namespace wavebalance::fem::detail {
namespace {

void reject_repeats(const MatrixEntries& entries, bool symmetric, const std::string& name) {
  std::vector<std::pair<int, int>> places;
  places.reserve(entries.size());
  for (const auto& entry : entries) {
    const bool above = symmetric && entry.row() < entry.col();
    places.emplace_back(above ? entry.row() : entry.col(), above ? entry.col() : entry.row());
  }
  std::sort(places.begin(), places.end());
  const auto twice = std::adjacent_find(places.begin(), places.end());
  if (twice != places.end())
    throw MatrixFileError(name + ": the entry (" + std::to_string(twice->second + 1) + ", " +
                          std::to_string(twice->first + 1) + ") is given twice" +
                          (symmetric ? "; a symmetric file holds one triangle" : ""));
}

}  // namespace

Eigen::SparseMatrix<double> matrix_of(MatrixEntries entries, int rows, int columns, bool symmetric,
                                      const std::string& name) {
  reject_repeats(entries, symmetric, name);
  if (symmetric) {
    const std::size_t stored = entries.size();
    entries.reserve(2 * stored);
    for (std::size_t i = 0; i < stored; ++i)
      if (entries[i].row() != entries[i].col())
        entries.emplace_back(entries[i].col(), entries[i].row(), entries[i].value());
  }
  Eigen::SparseMatrix<double> matrix(rows, columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

}  // namespace wavebalance::fem::detail

#include <algorithm>

#include "require.hpp"

namespace wavebalance::fem::detail {

using Sparse = Eigen::SparseMatrix<double>;

std::optional<std::string> symmetry_fault(const Sparse& matrix, double tolerance, int first_index) {
  const auto place = [&](const Sparse::InnerIterator& entry) {
    return "row " + std::to_string(entry.row() + first_index) + ", column " +
           std::to_string(entry.col() + first_index);
  };
  double scale = 0.0;
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry) {
      if (!std::isfinite(entry.value())) return "has an entry that is not finite at " + place(entry);
      scale = std::max(scale, std::abs(entry.value()));
    }
  const Sparse difference = matrix - Sparse(matrix.transpose());
  for (int column = 0; column < difference.outerSize(); ++column)
    for (Sparse::InnerIterator entry(difference, column); entry; ++entry)
      if (std::abs(entry.value()) > tolerance * scale)
        return "is not symmetric: " + place(entry) + " differs from its mirror by " + text(entry.value(), 6) +
               ", its largest entry is " + text(scale, 6) + "; store both triangles";
  return std::nullopt;
}

void require_symmetric(const Sparse& matrix, const char* where, const char* name) {
  const auto fault = symmetry_fault(matrix, 1e-10);
  if (fault) require(false, where, std::string(name) + " " + *fault);
}

}  // namespace wavebalance::fem::detail

#pragma once
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

namespace wavebalance::solvers {

/// The largest modulus of an entry, 0 for none. O(entries).
inline double largest_entry(const Eigen::SparseMatrix<double>& matrix) {
  double largest = 0.0;
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, column); entry; ++entry)
      largest = std::max(largest, std::abs(entry.value()));
  return largest;
}

}  // namespace wavebalance::solvers

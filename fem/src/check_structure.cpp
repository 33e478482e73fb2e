#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "symmetric_factor.hpp"
#include "wavebalance/fem/matrix_market.hpp"

namespace wavebalance::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

[[noreturn]] void reject(const std::string& message) {
  throw std::invalid_argument("check_structure: " + message);
}

std::string text(double number) {
  std::ostringstream digits;
  digits << number;
  return digits.str();
}

void require_size(const Sparse& matrix, const char* name, Eigen::Index size) {
  if (matrix.rows() != size || matrix.cols() != size || size == 0)
    reject(std::string(name) + " is " + std::to_string(matrix.rows()) + " x " +
           std::to_string(matrix.cols()) +
           "; it must be square, not empty and of the size of the stiffness, " + std::to_string(size));
}

void require_symmetric(const Sparse& matrix, const char* name, const StructureChecks& checks) {
  const auto place = [&](const Sparse::InnerIterator& entry) {
    return "row " + std::to_string(entry.row() + checks.first_index) + ", column " +
           std::to_string(entry.col() + checks.first_index);
  };
  double scale = 0.0;
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry) {
      if (!std::isfinite(entry.value()))
        reject(std::string(name) + " has an entry that is not finite at " + place(entry));
      scale = std::max(scale, std::abs(entry.value()));
    }
  const Sparse difference = matrix - Sparse(matrix.transpose());
  for (int column = 0; column < difference.outerSize(); ++column)
    for (Sparse::InnerIterator entry(difference, column); entry; ++entry)
      if (std::abs(entry.value()) > checks.symmetry_tolerance * scale)
        reject(std::string(name) + " is not symmetric: " + place(entry) + " differs from its mirror by " +
               text(entry.value()) + ", its largest entry is " + text(scale) + "; store both triangles");
}

// The diagonal scaled to ones, so that units of the unknowns (metres, radians) do not matter to the pivots.
Sparse scaled(const Sparse& matrix, const char* name, int first_index) {
  const Eigen::VectorXd diagonal = matrix.diagonal();
  for (Eigen::Index i = 0; i < diagonal.size(); ++i)
    if (!(diagonal[i] > 0.0))
      reject(std::string(name) + " is not positive definite: its diagonal entry " +
             std::to_string(i + first_index) + " is " + text(diagonal[i]));
  const Eigen::VectorXd root = diagonal.cwiseSqrt().cwiseInverse();
  return root.asDiagonal() * matrix * root.asDiagonal();
}

void require_positive_definite(const Sparse& matrix, const char* name, int first_index, const char* advice) {
  const detail::SymmetricFactor factor(scaled(matrix, name, first_index));
  if (!factor.complete() || !(factor.pivots().minCoeff() > 1e-13))
    reject(std::string(name) + " is not positive definite" +
           (factor.complete() ? ": a pivot is " + text(factor.pivots().minCoeff()) + " of its diagonal entry"
                              : std::string(": a pivot is zero")) +
           advice);
}

}  // namespace

void check_structure(const Matrices& matrices, const StructureChecks& checks) {
  if (!(checks.symmetry_tolerance >= 0.0))
    reject("symmetry_tolerance is " + text(checks.symmetry_tolerance) + "; it must not be negative");
  const Eigen::Index size = matrices.stiffness.rows();
  require_size(matrices.stiffness, "stiffness", size);
  require_size(matrices.mass, "mass", size);
  if (matrices.damping.size() > 0) require_size(matrices.damping, "damping", size);
  require_symmetric(matrices.stiffness, "stiffness", checks);
  require_symmetric(matrices.mass, "mass", checks);
  if (matrices.damping.size() > 0) require_symmetric(matrices.damping, "damping", checks);
  require_positive_definite(matrices.mass, "mass", checks.first_index, "");
  if (!checks.allow_free)
    require_positive_definite(matrices.stiffness, "stiffness", checks.first_index,
                              "; is the structure free to move without being strained?");
}

void check_unknowns(std::span<const int> list, int unknowns, const std::string& name) {
  std::vector<int> sorted(list.begin(), list.end());
  std::sort(sorted.begin(), sorted.end());
  for (int unknown : sorted)
    if (unknown < 0 || unknown >= unknowns)
      throw std::invalid_argument(name + " has " + std::to_string(unknown) + "; it must be in 0.." +
                                  std::to_string(unknowns - 1));
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) throw std::invalid_argument(name + " has " + std::to_string(*twice) + " twice");
}

}  // namespace wavebalance::fem

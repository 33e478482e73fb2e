#include "wavebalance/fem/check_structure.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "require.hpp"
#include "symmetric_factor.hpp"

namespace wavebalance::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

void require_size(StructureMatrix name, const Sparse& matrix, Eigen::Index size) {
  if (matrix.rows() == size && matrix.cols() == size && size > 0) return;
  throw StructureFault(name, "is " + std::to_string(matrix.rows()) + " x " + std::to_string(matrix.cols()) +
                                 "; it must be square, not empty and of the size of the stiffness, " +
                                 std::to_string(size));
}

void require_symmetric(StructureMatrix name, const Sparse& matrix, const StructureChecks& checks) {
  const auto fault = detail::symmetry_fault(matrix, checks.symmetry_tolerance, checks.first_index);
  if (fault) throw StructureFault(name, *fault);
}

// diag(factors) matrix diag(factors). With factors 1/sqrt(diagonal) the units of the unknowns (metres,
// radians) do not affect the pivots.
Sparse scaled(const Sparse& matrix, const Eigen::VectorXd& factors) {
  return factors.asDiagonal() * matrix * factors.asDiagonal();
}

Sparse symmetric_part(const Sparse& matrix) { return 0.5 * (matrix + Sparse(matrix.transpose())); }

void require_positive_definite(StructureMatrix name, const Sparse& matrix, int first_index,
                               const char* advice) {
  const Eigen::VectorXd diagonal = matrix.diagonal();
  for (Eigen::Index i = 0; i < diagonal.size(); ++i)
    if (!(diagonal[i] > 0.0))
      throw StructureFault(name, "is not positive definite: its diagonal entry " +
                                     std::to_string(i + first_index) + " is " + detail::text(diagonal[i], 6));
  const Sparse unit_diagonal = scaled(matrix, diagonal.cwiseSqrt().cwiseInverse());
  const detail::SymmetricFactor factor(unit_diagonal);
  if (factor.positive_definite() && factor.smallest_pivot() > 1e-13) return;
  const detail::Inertia signs = factor.positive_definite() ? detail::Inertia{true, 0, factor.smallest_pivot()}
                                                           : detail::inertia(unit_diagonal);
  const std::string pivot =
      signs.complete ? detail::text(signs.smallest, 6) + " times its diagonal entry" : "zero";
  throw StructureFault(name, "is not positive definite: a pivot is " + pivot + advice);
}

}  // namespace

std::string_view to_string(StructureMatrix matrix) {
  if (matrix == StructureMatrix::mass) return "mass";
  return matrix == StructureMatrix::damping ? "damping" : "stiffness";
}

StructureFault::StructureFault(StructureMatrix matrix, const std::string& reason)
    : std::invalid_argument("check_structure: " + std::string(to_string(matrix)) + " " + reason),
      matrix_(matrix),
      reason_(reason) {}

void check_structure(const Matrices& matrices, const StructureChecks& checks) {
  detail::require_value(checks.symmetry_tolerance >= 0.0, "check_structure", "symmetry_tolerance",
                        checks.symmetry_tolerance, "at least 0");
  using enum StructureMatrix;
  const bool damped = matrices.damping.size() > 0;
  const Eigen::Index size = matrices.stiffness.rows();
  require_size(stiffness, matrices.stiffness, size);
  require_size(mass, matrices.mass, size);
  if (damped) require_size(damping, matrices.damping, size);
  StructureChecks finite = checks;
  if (checks.unsymmetric) finite.symmetry_tolerance = std::numeric_limits<double>::infinity();
  require_symmetric(stiffness, matrices.stiffness, finite);
  require_symmetric(mass, matrices.mass, checks);
  if (damped) require_symmetric(damping, matrices.damping, finite);
  if (!checks.semidefinite_mass)
    require_positive_definite(mass, matrices.mass, checks.first_index, "");
  else if (!positive_semidefinite(matrices.mass))
    throw StructureFault(mass, "is not positive semidefinite: some motion has a negative kinetic energy");
  if (!checks.allow_free)
    require_positive_definite(stiffness,
                              checks.unsymmetric ? symmetric_part(matrices.stiffness) : matrices.stiffness,
                              checks.first_index, "; is the structure free to move without being strained?");
}

bool positive_semidefinite(const Sparse& matrix, double tolerance) {
  detail::require_square(matrix, "positive_semidefinite", "matrix", matrix.rows());
  detail::require_positive("positive_semidefinite", "tolerance", tolerance);
  if (matrix.rows() == 0) return true;
  const Eigen::VectorXd diagonal = matrix.diagonal();
  const double largest = diagonal.maxCoeff(), zero = tolerance * tolerance * largest;
  if (!(diagonal.minCoeff() >= -zero)) return false;
  // In a semidefinite matrix a_ij^2 <= a_ii a_jj: a row with a zero diagonal entry is zero, and left out.
  for (int column = 0; column < matrix.outerSize(); ++column)
    if (diagonal[column] <= zero)
      for (Sparse::InnerIterator entry(matrix, column); entry; ++entry)
        if (!(std::abs(entry.value()) <= tolerance * largest)) return false;
  const Eigen::VectorXd factors =
      diagonal.unaryExpr([&](double d) { return d > zero ? 1.0 / std::sqrt(d) : 0.0; });
  Sparse identity(matrix.rows(), matrix.cols());
  identity.setIdentity();
  return detail::SymmetricFactor(scaled(matrix, factors) + tolerance * identity).positive_definite();
}

void check_unknowns(std::span<const int> list, int unknowns, const std::string& name) {
  std::vector<int> sorted(list.begin(), list.end());
  std::ranges::sort(sorted);
  for (int unknown : sorted)
    if (unknown < 0 || unknown >= unknowns)
      throw std::invalid_argument(name + " has " + std::to_string(unknown) + "; it must be in 0.." +
                                  std::to_string(unknowns - 1));
  const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
  if (twice != sorted.end()) throw std::invalid_argument(name + " has " + std::to_string(*twice) + " twice");
}

}  // namespace wavebalance::fem

#pragma once
#include <optional>

#include "wavebalance/fem/matrices.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::app {

/// (A + A^T) / 2, or A itself where it is symmetric to rounding.
inline Eigen::SparseMatrix<double> symmetric_part(const Eigen::SparseMatrix<double>& matrix) {
  if (solvers::is_symmetric(matrix)) return matrix;
  return 0.5 * (matrix + Eigen::SparseMatrix<double>(matrix.transpose()));
}

/// T^T A T of the skew part of A, nothing where A is symmetric.
inline Eigen::SparseMatrix<double> projected_skew_part(const Eigen::SparseMatrix<double>& matrix,
                                                       const Eigen::MatrixXd& transformation) {
  const Eigen::Index size = transformation.cols();
  if (matrix.size() == 0 || solvers::is_symmetric(matrix)) return Eigen::SparseMatrix<double>(size, size);
  const Eigen::SparseMatrix<double> skew = matrix - symmetric_part(matrix);
  return Eigen::MatrixXd(transformation.transpose() * (skew * transformation)).sparseView();
}

/// A shift for the modes of a structure, (rad/s)^2 [fem::EigenmodesOptions]: below zero where it is free to
/// move.
inline double shift_of(bool free, const Eigen::SparseMatrix<double>& stiffness,
                       const Eigen::SparseMatrix<double>& mass) {
  if (!free) return 0.0;
  const double largest = (stiffness.diagonal().array() / mass.diagonal().array()).maxCoeff();
  return largest > 0.0 ? -1e-8 * largest : -1.0;
}

/// The matrices with the symmetric parts of C and K; nothing if they are symmetric, to save a copy of a
/// large structure.
inline std::optional<fem::Matrices> symmetric_parts(const fem::Matrices& matrices) {
  const bool no_damping = matrices.damping.size() == 0;
  if (solvers::is_symmetric(matrices.stiffness) && (no_damping || solvers::is_symmetric(matrices.damping)))
    return std::nullopt;
  return fem::Matrices{.mass = matrices.mass,
                       .damping = no_damping ? matrices.damping : symmetric_part(matrices.damping),
                       .stiffness = symmetric_part(matrices.stiffness)};
}

}  // namespace wavebalance::app

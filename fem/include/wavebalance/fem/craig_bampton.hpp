#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "wavebalance/fem/eigenmodes.hpp"
#include "wavebalance/fem/matrices.hpp"

namespace wavebalance::fem {

/// Options of craig_bampton().
struct CraigBamptonOptions {
  int modes = 40;            ///< fixed-interface modes to keep, 0..number of unknowns not on the boundary
  EigenmodesOptions solver;  ///< of the fixed-interface modes; its shift must be 0
  Observer observer = {};    ///< of the whole reduction
};

/// A structure reduced to b boundary unknowns and m fixed-interface modes [CB68]: u = T q, with
///
///     T = [I 0; Psi Phi],   Psi = -K_ii^-1 K_ib,   K_ii Phi = M_ii Phi diag(omega^2),   Phi^T M_ii Phi = I,
///
/// with rows in the order (boundary, interior); `transformation` has them in the order of the structure. The
/// boundary displacements are the first b coordinates, in the order given, so that contact on them needs no
/// recovery.
struct CraigBampton {
  EigenmodesStatus status = EigenmodesStatus::converged;  ///< of the fixed-interface modes
  Eigen::VectorXi boundary;        ///< unknowns of the structure that are the first b coordinates
  Eigen::VectorXd omega;           ///< rad/s, m: of the fixed-interface modes
  Eigen::MatrixXd mass;            ///< (b+m) x (b+m), kg
  Eigen::MatrixXd damping;         ///< N s/m
  Eigen::MatrixXd stiffness;       ///< N/m; the blocks boundary-mode are zero, the block of the modes
                                   ///< diag(omega^2)
  Eigen::MatrixXd transformation;  ///< n x (b+m)

  /// T^T A T for another symmetric n x n matrix of the structure. O(nnz (b+m) + n (b+m)^2).
  Eigen::MatrixXd project(const Eigen::SparseMatrix<double>& matrix) const;
  /// T^T f for a load on the n unknowns.
  Eigen::VectorXd project_load(const Eigen::VectorXd& load) const;
  /// S T, c x (b+m), of contact directions S (c x n): their entries in the columns of the boundary. Throws
  /// std::invalid_argument for one that touches an unknown of the interior. O(nnz + n).
  Eigen::SparseMatrix<double, Eigen::RowMajor> project_directions(
      const Eigen::SparseMatrix<double, Eigen::RowMajor>& directions) const;
  /// T q: displacements (n) of the structure from the b+m coordinates.
  Eigen::VectorXd recover(const Eigen::VectorXd& coordinates) const;
};

/// The unknowns that the rows of `directions` (c x n) touch, each once, row by row in ascending order: the
/// boundary that a reduction has to keep for contacts along them. O(nnz + n).
std::vector<int> touched_unknowns(const Eigen::SparseMatrix<double, Eigen::RowMajor>& directions);

/// Reduces a structure with symmetric stiffness, positive definite once the boundary is held, and symmetric
/// mass; an empty damping matrix (0 x 0) counts as zero. One sparse factorisation of K_ii serves constraint
/// modes and iteration; another, of K_ii - s M_ii, counts the modes. The interior may not be empty. If the
/// observer cancels, the result has only its status. Memory in addition to K and M: a copy of K_ii and
/// M_ii, another while modes are counted, the factor, and n (b + 3 modes + 40) numbers.
///
/// Throws std::invalid_argument if sizes, symmetry, boundary (out of range, twice) or options do not fit,
/// std::domain_error if K_ii is not positive definite.
CraigBampton craig_bampton(const Matrices& matrices, std::span<const int> boundary,
                           const CraigBamptonOptions& options = {});

}  // namespace wavebalance::fem

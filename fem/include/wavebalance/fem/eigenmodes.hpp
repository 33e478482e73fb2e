#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <functional>
#include <string_view>

namespace wavebalance::fem {

/// Called between the steps of long work with what is done next and the share done so far, 0..1. Returns
/// false to stop the work, whose status is then `cancelled`; a single factorisation runs to its end. An empty
/// observer stops nothing.
using Observer = std::function<bool(std::string_view phase, double done)>;

/// Options of eigenmodes().
struct EigenmodesOptions {
  double tolerance = 1e-14;  ///< of the sparse iteration, relative to 1/(omega^2 - shift), in (0, 1)
  int max_restarts = 1000;   ///< of the sparse iteration, >= 1
  int dense_up_to = 200;     ///< up to this many unknowns a dense solver is used, >= 0
  double shift = 0.0;        ///< (rad/s)^2, <= 0; below zero where the stiffness is singular (free bodies)
  Observer observer = {};    ///< of the sparse iteration
};

/// How an eigenmode computation ended.
enum class EigenmodesStatus {
  converged,
  /// The sparse iteration ended early, or the count of the modes below the highest one shows that some are
  /// missing. The result holds the modes found.
  not_converged,
  cancelled  ///< by the observer
};

/// Modes of K phi = omega^2 M phi in ascending order of omega.
struct EigenmodesResult {
  EigenmodesStatus status = EigenmodesStatus::not_converged;
  Eigen::VectorXd omega;           ///< rad/s; 0 where rounding made omega^2 negative
  Eigen::VectorXd frequencies_hz;  ///< omega / (2 pi)
  Eigen::MatrixXd shapes;          ///< n x modes, phi^T M phi = 1, the entry of largest modulus positive
  Eigen::VectorXd residuals;       ///< |K phi - omega^2 M phi|_2 / (|K|_1 |phi|_2)
};

/// The `count` lowest modes of a structure with symmetric stiffness K, positive definite (or semidefinite,
/// with a negative shift), and symmetric positive semidefinite mass M; both n x n with both triangles stored,
/// 1 <= count <= rank M.
///
/// Small problems, and those with count >= n/2, use a dense solver, O(n^3). The others use Lanczos' iteration
/// with blocks of vectors and (K - shift M)^-1 M [Ericsson & Ruhe 1980; Grimes, Lewis & Simon 1994], with one
/// sparse factorisation and O(count) solves, for a bar O(n count^2). Memory: n (3 count + 40) numbers. By
/// Sylvester's law of inertia the number of negative pivots of K - s M, with s below the highest mode, is the
/// number of modes below s. If a copy of a multiple mode is missing, the iteration is repeated for more
/// modes.
///
/// Both work with 1/(omega^2 - shift). The relative rounding error of omega^2 is about eps times its ratio to
/// the lowest one.
///
/// Throws std::invalid_argument if sizes, count or options do not fit, an entry is not finite or a matrix is
/// not symmetric, std::domain_error if K - shift M is not positive definite or M has too low a rank or is
/// indefinite (the latter is detected by the dense solver only).
EigenmodesResult eigenmodes(const Eigen::SparseMatrix<double>& stiffness,
                            const Eigen::SparseMatrix<double>& mass, int count,
                            const EigenmodesOptions& options = {});

}  // namespace wavebalance::fem

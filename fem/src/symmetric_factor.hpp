#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

namespace wavebalance::fem::detail {

/// Sparse factor of a symmetric positive definite matrix with a fill-reducing order: L L^T by CHOLMOD, in
/// dense blocks where they pay [CDHR08], or else Eigen's L D L^T. Not shared between threads while it is
/// made; solves may run at the same time. Throws std::runtime_error if the factor would have more than 2^31
/// entries, std::bad_alloc if the memory does not suffice.
class SymmetricFactor {
 public:
  explicit SymmetricFactor(const Eigen::SparseMatrix<double>& matrix);
  ~SymmetricFactor();
  SymmetricFactor(SymmetricFactor&&) noexcept;
  SymmetricFactor& operator=(SymmetricFactor&&) noexcept;

  /// False if a pivot is not positive: smallest_pivot() and solve() may not be used then.
  bool positive_definite() const;
  Eigen::Index rows() const;
  /// The least entry of D in L D L^T with a unit diagonal of L.
  double smallest_pivot() const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The signs of the eigenvalues of a symmetric matrix.
struct Inertia {
  bool complete = false;      ///< no pivot is zero; otherwise the other members mean nothing
  Eigen::Index negative = 0;  ///< negative eigenvalues
  double smallest = 0.0;      ///< the least pivot of L D L^T
};

/// By Sylvester's law of inertia from L D L^T without pivoting, which exists for almost every matrix,
/// indefinite ones too. L is not kept. As long as a factorisation. Throws as SymmetricFactor does.
Inertia inertia(const Eigen::SparseMatrix<double>& matrix);

}  // namespace wavebalance::fem::detail

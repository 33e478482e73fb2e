#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <memory>

namespace wavebalance::fem::detail {

/// Sparse L D L^T of a symmetric matrix with a fill-reducing order, without pivoting. Not shared between
/// threads while it is made; solves may run at the same time.
class SymmetricFactor {
 public:
  explicit SymmetricFactor(const Eigen::SparseMatrix<double>& matrix);
  ~SymmetricFactor();
  SymmetricFactor(SymmetricFactor&&) noexcept;
  SymmetricFactor& operator=(SymmetricFactor&&) noexcept;

  /// False after a zero pivot: no other member may be used then.
  bool complete() const;
  Eigen::Index rows() const;
  /// Their signs are those of the eigenvalues (Sylvester's law of inertia).
  const Eigen::VectorXd& pivots() const;
  bool positive_definite() const { return complete() && pivots().minCoeff() > 0.0; }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;
  void solve(const double* right, double* solution) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
  Eigen::VectorXd pivots_;
};

}  // namespace wavebalance::fem::detail

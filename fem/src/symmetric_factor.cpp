#include "symmetric_factor.hpp"

#include <Eigen/SparseCholesky>

namespace wavebalance::fem::detail {

struct SymmetricFactor::Implementation {
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor;
};

SymmetricFactor::SymmetricFactor(const Eigen::SparseMatrix<double>& matrix)
    : implementation_(std::make_unique<Implementation>()) {
  implementation_->factor.compute(matrix);
  if (complete()) pivots_ = implementation_->factor.vectorD();
}

SymmetricFactor::~SymmetricFactor() = default;
SymmetricFactor::SymmetricFactor(SymmetricFactor&&) noexcept = default;
SymmetricFactor& SymmetricFactor::operator=(SymmetricFactor&&) noexcept = default;

bool SymmetricFactor::complete() const { return implementation_->factor.info() == Eigen::Success; }

Eigen::Index SymmetricFactor::rows() const { return implementation_->factor.rows(); }

const Eigen::VectorXd& SymmetricFactor::pivots() const { return pivots_; }

Eigen::MatrixXd SymmetricFactor::solve(const Eigen::MatrixXd& right) const {
  return implementation_->factor.solve(right);
}

void SymmetricFactor::solve(const double* right, double* solution) const {
  const Eigen::Map<const Eigen::VectorXd> given(right, rows());
  Eigen::Map<Eigen::VectorXd>(solution, rows()) = implementation_->factor.solve(given);
}

}  // namespace wavebalance::fem::detail

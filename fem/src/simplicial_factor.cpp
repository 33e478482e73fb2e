#include <Eigen/SparseCholesky>

#include "symmetric_factor.hpp"

// Factors by Eigen, column by column, for builds without CHOLMOD.
namespace wavebalance::fem::detail {

using Simplicial = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

struct SymmetricFactor::Implementation {
  Simplicial factor;
  double smallest = 0.0;
};

SymmetricFactor::SymmetricFactor(const Eigen::SparseMatrix<double>& matrix)
    : implementation_(std::make_unique<Implementation>()) {
  implementation_->factor.compute(matrix);
  if (implementation_->factor.info() == Eigen::Success && matrix.rows() > 0)
    implementation_->smallest = implementation_->factor.vectorD().minCoeff();
}

SymmetricFactor::~SymmetricFactor() = default;
SymmetricFactor::SymmetricFactor(SymmetricFactor&&) noexcept = default;
SymmetricFactor& SymmetricFactor::operator=(SymmetricFactor&&) noexcept = default;

bool SymmetricFactor::positive_definite() const { return implementation_->smallest > 0.0; }

Eigen::Index SymmetricFactor::rows() const { return implementation_->factor.rows(); }

double SymmetricFactor::smallest_pivot() const { return implementation_->smallest; }

Eigen::MatrixXd SymmetricFactor::solve(const Eigen::MatrixXd& right) const {
  return implementation_->factor.solve(right);
}

Inertia inertia(const Eigen::SparseMatrix<double>& matrix) {
  const Simplicial factor(matrix);
  if (factor.info() != Eigen::Success) return {};
  const Eigen::VectorXd pivots = factor.vectorD();
  return {true, (pivots.array() < 0.0).count(), pivots.size() > 0 ? pivots.minCoeff() : 0.0};
}

}  // namespace wavebalance::fem::detail

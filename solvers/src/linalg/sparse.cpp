#include "linalg/sparse.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseLU>

namespace wavebalance::solvers::detail {

struct PositiveFactor::Factor : Eigen::SimplicialLDLT<SparseMatrix> {
  using SimplicialLDLT::SimplicialLDLT;
};

PositiveFactor::PositiveFactor(const SparseMatrix& matrix) : factor_(std::make_unique<Factor>(matrix)) {}
PositiveFactor::~PositiveFactor() = default;

bool PositiveFactor::exists() const {
  return factor_->info() == Eigen::Success && factor_->vectorD().minCoeff() > 0.0;
}

Eigen::MatrixXd PositiveFactor::solve(const Eigen::MatrixXd& right) const { return factor_->solve(right); }

struct SparseLu::Factor : Eigen::SparseLU<SparseMatrix> {};

SparseLu::SparseLu(const SparseMatrix& matrix) : factor_(std::make_unique<Factor>()) {
  factor_->compute(matrix);
}
SparseLu::~SparseLu() = default;

Eigen::MatrixXd SparseLu::solve(const Eigen::MatrixXd& right) const { return factor_->solve(right); }

Eigen::MatrixXd SparseLu::solve_transposed(const Eigen::MatrixXd& right) {
  return factor_->transpose().solve(right);
}

}  // namespace wavebalance::solvers::detail

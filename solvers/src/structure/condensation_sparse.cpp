#include <Eigen/SparseLU>

#include "structure/condensation_direct.hpp"

namespace wavebalance::solvers {
namespace {

class SparseMethod final : public DirectMethod {
 public:
  explicit SparseMethod(const LinearStructure& structure) : DirectMethod(structure) {
    solver_.analyzePattern(combine({1.0, 1.0, 1.0}));
  }

  std::unique_ptr<Method> twin() const override {
    return size() < least_size_for_threads ? nullptr : std::make_unique<SparseMethod>(structure());
  }

 private:
  void factorize(const ImpedanceCoefficients& factors) override {
    solver_.factorize(combine(factors));
    if (solver_.info() != Eigen::Success)
      throw SingularSystem("the dynamic stiffness is singular: " + solver_.lastErrorMessage());
  }
  Eigen::MatrixXcd solve(const Eigen::MatrixXcd& right) const override { return solver_.solve(right); }
  Eigen::MatrixXcd solve_transposed(const Eigen::MatrixXcd& right) override {
    return solver_.transpose().solve(right);
  }

  Eigen::SparseLU<SparseComplex, Eigen::COLAMDOrdering<int>> solver_;
};

}  // namespace

std::unique_ptr<Condensation::Method> make_plain_sparse_method(const LinearStructure& structure) {
  return std::make_unique<SparseMethod>(structure);
}

#ifndef WAVEBALANCE_HAS_UMFPACK
std::unique_ptr<Condensation::Method> make_sparse_method(const LinearStructure& structure) {
  return make_plain_sparse_method(structure);
}
#endif

}  // namespace wavebalance::solvers

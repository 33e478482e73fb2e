#include <Eigen/SparseLU>

#include "condensation_method.hpp"

namespace wavebalance::solvers {
namespace {

using Complex = std::complex<double>;
using SparseComplex = Eigen::SparseMatrix<Complex>;

class SparseMethod final : public Condensation::Method {
 public:
  explicit SparseMethod(const LinearStructure& structure) : structure_(structure), scale_(structure) {
    solver_.analyzePattern(combine({1.0, 1.0, 1.0}));
  }

  int size() const override { return structure_.size(); }

  CondensedPoint at(const StiffnessFactors& factors, const StiffnessFactors& rates) override {
    factorize(factors);
    Eigen::VectorXcd unit = Eigen::VectorXcd::Zero(size());
    unit[structure_.contact_dof] = 1.0;
    const Eigen::VectorXcd response = solver_.solve(unit);
    scale_.require_regular(factors, response, 1.0);
    const Eigen::VectorXcd loaded = solver_.solve(structure_.load.cast<Complex>());
    const SparseComplex rate = combine(rates);
    const int contact = structure_.contact_dof;
    return {response[contact], loaded[contact], -(response.transpose() * (rate * response)).value(),
            -(response.transpose() * (rate * loaded)).value()};
  }

  Eigen::VectorXcd recover(const StiffnessFactors& factors, Complex load_amplitude,
                           Complex contact_force) override {
    factorize(factors);
    Eigen::VectorXcd force = structure_.load * load_amplitude;
    force[structure_.contact_dof] -= contact_force;
    const Eigen::VectorXcd response = solver_.solve(force);
    scale_.require_regular(factors, response, force.norm());
    return response;
  }

 private:
  SparseComplex combine(const StiffnessFactors& s) const {
    SparseComplex sum = structure_.mass.cast<Complex>() * s[0] + structure_.damping.cast<Complex>() * s[1] +
                        structure_.stiffness.cast<Complex>() * s[2];
    sum.makeCompressed();
    return sum;
  }

  void factorize(const StiffnessFactors& factors) {
    solver_.factorize(combine(factors));
    if (solver_.info() != Eigen::Success)
      throw SingularSystem("the dynamic stiffness is singular: " + solver_.lastErrorMessage());
  }

  LinearStructure structure_;
  StiffnessScale scale_;
  Eigen::SparseLU<SparseComplex, Eigen::COLAMDOrdering<int>> solver_;
};

}  // namespace

std::unique_ptr<Condensation::Method> make_sparse_method(const LinearStructure& structure) {
  return std::make_unique<SparseMethod>(structure);
}

}  // namespace wavebalance::solvers

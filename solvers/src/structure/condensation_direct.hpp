#pragma once
#include <Eigen/SparseCore>

#include "structure/condensation_method.hpp"

namespace wavebalance::solvers {

/// Condensation by a factorisation of each dynamic stiffness; which one is the derived class's.
class DirectMethod : public Condensation::Method {
 public:
  using SparseComplex = Eigen::SparseMatrix<std::complex<double>>;

  explicit DirectMethod(const LinearStructure& structure) : structure_(structure), scale_(structure) {}

  int size() const override { return structure_.size(); }
  int contacts() const override { return structure_.contacts(); }
  CondensedPoint dynamic_compliance(const ImpedanceCoefficients& factors,
                                    const ImpedanceCoefficients& derivatives) override;
  Eigen::VectorXcd recover(const ImpedanceCoefficients& factors, std::complex<double> load_amplitude,
                           const Eigen::VectorXcd& contact_forces) override;

 protected:
  /// s2 M + s1 C + s0 K.
  SparseComplex combine(const ImpedanceCoefficients& s) const;

 private:
  virtual void factorize(const ImpedanceCoefficients& factors) = 0;
  virtual Eigen::MatrixXcd solve(const Eigen::MatrixXcd& right) const = 0;

  LinearStructure structure_;
  StiffnessScale scale_;
};

}  // namespace wavebalance::solvers

#pragma once
#include <Eigen/SparseCore>

#include "structure/condensation_method.hpp"

namespace wavebalance::solvers {

/// Condensation by a factorisation of each dynamic stiffness; which one is the derived class's.
class DirectMethod : public Condensation::Method {
 public:
  using SparseComplex = Eigen::SparseMatrix<std::complex<double>>;

  explicit DirectMethod(const LinearStructure& structure)
      : structure_(structure),
        loads_(structure.load_shapes()),
        scale_(structure),
        magnitudes_{structure.mass.cwiseAbs(), structure.damping.cwiseAbs(), structure.stiffness.cwiseAbs()},
        row_sums_(structure.size(), 3),
        lengths_(direction_lengths(structure)) {
    for (std::size_t d = 0; d < 3; ++d)
      row_sums_.col(Eigen::Index(d)) = magnitudes_[d] * Eigen::VectorXd::Ones(structure.size());
  }

  int size() const override { return structure_.size(); }
  int contacts() const override { return structure_.contacts(); }
  CondensedPoint dynamic_compliance(const ImpedanceCoefficients& factors,
                                    const ImpedanceCoefficients& derivatives) override;
  Eigen::VectorXcd recover(const ImpedanceCoefficients& factors, const Eigen::VectorXcd& load_amplitudes,
                           const Eigen::VectorXcd& contact_forces) override;

 protected:
  /// s2 M + s1 C + s0 K.
  SparseComplex combine(const ImpedanceCoefficients& s) const;

 private:
  virtual void factorize(const ImpedanceCoefficients& factors) = 0;
  virtual Eigen::MatrixXcd solve(const Eigen::MatrixXcd& right) const = 0;

  // Errors of the responses to unit forces of the contacts and, in the last columns, to the loads.
  void set_errors(const ImpedanceCoefficients& factors, const Eigen::MatrixXcd& response,
                  CondensedPoint& point) const;

  LinearStructure structure_;
  Eigen::MatrixXd loads_;  // n x L
  StiffnessScale scale_;
  std::array<Eigen::SparseMatrix<double>, 3> magnitudes_;  // absolute values of M, C, K
  Eigen::MatrixX3d row_sums_;                              // of magnitudes_
  Eigen::VectorXd lengths_;                                // of the contact directions
};

}  // namespace wavebalance::solvers

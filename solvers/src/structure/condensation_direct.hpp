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
        symmetric_(structure.symmetric()),
        scale_(structure),
        magnitudes_{structure.mass.cwiseAbs(), structure.damping.cwiseAbs(), structure.stiffness.cwiseAbs()},
        row_sums_(structure.size(), 3),
        column_sums_(symmetric_ ? 0 : structure.size(), 3),
        lengths_(direction_lengths(structure)) {
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(structure.size());
    for (std::size_t d = 0; d < 3; ++d) row_sums_.col(Eigen::Index(d)) = magnitudes_[d] * ones;
    for (std::size_t d = 0; d < 3 && !symmetric_; ++d)
      column_sums_.col(Eigen::Index(d)) = magnitudes_[d].transpose() * ones;
  }

  int size() const override { return structure_.size(); }
  int contacts() const override { return structure_.contacts(); }
  CondensedPoint dynamic_compliance(const ImpedanceCoefficients& factors,
                                    const ImpedanceCoefficients& derivatives) override;
  Eigen::VectorXcd recover(const ImpedanceCoefficients& factors, const Eigen::VectorXcd& load_amplitudes,
                           const Eigen::VectorXcd& contact_forces) override;

 protected:
  /// Below this size a factorisation takes no longer than a thread.
  static constexpr int least_size_for_threads = 64;
  const LinearStructure& structure() const { return structure_; }
  /// s2 M + s1 C + s0 K.
  SparseComplex combine(const ImpedanceCoefficients& s) const;

 private:
  virtual void factorize(const ImpedanceCoefficients& factors) = 0;
  virtual Eigen::MatrixXcd solve(const Eigen::MatrixXcd& right) const = 0;
  /// Z^-T right, without conjugation, for the same factorisation.
  virtual Eigen::MatrixXcd solve_transposed(const Eigen::MatrixXcd& right) = 0;

  // Errors of the responses to unit forces of the contacts and, in the last columns, to the loads, with
  // `left` = Z^-T S^T, n x C.
  void set_errors(const ImpedanceCoefficients& factors, const Eigen::MatrixXcd& response,
                  const Eigen::MatrixXcd& left, CondensedPoint& point) const;

  LinearStructure structure_;
  Eigen::MatrixXd loads_;  // n x L
  bool symmetric_;
  StiffnessScale scale_;
  std::array<Eigen::SparseMatrix<double>, 3> magnitudes_;  // absolute values of M, C, K
  Eigen::MatrixX3d row_sums_;                              // of magnitudes_
  Eigen::MatrixX3d column_sums_;                           // of magnitudes_, if they are not symmetric
  Eigen::VectorXd lengths_;                                // of the contact directions
};

}  // namespace wavebalance::solvers

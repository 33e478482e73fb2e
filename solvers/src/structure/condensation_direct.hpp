#pragma once
#include <Eigen/SparseCore>

#include "structure/condensation_method.hpp"

namespace wavebalance::solvers {

/// Condensation by a factorisation of each dynamic stiffness; which one is the derived class's.
class DirectMethod : public Condensation::Method {
 public:
  using SparseComplex = Eigen::SparseMatrix<std::complex<double>>;

  explicit DirectMethod(const LinearStructure& structure)
      : structure_(with_all_parts(structure)),
        loads_(structure.load_shapes()),
        symmetric_(structure.symmetric()),
        scale_(structure),
        lengths_(direction_lengths(structure)) {
    for (const auto* matrix : matrices()) magnitudes_.push_back(matrix->cwiseAbs());
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(structure.size());
    const auto count = Eigen::Index(magnitudes_.size());
    row_sums_.resize(structure.size(), count);
    if (!symmetric_) column_sums_.resize(structure.size(), count);
    for (Eigen::Index d = 0; d < count; ++d) row_sums_.col(d) = magnitudes_[std::size_t(d)] * ones;
    for (Eigen::Index d = 0; d < column_sums_.cols(); ++d)
      column_sums_.col(d) = magnitudes_[std::size_t(d)].transpose() * ones;
  }

  int size() const override { return structure_.size(); }
  int contacts() const override { return structure_.contacts(); }
  CondensedPoint dynamic_compliance(const ImpedanceCoefficients& factors,
                                    const ImpedanceCoefficients& derivatives) override;
  Eigen::VectorXcd recover(const ImpedanceCoefficients& factors, const Eigen::VectorXcd& load_amplitudes,
                           const Eigen::VectorXcd& contact_forces) override;

 protected:
  /// Below this size a factorisation is as fast as creating a thread.
  static constexpr int least_size_for_threads = 64;
  const LinearStructure& structure() const { return structure_; }
  /// s2 M + s1 C + s0 K, with the parts that turn.
  SparseComplex combine(const ImpedanceCoefficients& s) const;

 private:
  virtual void factorize(const ImpedanceCoefficients& factors) = 0;
  virtual Eigen::MatrixXcd solve(const Eigen::MatrixXcd& right) const = 0;
  /// Z^-T right, without conjugation, for the same factorisation.
  virtual Eigen::MatrixXcd solve_transposed(const Eigen::MatrixXcd& right) = 0;

  // M, C and K, and of a structure that turns G and K_s, without entries where it has none.
  std::vector<const Eigen::SparseMatrix<double>*> matrices() const {
    if (!structure_.turns()) return {&structure_.mass, &structure_.damping, &structure_.stiffness};
    return {&structure_.mass, &structure_.damping, &structure_.stiffness, &structure_.turning.gyroscopic,
            &structure_.turning.stiffness};
  }
  static LinearStructure with_all_parts(LinearStructure structure) {
    if (!structure.turns()) return structure;
    const Eigen::Index size = structure.size();
    for (auto* part : {&structure.turning.gyroscopic, &structure.turning.stiffness})
      if (part->size() == 0) part->resize(size, size);
    return structure;
  }

  // Errors of the responses to unit forces of the contacts and, in the last columns, to the loads, with
  // `left` = Z^-T S^T, n x C.
  void set_errors(const ImpedanceCoefficients& factors, const Eigen::MatrixXcd& response,
                  const Eigen::MatrixXcd& left, CondensedPoint& point) const;

  LinearStructure structure_;
  Eigen::MatrixXd loads_;  // n x L
  bool symmetric_;
  StiffnessScale scale_;
  Eigen::VectorXd lengths_;                              // of the contact directions
  std::vector<Eigen::SparseMatrix<double>> magnitudes_;  // absolute values of matrices()
  Eigen::MatrixXd row_sums_;                             // of magnitudes_
  Eigen::MatrixXd column_sums_;                          // of magnitudes_, if they are not symmetric
};

}  // namespace wavebalance::solvers

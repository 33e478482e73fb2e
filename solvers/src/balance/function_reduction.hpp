#pragma once
#include <Eigen/Core>
#include <memory>

#include "balance/active_slopes.hpp"
#include "balance/reduction.hpp"
#include "wavebalance/solvers/balance/contact_operator.hpp"

namespace wavebalance::spectral {
class RealFft;
}

namespace wavebalance::solvers {

/// J = I + K D of the displacement form to the M coefficients of each of C contacts, whatever the number of
/// samples: K = U V with the compliances V from force samples to coefficients and the synthesis U of these,
/// R = V D and E = U. All of D counts, also the dependence of a force on other samples. The coefficients
/// are real and imaginary parts of the spectrum over translates. The slopes and the operator must outlive
/// the solves. One object per thread and pair.
class FunctionReduction final : public Reduction {
 public:
  FunctionReduction();
  ~FunctionReduction() override;

  /// C M.
  static Eigen::Index size(const CondensedProblem& problem);

  void set(ContactOperator& contact, ActiveSlopes& slopes);

  Eigen::Index count() const override { return size(contact_->problem()); }
  /// O(C M (N log N + C M) + entries of D times M).
  void fill(Eigen::MatrixXd& matrix) override;
  Eigen::VectorXd read(const Eigen::VectorXd& motion) override;
  Eigen::VectorXd motion(const Eigen::VectorXd& values) override;
  Eigen::VectorXd motion_transposed(const Eigen::VectorXd& row) override;

 private:
  const TimePair& pair() const { return contact_->problem().pair(); }
  void make_synthesis();
  const Eigen::VectorXcd& projection(const Eigen::VectorXd& force);
  /// V of a force of one contact, by its projection, to C M numbers.
  void add_coefficients(const Eigen::VectorXcd& projection, int from, double* coefficients);

  ContactOperator* contact_ = nullptr;
  ActiveSlopes* slopes_ = nullptr;
  std::unique_ptr<spectral::RealFft> fft_;
  Eigen::MatrixXd synthesis_;               // U of one contact, N x M
  Eigen::VectorXcd spectrum_, projection_;  // work, over samples and translates
};

}  // namespace wavebalance::solvers

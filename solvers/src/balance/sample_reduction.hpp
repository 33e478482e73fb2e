#pragma once
#include <Eigen/Core>

#include "balance/active_slopes.hpp"
#include "balance/reduction.hpp"
#include "wavebalance/solvers/balance/contact_operator.hpp"

namespace wavebalance::solvers {

/// J = I + K D to one number per active sample, D = S B (ActiveSlopes): R = B and E = K S. Both must outlive
/// the solves. E z costs one product with K.
class SampleReduction final : public Reduction {
 public:
  void set(ContactOperator& contact, ActiveSlopes& slopes) {
    contact_ = &contact;
    slopes_ = &slopes;
  }

  Eigen::Index count() const override { return slopes_->count(); }
  void fill(Eigen::MatrixXd& matrix) override;
  Eigen::VectorXd read(const Eigen::VectorXd& motion) override { return slopes_->read(motion); }
  Eigen::VectorXd motion(const Eigen::VectorXd& values) override;
  Eigen::VectorXd motion_transposed(const Eigen::VectorXd& row) override;

 private:
  ContactOperator* contact_ = nullptr;
  ActiveSlopes* slopes_ = nullptr;
  Eigen::VectorXd weighted_, product_;  // work
};

}  // namespace wavebalance::solvers

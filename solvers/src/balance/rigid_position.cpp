#include "balance/rigid_position.hpp"

namespace wavebalance::solvers {

bool RigidPosition::factorize(ContactOperator& contact, const Eigen::VectorXd& tangent, const Solve& solve) {
  const Eigen::MatrixXd& held = contact.problem().hold_response();
  const Eigen::Index count = held.cols();
  responses_.resize(held.rows(), count);
  borders_.resize(count);
  Eigen::MatrixXd matrix(count, count);
  Eigen::VectorXd x;
  for (Eigen::Index i = 0; i < count; ++i) {
    if (!solve(held.col(i), x, borders_[i])) return false;
    responses_.col(i) = x;
    matrix.col(i) = -contact.rigid_position(x, tangent.cwiseProduct(x));
    matrix(i, i) += 1.0;
  }
  capacitance_.compute(matrix);
  // Without any contact stiffness the matrix is the rounding of 1 - 1.
  constexpr double rounding = 1e-12;
  return matrix.allFinite() && !capacitance_.is_singular() &&
         (count == 0 || capacitance_.condition() < 1.0 / rounding) &&
         (count == 0 || matrix.cwiseAbs().maxCoeff() > rounding);
}

void RigidPosition::correct(const ContactOperator& contact, const Eigen::VectorXd& tangent,
                            Eigen::VectorXd& x, double& y) const {
  if (borders_.size() == 0) return;
  const Eigen::VectorXd amplitudes =
      capacitance_.solve(Eigen::VectorXd(contact.rigid_position(x, tangent.cwiseProduct(x))));
  x += responses_ * amplitudes;
  y += borders_.dot(amplitudes);
}

}  // namespace wavebalance::solvers

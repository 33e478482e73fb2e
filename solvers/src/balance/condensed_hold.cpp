#include "balance/condensed_hold.hpp"

namespace wavebalance::solvers {
const Eigen::MatrixXd& CondensedProblem::hold_response() {
  if (hold_->response.rows() > 0) return hold_->response;
  const Eigen::MatrixXd& directions = rigid_directions();
  hold_->response.resize(samples(), directions.cols());
  Eigen::VectorXd force(samples()), motion;
  for (Eigen::Index i = 0; i < directions.cols(); ++i) {
    for (int c = 0; c < contacts(); ++c)
      force.segment(c * points(), points()).setConstant(hold_->match * hold_->stiffness * directions(c, i));
    apply(force, motion);
    hold_->response.col(i) = motion;
  }
  return hold_->response;
}

Eigen::VectorXd CondensedProblem::rigid_position(const Eigen::VectorXd& unknown, const Eigen::VectorXd& force,
                                                 const Eigen::VectorXd& flexibility) const {
  Eigen::VectorXd mean(contacts());
  for (int c = 0; c < contacts(); ++c) {
    mean[c] = unknown.segment(c * points(), points()).mean();
    if (flexibility.size() > 0)
      mean[c] -= flexibility[c] / hold_->match * force.segment(c * points(), points()).mean();
  }
  return rigid_directions().transpose() * mean;
}

Eigen::VectorXd CondensedProblem::force_on_held_structure(const Eigen::VectorXd& force,
                                                          const Eigen::VectorXd& unknown,
                                                          const Eigen::VectorXd& flexibility) const {
  if (!is_free()) return force;
  const Eigen::VectorXd springs =
      hold_->match * hold_->stiffness * (rigid_directions() * rigid_position(unknown, force, flexibility));
  Eigen::VectorXd held = force;
  for (int c = 0; c < contacts(); ++c) held.segment(c * points(), points()).array() -= springs[c];
  return held;
}

const Eigen::MatrixXd& CondensedProblem::rigid_directions() const { return hold_->held.directions; }

Eigen::VectorXd CondensedProblem::balancing_force() const {
  const Eigen::VectorXd mean = free_response_.reshaped(points(), contacts()).colwise().mean();
  return hold_->match * hold_->stiffness * (rigid_directions().transpose() * mean);
}

double CondensedProblem::spring_force() const {
  return hold_->stiffness * free_response_.cwiseAbs().maxCoeff();
}

bool CondensedProblem::drift_is_balanced() const {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(structure_->size());
  if (load_harmonics_.size() > 0) load += load_harmonics_[0].real() * structure_->load;
  for (const PeriodicForce& force : structure_->forces)
    if (force.derivative == 0 && force.harmonics.size() > 0) load += force.harmonics[0].real() * force.shape;
  const Eigen::MatrixXd& drifting = hold_->held.drifting;
  constexpr double rounding = 1e-9;
  return ((drifting.transpose() * load).cwiseAbs().array() <=
          rounding * (drifting.cwiseAbs().transpose() * load.cwiseAbs()).array())
      .all();
}

}  // namespace wavebalance::solvers

#pragma once
#include <Eigen/Core>
#include <optional>

#include "period_oracle/shooting.hpp"
#include "random_motions.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"
#include "wavebalance/solvers/time/motion_evaluator.hpp"

namespace wavebalance::tolerance {

/// The tip of the periodic motion that shooting finds from the state that `found` has at t = 0, `points`
/// times; nothing when shooting does not converge. It needs no stable motion: no period is integrated before.
inline std::optional<Eigen::VectorXd> shooting_nearby(const RandomMotion& motion,
                                                      solvers::RefinementResult& found, int points) {
  const auto field = solvers::structure_motion(*found.problem, found.response, 4 * found.problem->points());
  oracle::ShootingOptions options;
  options.output_points = points;
  options.settling_periods = 0;
  options.initial_displacement = field.displacement.col(0);
  options.initial_velocity = field.velocity.col(0);
  const auto shot =
      oracle::shoot(motion.model.structure, motion.law, motion.scene.forcing.frequency, options);
  if (shot.status != oracle::ShootingStatus::converged) return std::nullopt;
  return Eigen::VectorXd(shot.contacts.displacement.row(0));
}

/// The relative rms distance of the refinement's motion from `exact`.
inline double true_error(solvers::RefinementResult& found, const Eigen::VectorXd& exact) {
  solvers::MotionEvaluator motion(found.problem->pair().trial(), static_cast<int>(exact.size()));
  const Eigen::VectorXd u = motion.displacement(found.response.coefficients.col(0));
  return (u - exact).norm() / exact.norm();
}

}  // namespace wavebalance::tolerance

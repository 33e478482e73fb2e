#pragma once
#include <Eigen/Core>
#include <memory>
#include <vector>

#include "impacts/lasting_flow.hpp"
#include "wavebalance/solvers/impacts/impact_response.hpp"

namespace wavebalance::solvers::detail {

/// What a motion with contact that lasts is evaluated by: its segments from a time on over its period.
struct LastingParts {
  std::shared_ptr<const ImpactModel> model;
  std::shared_ptr<LastingFlow> flow;
  std::vector<LastingSegment> segments;
  Eigen::VectorXcd multipliers;  ///< by falling modulus

  /// Displacements, velocities (m, m/s) and forces (N) of all contacts at a share of the period.
  struct At {
    Eigen::VectorXd displacement, velocity, force;
  };
  At at(double share) const;
  /// Adds the harmonics of the forces of closed contacts, as ImpactMotion::force_harmonics().
  void add_harmonics(Eigen::MatrixXcd& harmonics) const;
};

/// The periodic motion near a state in flight at a time (periods of the model): Newton's method on the map of
/// its period, of which perturbations are exact. O(n^3) for each step.
ImpactMotion lasting_motion(const std::shared_ptr<const ImpactModel>& model, const Eigen::VectorXd& states,
                            double time, int max_iterations);

/// What impact_response() finds where contacts without rebound stay closed.
ImpactResponse lasting_response(const ImpactsProblem& problem, const ImpactResponseOptions& options);

}  // namespace wavebalance::solvers::detail

#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>

#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

/// Static equilibrium under the static loads, with the contacts that they close.
struct RestState {
  bool converged = false;
  std::string status;            ///< "converged", or why not
  Eigen::VectorXd displacement;  ///< m, of each contact
  Eigen::VectorXd force;         ///< N, of each contact

  /// Whether nothing moves or presses.
  bool trivial() const { return converged && displacement.isZero(0.0) && force.isZero(0.0); }
};

/// The state of a scene whose structure is `model`: K x = f - S^T f_c(S x) by Newton's method and what
/// follows where that fails, with a single function of time. Nothing for a nonlinear mode without friction,
/// which has no load, and where the law has no force at rest. One static condensation.
std::optional<RestState> rest_state(const Scene& scene, const StructureModel& model);
/// The same of matrices before any reduction. One sparse factorisation.
std::optional<RestState> rest_state(const Scene& scene);

}  // namespace wavebalance::app

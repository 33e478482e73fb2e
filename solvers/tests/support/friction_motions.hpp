#pragma once
#include "support/friction_scenes.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"
#include "wavebalance/solvers/collocation/exact_structure_motion.hpp"
#include "wavebalance/solvers/flow/exact_motion.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"

namespace wavebalance::solvers::testing {

/// A balance of a scene with friction and the motion by collocation near it.
struct FrictionMotion {
  explicit FrictionMotion(const FrictionScene& which, const CollocationOptions& options = {},
                          int functions = 63, int points = 1024)
      : scene(which),
        problem(fourier_pair(functions, points), scene.structure, cosine_load()),
        dynamics(scene.structure) {
    problem.set_frequency(scene.frequency());
    response = forced_response(problem, scene.contact_laws(), {});
    if (response.converged())
      exact = exact_near_response(problem, scene.contact_laws(), response, dynamics, options, flow_motion);
  }

  FrictionScene scene;
  CondensedProblem problem;
  ContactDynamics dynamics;
  PeriodicResponse response;
  ExactNearResponse exact;
};

}  // namespace wavebalance::solvers::testing

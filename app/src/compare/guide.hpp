#pragma once
#include <optional>

#include "wavebalance/app/analysis/start_motion.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::app {

/// A response of the balance with Fourier functions, refined to a tolerance, beside which the motion of a
/// structure is sought.
struct Guide {
  solvers::ContactProblem problem;
  solvers::PeriodicResponse response;
  solvers::Motion contacts;                   ///< analysis.output_points points
  double estimated_error = solvers::missing;  ///< relative rms of the displacements
  int functions = 0, points = 0;
};

/// Nothing where the tolerance is not reached. Throws solvers::SingularSystem.
std::optional<Guide> refined_guide(const Scene& scene, const StructureModel& model, double tolerance,
                                   const solvers::Observer& observer);

/// A balance with so many Fourier functions near a start, or near the response without contact, whose error
/// is not estimated; nothing where it has not converged. Throws solvers::SingularSystem.
std::optional<Guide> sized_guide(const Scene& scene, const StructureModel& model, int functions,
                                 const solvers::Observer& observer, const StartMotion& start = {});

}  // namespace wavebalance::app

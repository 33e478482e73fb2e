#pragma once

#include "wavebalance/app/analysis/start_motion.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::app {

/// A response of the balance with Fourier functions, refined to a tolerance, from which the exact solution
/// starts.
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

/// The exact periodic solution near a balance, as accurate as it becomes.
struct ExactReference {
  std::string missing_because;  ///< empty where the motion is known
  bool refused = false;         ///< whether it is missing wherever the search starts
  solvers::Motion contacts;     ///< displacements and forces at the points of the harmonic balance
  /// Relative rms error of the displacements: the estimate, corrected by the error of the previous
  /// estimate.
  double error = solvers::missing;
  double force_error = solvers::missing;  ///< the distance from the motion found before with fewer nodes
  /// The last one that met its tolerance, for its stability.
  solvers::ExactSolution motion;
};

/// Exact solutions to tolerances that fall to 1e-12, or as far as the observer lets them.
ExactReference exact_reference(Guide& guide, const solvers::Observer& observer);

/// Why the exact solution is not available for a structure; empty if it is.
std::string exact_refusal(const StructureModel& model);

/// The exact solution at `points` uniform times.
solvers::Motion sampled(const solvers::ExactSolution& motion, int points);

/// Why the exact solution is not known, a phrase.
std::string phrase_of(solvers::ExactStatus status);

}  // namespace wavebalance::app

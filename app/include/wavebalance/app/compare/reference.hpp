#pragma once
#include <string>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/analysis/start_motion.hpp"
#include "wavebalance/app/compare/error_measure.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::app {

/// The response that others are measured against: which one it is and how accurate.
struct Reference {
  bool converged = false;
  std::string kind;    ///< "linear", "phases" or "finer_balance"; empty if none was found
  std::string status;  ///< "converged" or why not
  std::string text;    ///< what it is, for a sentence: "collocation"
  /// Estimated relative rms errors of its displacements and forces: smaller differences from it are not
  /// significant. The error of the forces is NaN if it is not known or no force acts.
  double error = solvers::missing, force_error = solvers::missing;
  solvers::Motion motion;  ///< displacements and forces of all contacts, without velocities
  ResponseStability stability;
  /// Why the exact solution is not the reference, a phrase; empty where it is, and where contact never
  /// closes.
  std::string without_phases;
  /// Whether Newton's method from the response without contact finds a balance with few functions. If not,
  /// the time of a solve from there does not depend on its size only.
  bool reached_directly = true;
  double wall_seconds = 0.0;

  double error_by(ErrorMeasure measure) const { return weighed_error(measure, error, force_error); }
};

/// The reference of a scene's forced response at `points` uniform times, a power of two:
///
///   contact never closes in the response without contact   that response
///   elastic laws, rigid ones of contacts without mass      exact periodic solution
///   everything else, and where no such motion is found     the balance with Fourier functions, refined
///
/// Exact solutions start from harmonic balance with an error of 1e-3, or 1e-4 if that fails. With rigid
/// contact 15, 31 and 63 functions are tried before, because the force oscillates with more. They are
/// solved to tolerances down to 1e-12, and once more with more nodes. The error of the forces is the
/// difference of the last two; the error of the displacements is the estimate, corrected by the error of
/// the previous estimate. They use a third of `seconds` (wall time). Structures with reduced dynamics are
/// not supported. The exact solution is accepted only near the finest balance, because there may be several
/// motions.
///
/// The balance is refined to tolerances of 1e-2 to 1e-8 until `seconds` are used; the error of its
/// displacements is the estimate of the refinement, the error of its forces the difference of the last two
/// levels.
///
/// With a start the balances begin with it instead of the linear response, and have 31 to 255 functions;
/// the error of each is its distance from the one before. An observer that returns false leaves the
/// reference not converged, with the status "interrupted". Throws what weighted_residual_response() throws.
Reference find_reference(const Scene& scene, const StructureModel& model, int points, double seconds,
                         const solvers::Observer& observer = {}, const StartMotion& start = {});

}  // namespace wavebalance::app

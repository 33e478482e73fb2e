#pragma once
#include <string>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::app {

/// The response that others are measured against: which one it is and how accurate.
struct Reference {
  bool converged = false;
  std::string kind;    ///< "linear", "shooting", "rigid_flows" or "finer_balance"; empty if none was found
  std::string status;  ///< "converged" or why not
  std::string text;    ///< what it is, for a sentence: "shooting"
  /// Estimated relative rms error of its displacements: smaller differences from it say nothing.
  double error = solvers::missing;
  solvers::Motion motion;  ///< displacements and forces of all contacts, without velocities
  ResponseStability stability;
  double wall_seconds = 0.0;
};

/// The reference of a scene's forced response at `points` uniform times, a power of two:
///
///   contact never closes in the response without contact       that response
///   one contact with an elastic law                            shooting
///   a bar against a rigid obstacle                             free and closed linear motion in turn
///   everything else, and where these find no such motion       the balance with Fourier functions, refined
///
/// Shooting starts from a balance and is taken only where it stays close to it, since there may be several
/// motions; so are the linear motions in turn. The balance is refined to tolerances of 1e-2 to 1e-8 until
/// `seconds` (wall time) are used; its error is that which the refinement estimates. An observer that returns
/// false leaves the reference not converged, with the status "interrupted". Throws what
/// weighted_residual_response() throws.
Reference find_reference(const Scene& scene, const StructureModel& model, int points, double seconds,
                         const solvers::Observer& observer = {});

/// shooting_response() as a reference.
Reference shooting_reference(const Scene& scene);

/// Two linear motions joined where the contact opens and closes, of a structure that has one contact, without
/// mass, at its last degree of freedom. Twice the points tell its error, and whether a contact is shorter
/// than the distance of two points. Not converged after 1000 periods.
Reference rigid_flows_reference(const Scene& scene, const StructureModel& model, int points);

}  // namespace wavebalance::app

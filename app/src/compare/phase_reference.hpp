#pragma once
#include <string>

#include "compare/guide.hpp"
#include "wavebalance/solvers/phases/contact_phases.hpp"

namespace wavebalance::app {

/// The motion of the structure near a balance by its contact phases, as accurate as they become.
struct PhaseReference {
  std::string missing_because;  ///< empty where the motion is known
  bool refused = false;         ///< whether it is missing wherever the search starts
  solvers::Motion contacts;     ///< displacements and forces at as many points as those of the balance
  /// Relative rms of the displacements: the estimate, times what that of the motion before was too small by.
  double error = solvers::missing;
  double force_error = solvers::missing;  ///< the distance from the motion found before with fewer nodes
  /// The last one that met its tolerance, for its stability.
  solvers::PhaseMotion motion;
};

/// Phases to tolerances that fall to 1e-12, or as far as the observer lets them.
PhaseReference phase_reference(Guide& guide, const solvers::Observer& observer);

/// Why contact phases are not sought in a structure; empty where they are.
std::string phases_refusal(const StructureModel& model);

/// Contact phases at `points` uniform times.
solvers::Motion sampled(const solvers::PhaseMotion& motion, int points);

/// Why the phases are not known, a phrase.
std::string phrase_of(solvers::PhasesStatus status);

}  // namespace wavebalance::app

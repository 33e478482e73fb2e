#pragma once
#include <map>
#include <vector>

#include "wavebalance/solvers/impacts/impact_response.hpp"

namespace wavebalance::solvers {

/// From where the motions with impacts of one load are sought, and how far.
struct ImpactMotionsOptions {
  int random_starts = 24;    ///< states from which the structure settles, beside the one clear of obstacles
  unsigned seed = 20140817;  ///< of these states: the same ones for the same seed
  int longest = 4;           ///< periods of the load after which a motion may repeat
  Observer observer = {};    ///< called once per period integrated

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// One of the motions of a load.
struct CoexistingImpacts {
  ImpactResponse response;
  bool from_random = false;  ///< a random start settled to it first
  bool settled = false;  ///< a start settled to it; otherwise Newton's method found it near one that passed
  int arrivals = 0;      ///< random starts that settle to it
};

/// The motions found.
struct ImpactMotions {
  /// Converged where there are motions; else what became of the motion that is clear of all obstacles at
  /// first.
  PhasesStatus status = PhasesStatus::not_settled;
  std::vector<CoexistingImpacts> motions;  ///< in the order in which they were found
  int starts = 0;                          ///< random ones that were taken
  /// How many of these settle to no motion that is solved for, by what they ended with.
  std::map<PhasesStatus, int> none;
};

/// The periodic motions with impacts of one load: those that impact_response() settles to, from where the
/// motion without contact is clear of all obstacles and from random states, and those, stable or not, that
/// Newton's method finds near the closest returns of each of these motions in time. The states are uniform in
/// discs of the poles whose radii are twice those of the first motion found, or of the free vibration after
/// an impact with the speed of the motion without contact where these are larger; states beyond an obstacle
/// are drawn again. Two motions are the same where instants and impulses agree to 1e-6, also by whole periods
/// of the load later. Neither unstable motions nor those of small basins are certain to be found.
///
/// Throws std::invalid_argument as impact_response() and for options out of range. An impact_response() for
/// each start.
ImpactMotions impact_motions(const PhasesProblem& problem, const ImpactMotionsOptions& options = {});

}  // namespace wavebalance::solvers

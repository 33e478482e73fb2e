#pragma once
#include <map>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/problem/contact_problem.hpp"

namespace wavebalance::solvers {

/// Options of the search for coexisting motions.
struct MotionsOptions {
  int random_starts = 24;    ///< random states to integrate from, in addition to rest
  unsigned seed = 20140817;  ///< of these states: the same ones for the same seed
  int longest = 4;           ///< periods of the load after which a motion may repeat
  double tolerance = 1e-9;   ///< of each motion, CollocationOptions::tolerance
  Observer observer{};       ///< called with each period integrated and each step of Newton's method

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// The first method that found a motion.
enum class MotionSource {
  rest,    ///< the structure converges to it from rest
  random,  ///< or from a random state
  newton   ///< Newton's method from between motions, or near states that nearly return
};

std::string_view to_string(MotionSource source);

/// One of the motions of a frequency.
struct CoexistingMotion {
  ExactSolution motion;  ///< over `periods` periods of the load
  int periods = 1;       ///< after which it repeats, and no fewer
  MotionStability stability;
  double max_displacement = 0.0;  ///< of any contact at 256 instants of each period of the load, m
  double max_force = 0.0;         ///< likewise, N
  MotionSource found_by = MotionSource::rest;
  int arrivals = 0;  ///< random starts that converge to it
  /// arrivals / starts: how much of the states it attracts, and the standard error sqrt(p (1 - p) / n). NaN
  /// without random starts.
  double share = missing, share_error = missing;
};

enum class MotionsStatus {
  converged,    ///< there are motions, and all starts were taken
  not_settled,  ///< no start converges to a motion that repeats within the options' limits
  not_solved,   ///< starts do, or nearly, and collocation solve for none of them
  no_modes,     ///< the structure has no modes to compute
  cancelled     ///< the observer returned false; the motions are those found before
};

std::string_view to_string(MotionsStatus status);

/// How far random states are from the middle of their box in one mode: its largest part in the displacement
/// (m) and the velocity (m/s) of any degree of freedom.
struct BoxSide {
  double displacement = 0.0, velocity = 0.0;
};

/// A motion that starts converge to, by integration, and that collocation do not solve for.
struct UnsolvedMotion {
  ExactStatus status = ExactStatus::not_found;     ///< with which collocation ended
  int periods = 1;                                 ///< of the load, after which it repeats
  double max_displacement = 0.0, max_force = 0.0;  ///< of any contact, m, N
  int arrivals = 0;                                ///< random starts that converge to it
};

/// The motions found at one frequency.
struct CoexistingMotions {
  MotionsStatus status = MotionsStatus::not_settled;
  std::vector<CoexistingMotion> motions;  ///< in the order in which they were found
  std::vector<UnsolvedMotion> unsolved;   ///< likewise
  int starts = 0;                         ///< random ones that were taken
  int none = 0;                           ///< of these, those that converge to none of the motions
  /// `none` by their last status, and the status of the start from rest where that has no motion.
  std::map<ExactStatus, int> none_by;
  ExactStatus first = ExactStatus::converged;
  std::vector<BoxSide> box;  ///< of the random states, by mode
};

/// The periodic motions at a forcing frequency: attractors reached from rest and from random states, and
/// unstable motions between them. The states are uniform in a box of the modes around the static
/// deflection. Its half sides are twice the largest displacements and velocities of three motions: the
/// attractor, the linear response enlarged until it reaches a gap, and the resonant vibrations that the
/// laws move to this frequency. Motions are solved for by collocation, so that two are the same where their
/// displacements agree to 1e-6, also after a shift by whole forcing periods. A start whose integration
/// comes within 1e-4 of the vibration of a stable one counts there. Without a collocation solution the
/// integrated motion is returned.
///
/// Unstable motions are searched for at the boundaries between basins [J. D. Skufca, J. A. Yorke, B.
/// Eckhardt, Phys. Rev. Lett. 96, 2006, doi:10.1103/PhysRevLett.96.174101]: two states that converge to
/// different motions are bisected until the motion between them stays near an unstable one for long, from
/// which Newton's method starts. It has the forcing period or the period of the two. Others are midway
/// between a motion of several periods and its shifted copy, or near states that nearly return if rest
/// leads to no periodic motion. Neither they nor motions with small basins are certain to be found.
///
/// Throws std::invalid_argument for options out of range and a problem of several forcing periods. Cost: a
/// settle() for each start, and up to 26 for each pair of attractors, as well as shorter ones.
CoexistingMotions coexisting_motions(ContactProblem& problem, double frequency,
                                     const MotionsOptions& options = {});

/// The same for motions solved from event to event: impacts, also with other laws, friction of a free
/// structure, and rigid friction at a contact with mass. With impacts only, integration begins where the
/// linear response is farthest from all obstacles, otherwise at rest. The states are uniform in discs of
/// the poles. Their radii cover twice the first motion found, or the free vibration after an impact with
/// the speed of the linear response if that is larger; states beyond an obstacle are drawn again. With
/// impacts only, motions near the closest returns are also solved for, stable or not. Motions are identical
/// if displacements agree to 1e-6, for free structures relative to their means.
///
/// Throws std::invalid_argument as impact_response() or attractor_motion(). One of these for each start.
CoexistingMotions event_motions(const ExactProblem& problem, const MotionsOptions& options = {});

}  // namespace wavebalance::solvers

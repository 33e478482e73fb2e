#pragma once
#include <string_view>
#include <vector>

#include "wavebalance/solvers/problem/contact_problem.hpp"

namespace wavebalance::solvers {

/// From where the motions of one frequency are sought, and how far.
struct MotionsOptions {
  int random_starts = 24;    ///< states from which the structure settles, beside that of rest
  unsigned seed = 20140817;  ///< of these states: the same ones for the same seed
  int longest = 4;           ///< periods of the load after which a motion may repeat
  double tolerance = 1e-9;   ///< of each motion, ContactPhasesOptions::tolerance
  Observer observer{};       ///< called with each period integrated and each step of Newton's method

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// What a motion was found by first.
enum class MotionSource {
  rest,    ///< the structure settles to it from rest
  random,  ///< or from a random state
  newton   ///< Newton's method from states between motions, or from ones that nearly return
};

std::string_view to_string(MotionSource source);

/// One of the motions of a frequency.
struct CoexistingMotion {
  PhaseMotion motion;  ///< over `periods` periods of the load
  int periods = 1;     ///< after which it repeats, and no fewer
  MotionStability stability;
  double max_displacement = 0.0;  ///< of any contact, m
  double max_force = 0.0;         ///< N
  MotionSource found_by = MotionSource::rest;
  int arrivals = 0;  ///< random starts that settle to it
  /// arrivals / starts: how much of the states it attracts, and the standard error sqrt(p (1 - p) / n). NaN
  /// without random starts.
  double share = missing, share_error = missing;
};

enum class MotionsStatus {
  converged,  ///< there are motions, and all starts were taken
  no_motion,  ///< no start settles to a motion that contact phases solve for
  no_modes,   ///< the structure has no modes to compute
  cancelled   ///< the observer returned false; the motions are those found before
};

std::string_view to_string(MotionsStatus status);

/// The motions found at one frequency.
struct CoexistingMotions {
  MotionsStatus status = MotionsStatus::no_motion;
  std::vector<CoexistingMotion> motions;  ///< in the order in which they were found
  int starts = 0;                         ///< random ones that were taken
  int none = 0;  ///< of these, those that settle to nothing, or to what contact phases do not solve for
};

/// The periodic motions at a frequency of the load: those that the structure settles to from rest and from
/// random states, and unstable ones between them. The states are uniform in a box of the modes, whose
/// displacements and velocities are up to twice the largest of the motion without contact and of the one
/// settled to from rest. Each motion is solved for by contact phases, so that two are the same where their
/// displacements agree to 1e-6, also by whole periods of the load later.
///
/// Unstable motions are sought by Newton's method from u_1 + a (u_2 - u_1) between any two motions found, or
/// one and itself periods later, and from states that nearly return where the structure settles to none.
/// Neither they nor motions of small basins are certain to be found.
///
/// `problem` must be one of a single period of its load, or std::invalid_argument is thrown, as for options
/// out of range. A settle() for each start.
CoexistingMotions coexisting_motions(ContactProblem& problem, double frequency,
                                     const MotionsOptions& options = {});

}  // namespace wavebalance::solvers

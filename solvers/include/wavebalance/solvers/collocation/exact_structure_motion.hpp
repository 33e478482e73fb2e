#pragma once

#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::solvers {

/// How the whole structure's motion is summed up.
struct ExactStructureOptions {
  /// Relative rms error of the displacements of the contacts by the harmonics that are left out.
  double tolerance = 1e-9;
  int first_harmonics = 256;  ///< summed at first; the number is doubled until the tolerance is met
  int max_harmonics = 16384;

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// The motion of all degrees of freedom in a motion by collocation.
struct ExactStructureMotion {
  Motion motion;      ///< n x points, without forces
  int harmonics = 0;  ///< that were summed up
  /// The relative rms distance of the displacements of the contacts from ExactSolution::displacement(). If
  /// all modes of the structure are known, it is the truncation error. The error of the velocities is
  /// larger by about the ratio of the number of harmonics to the harmonic of the motion.
  double left_out = 0.0;
};

/// Each harmonic follows from harmonics of load and contact forces, which are exact,
/// ExactSolution::force_harmonics(). With elastic contact and mass everywhere the harmonics k of the
/// displacements fall like 1 / k^4, and the rest beyond H like 1 / H^3.5. At a contact without mass they
/// fall like 1 / k^2.
///
/// `problem` belongs to the motion, at its frequency and load. Throws std::invalid_argument for points
/// below 1, options out of range and a motion that is not known, and SingularSystem. A condensation and O(n
/// (H + points log points)).
ExactStructureMotion exact_structure_motion(const CondensedProblem& problem, const ExactSolution& motion,
                                            int points, const ExactStructureOptions& options = {});

}  // namespace wavebalance::solvers

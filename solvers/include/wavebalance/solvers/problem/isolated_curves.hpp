#pragma once
#include <vector>

#include "wavebalance/solvers/problem/contact_problem.hpp"

namespace wavebalance::solvers {

/// Extent of the search for isolated branches.
struct IsolatedCurvesOptions {
  FrequencySweepOptions sweep;  ///< as for the known curves; its observer is called for all work
  /// Hz, largest spacing of the frequencies of the search; 0: a 20th of the interval. They are midpoints of
  /// equal parts, so every wider branch contains one.
  double spacing = 0.0;
  int random_starts = 4;     ///< at each frequency: random states to integrate from, in addition to rest
  unsigned seed = 20140817;  ///< of these states: the same ones for the same seed
  /// A longer start ends where it is; Newton's method often converges from there.
  AttractorOptions settling{.max_operations = 1e9, .max_returns = 4, .observer = {}};

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// A branch through a motion that is on no known branch.
struct IsolatedCurve {
  double found_at = 0.0;  ///< Hz, where the structure converges to a motion of it, or comes near to one
  int start = 0;  ///< start of the integration: 0 rest, the number of the random state, or -1: a resonance
  /// From one of its ends to the other, or once around. Its status is `reached_end` where the ends lie on
  /// both ends of the interval, `returned` where they lie on one, and otherwise what stopped it.
  FrequencySweep curve;
  /// An end of it lies on a curve that was known: a step on one of the two was too long.
  bool meets_known = false;
};

/// The isolated branches that were found.
struct IsolatedCurves {
  std::vector<IsolatedCurve> curves;
  std::vector<double> frequencies;  ///< Hz, at which motions were searched for
  std::vector<double>
      unmatched;           ///< Hz, where the structure converges to a motion without a response near it
  bool cancelled = false;  ///< the observer returned false
};

/// Searches for curves of responses other than `known`, which frequency_sweep() followed with keep_unknowns
/// on the same problem. At each frequency the motion is integrated from rest and from random states, of the
/// box of coexisting_motions(). Newton's method solves for responses near resonant vibrations that the laws
/// move to that frequency, near the motions that the structure converges to, near unstable ones that it
/// comes close to (AttractorMotion::returns), and where its operations run out near its last period. A
/// response is on a curve if one of responses_at() there, also shifted by forcing periods, differs from it
/// by at most a hundredth of the vibration. One that is on no curve is followed both ways, and counts as
/// known from then on.
///
/// Curves narrower than the spacing, curves with unstable motions only, and curves that attract few states
/// may be missed. Throws std::invalid_argument for options out of range and as frequency_sweep() does.
/// Cost: a settle() for each start.
IsolatedCurves isolated_curves(ContactProblem& problem, const std::vector<const FrequencySweep*>& known,
                               const IsolatedCurvesOptions& options);

}  // namespace wavebalance::solvers

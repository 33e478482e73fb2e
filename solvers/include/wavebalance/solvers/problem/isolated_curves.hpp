#pragma once
#include <vector>

#include "wavebalance/solvers/problem/contact_problem.hpp"

namespace wavebalance::solvers {

/// Extent of the search for isolated branches.
struct IsolatedCurvesOptions {
  FrequencySweepOptions sweep;  ///< those of the curves known; its observer sees all that is done
  /// Hz, largest spacing of the frequencies of the search; 0: a 20th of the interval. They are midpoints of
  /// equal parts, so every wider branch contains one.
  double spacing = 0.0;
  int random_starts = 4;     ///< at each frequency: states from which the structure settles, beside rest
  unsigned seed = 20140817;  ///< of these states: the same ones for the same seed
  /// A start that takes longer ends where it is, from where Newton's method often arrives: with 1e10
  /// operations a pipe with 23 degrees of freedom took seven times as long, and its curves were the same.
  AttractorOptions settling{.max_operations = 1e9, .max_returns = 4, .observer = {}};

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// A branch through a motion that is on no known branch.
struct IsolatedCurve {
  double found_at = 0.0;  ///< Hz, where the structure converges to a motion of it, or comes near to one
  int start = 0;  ///< what it settled from there: 0 rest, the number of the random state, or -1: a resonance
  /// From one of its ends to the other, or once around. Its status is `reached_end` where the ends lie on
  /// both ends of the interval, `returned` where they lie on one, and otherwise what stopped it.
  FrequencySweep curve;
  /// An end of it lies on a curve that was known: a step on one of the two was too long.
  bool meets_known = false;
};

/// The isolated branches that were found.
struct IsolatedCurves {
  std::vector<IsolatedCurve> curves;
  std::vector<double> frequencies;  ///< Hz, at which motions were sought
  std::vector<double>
      unmatched;           ///< Hz, where the structure converges to a motion without a response near it
  bool cancelled = false;  ///< the observer returned false
};

/// Seeks curves of responses beside `known`, which frequency_sweep() followed with keep_unknowns on the same
/// problem. At each frequency the structure settles from rest and from random states, of the box of
/// coexisting_motions(). Newton's method solves for responses near resonant vibrations that the laws move to
/// that frequency, near the motions that the structure converges to, near
/// unstable ones that it comes close to (AttractorMotion::returns), and where its operations run out near its
/// last period. A response is on a curve where one of responses_at() there differs from it, also later by
/// what the load takes to repeat, by at most a hundredth of what vibrates. One that is on no curve is
/// followed both ways, and counts as known from then on.
///
/// Curves narrower than the spacing, those whose motions are all unstable, and those that attract few states
/// may be missed. Throws std::invalid_argument for options out of range and as frequency_sweep() does. A
/// settle() for each start.
IsolatedCurves isolated_curves(ContactProblem& problem, const std::vector<const FrequencySweep*>& known,
                               const IsolatedCurvesOptions& options);

}  // namespace wavebalance::solvers

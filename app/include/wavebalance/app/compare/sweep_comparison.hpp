#pragma once
#include <optional>
#include <string>
#include <vector>

#include "wavebalance/app/compare/comparison.hpp"

namespace wavebalance::app {

/// A curve of responses over the frequency or the amplitude of the load in one pair and size.
struct ComparedCurve {
  BasisPair pair;
  int functions = 0, points = 0;  ///< M and N
  std::string
      status;  ///< of the sweep, "reached_end" where it was solved; "out_of_time" if the budget ended it
  double seconds = solvers::missing;   ///< processor time of its thread, once
  std::vector<double> varied;          ///< frequency (Hz) or amplitude along the curve
  std::vector<double> displacement;    ///< m, the largest over the period and the contacts
  int turning_points = 0;              ///< at which the curve reverses
  double peak = solvers::missing;      ///< m, the largest displacement
  double peak_at = solvers::missing;   ///< frequency (Hz) or amplitude there
  double distance = solvers::missing;  ///< from the finest curve, see curve_distance(); NaN without it
  double distance_from_exact = solvers::missing;  ///< NaN without SweepComparison::exact

  bool converged() const { return status == "reached_end"; }
};

/// A sweep in several pairs and sizes.
struct SweepComparison {
  bool interrupted = false;
  std::vector<ComparedCurve> curves;     ///< by rising functions, all pairs of each
  std::optional<std::size_t> finest;     ///< the first of most functions that reached the end
  std::optional<ComparedCurve> exact;    ///< the exact curve, exact_sweep(), without a pair
  std::vector<PairResult> inadmissible;  ///< of common_pairs()
  std::string quantity = "frequency";    ///< that varies, or "amplitude"
  std::string unit = "Hz";               ///< of it; of an amplitude "N", "m" or "m/s^2"
  std::string axis = "Frequency (Hz)";   ///< its label
  /// Column of the place of the peak; of amplitudes "amplitude_at_max_displacement_N", _m or _m_per_s2.
  std::string peak_column = "frequency_at_max_displacement_Hz";
  double wall_seconds = 0.0;

  bool converged() const { return finest.has_value() && !interrupted; }
  std::string status() const { return interrupted ? "interrupted" : finest ? "converged" : "no_curve"; }
};

/// Follows the curve of the scene's sweep in each pair with 8, 16, ... functions, a pair of Fourier functions
/// with one less, and the points per function of the scene, to largest_functions or 16384 or until the budget
/// is used. Before them, for a fifth of the budget at most, the curve of the structure itself, where phases
/// of contact follow it from one end to the other. Pairs are followed together, one in each thread; a
/// curve and its digits do not depend on the others. The observer is called by one thread at a time. Throws
/// as check_comparison().
SweepComparison compare_sweeps(const Scene& scene, const ComparisonOptions& options,
                               const solvers::Observer& observer = {});

/// Largest distance of a point of one curve from the other, both ways, in a plane where the interval
/// of the sweep and the largest displacement of `b` have length one. NaN for an empty curve. O(points of a
/// times points of b).
double curve_distance(const ComparedCurve& a, const ComparedCurve& b, double interval);

}  // namespace wavebalance::app

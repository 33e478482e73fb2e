#pragma once
#include <string>
#include <vector>

#include "wavebalance/app/compare/comparison.hpp"
#include "wavebalance/app/compare/sweep_comparison.hpp"
#include "wavebalance/app/files/summary.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {

/// The results of a comparison, ready to be written and shown.
struct ComparisonRecord {
  bool converged = false;
  bool interrupted = false;
  std::string status;
  std::vector<std::string> warnings;  ///< also in the summary
  Summary summary;
  Reference reference;                          ///< of responses
  std::vector<Recommendation> recommendations;  ///< of responses, for each requested error
  std::string peak_column, peak_unit;  ///< of sweeps: the table's column of where a peak is, and its unit
  Table table;                         ///< comparison.csv: a row for each solve or curve
  std::vector<RecordPicture> pictures;
  std::string text;      ///< what a terminal shows: reference, sentences and [time] tables
  std::string markdown;  ///< the same with the table of pairs
};

ComparisonRecord comparison_record(const Scene& scene, const Comparison& comparison);
ComparisonRecord comparison_record(const Scene& scene, const SweepComparison& comparison);

/// trial, weight, functions, points, tolerance, inner_products, construction_seconds, seconds, error,
/// displacement_error, force_error, below_reference, converged, status, on_front. Exact solutions have the
/// trial "phases", the functions and points of the balance that they start from, and a tolerance.
Table points_table(const Comparison& comparison);
/// trial, weight, admissible, solves, converged, largest_functions, smallest_error, order, force_order,
/// order_points_per_function, failures: the reason of an inadmissible pair is its failure.
Table pairs_table(const Comparison& comparison);
/// error, error_of, trial, weight, functions, quadrature_points, seconds, displacement_error, force_error,
/// fourier_functions, fourier_seconds, fourier_time_ratio, basis_matters, phases_functions, phases_points,
/// phases_seconds, phases_error, stability, sentences, time_table. Entries of phases exist if the exact
/// solution is faster than the choice.
Table recommendations_table(const std::vector<Recommendation>& recommendations);
/// trial, weight, functions, points, seconds, curve_points, max_displacement_m,
/// comparison.peak_column, turning_points, distance_from_finest, distance_from_exact, status.
Table curves_table(const SweepComparison& comparison);

/// Compares the scene's responses or sweeps, by its analysis, and returns the record. Throws as
/// check_comparison().
ComparisonRecord compare_bases(const Scene& scene, const ComparisonOptions& options,
                               const solvers::Observer& observer = {});

}  // namespace wavebalance::app

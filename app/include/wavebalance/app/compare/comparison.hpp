#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/files/summary.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"

namespace wavebalance::app {

/// The cheapest converged weighted residual with at most this error, of those whose next size, if it was
/// solved, has converged with at most this error too: a single size may be close to the reference by chance.
/// Where there is none of these, the cheapest of all. Times differ by a tenth from run to run, so that within
/// a tenth the one of the same pair with the fewest functions is taken.
std::optional<SolvePoint> cheapest(const std::vector<SolvePoint>& points, double error);
/// Whether the next size of its series, with twice the functions and points, keeps to the error, or is none.
bool is_steady(const SolvePoint& point, const std::vector<SolvePoint>& points, double error);

/// How the cheapest choice of an error compares with Fourier functions on both sides.
enum class BasisMatters {
  no_choice,      ///< no pair reaches the error
  little,         ///< Fourier:Fourier is the choice, or at most twice its time gives it 1.5 times the error
  much,           ///< Fourier:Fourier takes more than twice its time
  fourier_fails,  ///< Fourier:Fourier does not reach the error
  not_compared    ///< Fourier:Fourier is not among the pairs
};

std::string_view to_string(BasisMatters value);

/// The recommendation for one requested error.
struct Recommendation {
  double error = 0.0;                                 ///< relative rms
  ErrorMeasure measure = ErrorMeasure::displacement;  ///< of what
  /// The cheapest solve, or Fourier:Fourier if at most a tenth slower; empty if no pair reaches the error.
  std::optional<SolvePoint> choice;
  std::optional<SolvePoint> fourier;  ///< the cheapest of Fourier:Fourier
  /// The cheapest of all other pairs, if the choice is Fourier:Fourier; or one with at most twice the time
  /// and 1.5 times the error of the choice, if that is faster.
  std::optional<SolvePoint> runner_up;
  /// One with at most half the time and 1.5 times the error of the choice.
  std::optional<SolvePoint> near_miss;
  /// Fourier:Fourier with at most twice the time and 1.5 times the error of the choice.
  std::optional<SolvePoint> fourier_near_miss;
  /// The fastest exact solution, if it is faster than the choice, or no pair reaches the error.
  std::optional<SolvePoint> exact;
  BasisMatters matters = BasisMatters::no_choice;
  std::string sentences;   ///< two, and one on the exact solution where it is faster
  std::string time_table;  ///< "[time]\ntrial = ...": to be pasted into a scene; empty without a choice
  std::string stability;   ///< of the choice's motion; empty where it was not computed

  /// Time of Fourier:Fourier over the time of the choice; NaN without one of them.
  double fourier_time_ratio() const;
};

/// Largest fraction of a requested error that the reference may have.
inline constexpr double known_share = 0.25;

/// The recommendation from points whose errors are relative to a reference with a known error. If that is
/// above a quarter of `error`, no pair is known to reach it. `time` holds the common settings of all
/// points, `measure` the meaning of SolvePoint::error.
Recommendation recommend(const std::vector<SolvePoint>& points, double error, double reference_error,
                         const Time& time, ErrorMeasure measure = ErrorMeasure::displacement);

/// Options of a comparison.
struct ComparisonOptions {
  std::vector<BasisPair> pairs;  ///< empty: every admissible one of common_pairs()
  double budget = 10.0;          ///< s, wall time of everything, > 0
  int first_functions = 4;       ///< a power of two
  int largest_functions = 1 << 15;
  std::vector<int> points_per_function = {1, 2, 4, 8};
  std::vector<double> errors = {1e-2, 1e-4, 1e-6};  ///< for which a choice is recommended
  /// Error that decides; empty: both if the force error is defined, else the displacement error.
  std::optional<ErrorMeasure> measure = {};
  int threads = 0;         ///< that solve pairs together; 0: one per core
  StartMotion start = {};  ///< near which the reference and a sweep begin; empty: as a run without a start
};

/// How a pair did in all its sizes.
struct PairResult {
  BasisPair pair;
  std::string inadmissible;                  ///< the reason; empty for an admissible pair
  int solves = 0;                            ///< sizes solved
  int converged = 0;                         ///< of these
  int largest_functions = 0;                 ///< solved
  double smallest_error = solvers::missing;  ///< SolvePoint::error
  /// Observed orders over the functions, of displacements and forces, with the most points per function
  /// that have three errors above the reference's error: over the last four of them. NaN without three.
  double order = solvers::missing, force_order = solvers::missing;
  int order_points_per_function = 0;  ///< of these orders
  std::string failures = {};  ///< "2 stalled (4 to 8 functions), 1 cancelled (1024 functions)", or empty
};

/// A forced response in several pairs and sizes.
struct Comparison {
  bool interrupted = false;
  Reference reference;
  /// Whether each solve begins with the motion of the reference: with a start, and where it is not
  /// Reference::reached_directly.
  bool from_reference = false;
  ErrorMeasure measure = ErrorMeasure::displacement;  ///< which error decides
  std::string
      without_force;  ///< why the force is left out, a phrase; empty if it decides or was not requested
  bool force_asked = false;        ///< by ComparisonOptions::measure, and not by default
  std::vector<SolvePoint> points;  ///< those solved, with on_front, exact solutions first
  std::vector<PairResult> pairs;   ///< exact solutions after the admissible ones, the inadmissible ones last
  std::vector<Recommendation> recommendations;
  double wall_seconds = 0.0;

  /// A reference was found, with which others could be compared.
  bool converged() const { return reference.converged && !interrupted && !points.empty(); }
  /// "converged", "interrupted", "no_time" if the reference left none for the pairs, or the status of a
  /// reference that was not found.
  std::string status() const {
    if (interrupted) return "interrupted";
    return reference.converged && points.empty() ? "no_time" : reference.status;
  }
};

/// Throws std::invalid_argument with the reason if one of the pairs named is not admissible in the scene,
/// the budget is not positive, the threads are negative, an error is named for a sweep, the scene cannot
/// begin with the start, or it is none to be compared: forced responses, frequency and amplitude sweeps
/// over one period of the load are. O(pairs).
void check_comparison(const Scene& scene, const ComparisonOptions& options);

/// Compares the pairs of the options in a forced response. The scene's own pair, functions, points and
/// tolerance have no effect; formulation, inner products and Nyquist coefficient hold for all. The
/// reference gets a tenth of the budget, or three tenths if it is a refined balance. An exact reference is
/// also solved to several tolerances in addition to the pairs, for at most a tenth of the budget. Times are
/// processor seconds of the thread that solves; digits do not depend on the threads. The observer is called
/// by one thread at a time, not always this one; when it returns false the comparison ends with what was
/// measured so far. Throws as check_comparison().
Comparison compare_responses(const Scene& scene, const ComparisonOptions& options,
                             const solvers::Observer& observer = {});

/// The pairs that are compared, and the other ones of common_pairs() with the reasons.
struct SplitPairs {
  std::vector<BasisPair> admissible;
  std::vector<PairResult> others;
};
/// Splits the pairs of the options, or common_pairs(), by whether they are admissible.
SplitPairs split_pairs(const Scene& scene, const ComparisonOptions& options);

/// Results of each pair, in the order of `pairs`; `points` as size_study() returns them.
std::vector<PairResult> pair_results(const std::vector<BasisPair>& pairs,
                                     const std::vector<SolvePoint>& points, double reference_error);

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
/// is used. Before them, for a fifth of the budget at most, the curve of the structure itself, where exact
/// solutions follow it from one end to the other. Pairs are followed together, one in each thread;
/// a curve and its digits do not depend on the others. The observer is called by one thread at a time. Throws
/// as check_comparison().
SweepComparison compare_sweeps(const Scene& scene, const ComparisonOptions& options,
                               const solvers::Observer& observer = {});

/// Largest distance of a point of one curve from the other, both ways, in a plane where the interval
/// of the sweep and the largest displacement of `b` have length one. NaN for an empty curve. O(points of a
/// times points of b).
double curve_distance(const ComparedCurve& a, const ComparedCurve& b, double interval);

/// Pareto front of a pair in time and error, styled.
Series best_of(const BasisPair& pair, const std::vector<SolvePoint>& points);
/// The Pareto front over everything, as a grey band.
Series pareto_front(const std::vector<SolvePoint>& points);

/// Fourier:Fourier where it is among `pairs`, then those with the most points on the front, `most` at most.
std::vector<BasisPair> leading_pairs(std::vector<BasisPair> pairs, const std::vector<SolvePoint>& points,
                                     std::size_t most);

/// Errors over solve times, with the front, and over functions: for each number the smallest error of all
/// numbers of points; over times of the six leading pairs and the exact solution. The dotted line is the
/// error of the reference. Points that have not converged are not drawn.
Figure error_over_time(const Comparison& comparison);
Figure error_over_functions(const Comparison& comparison);

/// The curve of most functions of each pair that reached its end, largest displacements over frequencies, and
/// the distances from the finest curve over functions.
Figure curves_figure(const SweepComparison& comparison);

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
/// phases_seconds, phases_error, stability, sentences, time_table. Entries of exact solutions exist if the
/// exact solution is faster than the choice.
Table recommendations_table(const std::vector<Recommendation>& recommendations);
/// trial, weight, functions, points, seconds, curve_points, max_displacement_m,
/// comparison.peak_column, turning_points, distance_from_finest, distance_from_exact, status.
Table curves_table(const SweepComparison& comparison);

/// Compares the scene's responses or sweeps, by its analysis, and returns the record. Throws as
/// check_comparison().
ComparisonRecord compare_bases(const Scene& scene, const ComparisonOptions& options,
                               const solvers::Observer& observer = {});

}  // namespace wavebalance::app

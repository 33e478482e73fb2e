#pragma once
#include <optional>
#include <string>
#include <vector>

#include "wavebalance/app/compare/basis_pair.hpp"
#include "wavebalance/app/compare/recommendation.hpp"
#include "wavebalance/app/compare/reference.hpp"
#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"

namespace wavebalance::app {

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
  std::vector<SolvePoint> points;  ///< those solved, with on_front, phases first
  std::vector<PairResult> pairs;   ///< phases after the admissible ones, the inadmissible ones last
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

}  // namespace wavebalance::app

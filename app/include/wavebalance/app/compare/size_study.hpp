#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "wavebalance/app/analysis/start_motion.hpp"
#include "wavebalance/app/compare/error_measure.hpp"
#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/compare/stopwatch.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::app {

/// Subject of a comparison: a scene, its structure composed before, and its reference response.
struct MeasuredScene {
  Scene scene;
  StructureModel model;
  /// Displacements and forces of all contacts at uniform points; no forces where they are not compared.
  solvers::Motion reference;
  ErrorMeasure measure = ErrorMeasure::displacement;  ///< which error decides
  StartMotion start = {};                             ///< of each solve; empty: the response without contact
};

/// Which sizes are solved and how each is timed.
struct SizeStudyOptions {
  std::vector<int> functions;            ///< rising powers of two
  std::vector<int> points_per_function;  ///< rising
  double max_seconds = 1.0;              ///< s: longer solves are not started, and a homotopy ends there
  double smallest_error = 0.0;           ///< a series of sizes ends at the first one with no larger error
  Repetition solve = {};
  Repetition construction = {.budget = 0.0, .least = 2, .max_seconds = 0.1};
  /// Whether an even number of Fourier functions, whose Nyquist coefficient the scene drops, is left out if
  /// the odd number with the same functions is used.
  bool without_equals = true;
  /// > 0: a solve ends after so many times the fastest converged time with as many functions and points,
  /// ten times as many for Fourier:Fourier, but not before 5 ms. It has not converged then.
  double longest_ratio = 0.0;
  /// > 0: a series of sizes ends, except for Fourier:Fourier, with the second size in a row, of 64
  /// functions or 10 ms or more, that fails or takes so many times as long as another solve with no larger
  /// error.
  double dominated_ratio = 0.0;
  int threads = 1;  ///< that solve the pairs of a size together; 0: one per core
  /// Called before each size with its pair as the phase, by one thread at a time. No size is begun after it
  /// has returned false, and one that was begun is `not_run`.
  solvers::Observer observer = {};
};

/// The scene in every pair over functions and points, a pair of Fourier functions also with one function
/// less: an odd number has no Nyquist coefficient. Sizes rise for all pairs together, so that an early end
/// leaves all of them equally far, with a dominated_ratio leading pairs first. Rows are ordered by series.
std::vector<SolvePoint> size_study(const MeasuredScene& measured, const std::vector<BasisPair>& pairs,
                                   const SizeStudyOptions& options);

/// The scene with another pair and sizes, or with them instead of its tolerance.
Scene discretised(Scene scene, const BasisPair& pair, int functions, int points);

/// The problem before its condensation, which is part of a solve.
solvers::ContactProblem uncondensed_problem(const Scene& scene, const StructureModel& model);

/// The samples of a start in a scene's sizes; none of an empty motion.
solvers::ResponseStart response_start(const StartMotion& start, const Scene& scene);

/// The response of a scene's problem near a start, or near the response without contact, with the
/// condensation.
solvers::PeriodicResponse response_near(const Scene& scene, solvers::ContactProblem& problem,
                                        const solvers::ResponseStart& start,
                                        const solvers::Observer& observer);

/// A scene's own pair and sizes, not solved yet.
SolvePoint unsolved_point(const Scene& scene);

/// The problem of an unsolved point, which is given the time of its construction; nothing, with the status
/// "refused", of a pair that has as many Fourier functions as points at the middles.
std::optional<solvers::ContactProblem> timed_problem(const MeasuredScene& measured, const Scene& scene,
                                                     const Repetition& repetition, SolvePoint& point);

/// Sets the time of `solve`. False, with the status "singular", where it throws solvers::SingularSystem.
bool time_solve(const std::function<void()>& solve, const Repetition& repetition, SolvePoint& point);

/// Sets the errors of a motion, which are at least the errors of the reference where these are given.
void set_errors(const MeasuredScene& measured, const solvers::Motion& motion, SolvePoint& point,
                double least_displacement = 0.0, double least_force = 0.0);

/// Relative rms errors of all contacts together; NaN where the reference is zero or missing.
double displacement_error(const solvers::Motion& motion, const solvers::Motion& reference);
double force_error(const solvers::Motion& motion, const solvers::Motion& reference);

}  // namespace wavebalance::app

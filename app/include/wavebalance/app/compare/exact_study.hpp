#pragma once
#include <vector>

#include "wavebalance/app/compare/reference.hpp"
#include "wavebalance/app/compare/size_study.hpp"

namespace wavebalance::app {

/// To what tolerances exact solutions are computed and how that is timed.
struct ExactStudyOptions {
  std::vector<double> tolerances = {1e-2, 1e-4, 1e-6, 1e-8, 1e-10};
  int first_functions = 31;  ///< of the coarsest harmonic balance used as a start
  int largest_functions = 1023;
  double max_seconds = 1.0;  ///< s: after a longer solve no finer start is tried
  Repetition solve = {};
  Repetition construction = {.budget = 0.0, .least = 1, .max_seconds = 0.0};
  /// Called before each solve with what is solved as the phase, and within it. The solve ends `cancelled`
  /// when it returns false, and no other is begun.
  solvers::Observer observer = {};
};

/// The exact periodic solution of the scene, from nothing: a balance with M Fourier functions
/// and 4 (M + 1) points from the linear response, the poles of the structure, and the phases near the
/// balance. The balance is the one from which phases to a tolerance of 1e-6 are found soonest, of 31, 63, ...
/// functions until the time rises; those from which the phases are not found are among the rows. Then come
/// the other tolerances. Errors are those against the reference, which has more nodes, and no smaller than
/// its own.
std::vector<SolvePoint> phase_study(const MeasuredScene& measured, const Reference& reference,
                                    const ExactStudyOptions& options);

}  // namespace wavebalance::app

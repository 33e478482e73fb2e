#pragma once
#include <limits>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::solvers {

/// How time stepping ended.
enum class TimeSteppingStatus {
  converged,         ///< two successive periods agree
  subharmonic,       ///< the motion repeats after several periods, TimeSteppingResult::attractor_periods
  iteration_limit,   ///< max_periods was reached, or would need more than max_operations
  tolerance_missed,  ///< max_periods was reached, and the last two periods differ by the errors of panels
  step_failure,      ///< the integrator found no step that meets its tolerance
  grows,             ///< displacements leave every bound
  cancelled          ///< the observer returned false
};

std::string_view to_string(TimeSteppingStatus status);

/// How long and how finely a motion is integrated.
struct TimeSteppingOptions {
  int output_points = 1024;        ///< uniform samples of one period, also those that periods are compared on
  double period_tolerance = 1e-7;  ///< on the relative rms difference of two periods [JL14, section 4]
  int max_periods = 2000;          ///< periods integrated at most
  /// Estimated floating-point operations: the integration ends where max_periods would need more.
  double max_operations = std::numeric_limits<double>::infinity();
  int longest = 16;  ///< periods after which a motion may repeat; 1 integrates on until two agree
  /// Called after each period with its number, from 1, and its relative rms difference to the one before
  /// (infinity after the first).
  Observer observer;

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// The last period integrated.
struct TimeSteppingResult {
  TimeSteppingStatus status = TimeSteppingStatus::iteration_limit;
  int periods = 0;  ///< complete periods integrated
  /// Periods after which the motion repeats: 1 if converged; 0 where max_periods ended without any, as for
  /// aperiodic motions and for transients; -1 where fewer periods were integrated.
  int attractor_periods = -1;
  /// Relative rms difference of the contact displacements of periods i+2 and i+1; periods - 1 entries.
  std::vector<double> period_error;
  Motion contacts;  ///< the last complete period of all contacts; empty when there is none
};

}  // namespace wavebalance::solvers

#pragma once
#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::solvers {

/// How time stepping ended.
enum class TimeSteppingStatus {
  converged,         ///< two successive periods agree
  subharmonic,       ///< the motion repeats after several periods, TimeSteppingResult::attractor_periods
  iteration_limit,   ///< max_periods or max_steps_per_period was reached
  tolerance_missed,  ///< max_periods was reached, and the last two periods differ by the errors of the steps
  step_failure,      ///< the integrator found no step that meets its tolerance
  cancelled          ///< the observer returned false
};

std::string_view to_string(TimeSteppingStatus status);

/// How long and how finely a motion is integrated.
struct TimeSteppingOptions {
  int output_points = 1024;        ///< uniform samples of one period, also those that periods are compared on
  double period_tolerance = 1e-7;  ///< on the relative rms difference of two periods [JL14, section 4]
  int max_periods = 2000;          ///< periods integrated at most
  int longest = 16;  ///< periods after which a motion may repeat; 1 integrates on until two agree
  int max_steps_per_period = 200000;  ///< steps accepted at most, on average over the periods so far
  double step_tolerance = 1e-10;      ///< local error of a step, relative to the state
  double step_floor = 1e-2;   ///< states below step_floor * (largest linear response) count as that large
  bool full_history = false;  ///< also keep every degree of freedom over the last period
  Eigen::VectorXd initial_displacement;  ///< n, m; empty: zero
  Eigen::VectorXd initial_velocity;      ///< n, m/s; empty: zero
  /// Called after each period with its number, from 1, and its relative rms difference to the one before
  /// (infinity after the first).
  Observer observer;

  /// Throws std::invalid_argument for a number out of its range, or for initial values that are not `dofs`.
  void validate(int dofs) const;
};

/// The last period integrated.
struct TimeSteppingResult {
  TimeSteppingStatus status = TimeSteppingStatus::iteration_limit;
  int periods = 0;  ///< complete periods integrated
  /// Periods after which the motion repeats: 1 if converged; 0 where max_periods ended without any, as an
  /// aperiodic motion does and one that still settles; -1 where fewer periods were integrated.
  int attractor_periods = -1;
  long steps = 0;         ///< accepted steps
  long failed_steps = 0;  ///< steps tried and rejected
  /// Relative rms difference of the contact displacements of periods i+2 and i+1; periods - 1 entries.
  std::vector<double> period_error;
  Motion contacts;   ///< the last complete period of all contacts; empty when there is none
  Motion structure;  ///< the same of all n degrees of freedom, without forces; with full_history only
};

/// Integrates M u'' + C u' + K u = load cos(2 pi f t) + forces - sum_c e_c f_c(u_c) [JL14, eq. (7)] until two
/// successive periods of the contact displacements differ by less than period_tolerance in relative rms. The
/// integrator is the variable-step, variable-order (1..5) backward differentiation of GSL (msbdf) with the
/// analytic Jacobian; [JL14, section 4] used the closely related NDF. Steps do not end at output times:
/// samples come from the quintic that matches displacement, velocity and acceleration at both ends of a step.
///
/// A motion repeats after p periods, up to `longest`, if it agrees likewise with that p periods ago. For p >
/// 1 at least 50 periods have passed, and any two of the last p periods differ a hundred times as much, and
/// as much as they did 16 or more periods ago.
///
/// The periods needed are about log(period_tolerance) / log(multiplier), with the modulus of the leading
/// Floquet multiplier; the distance to the periodic motion is then about multiplier / (1 - multiplier)
/// times the last difference, or more with complex multipliers. Two periods cannot agree better than the
/// steps are accurate: period_tolerance should exceed 100 step_tolerance. Cost: O(n^2) per step and O(n^3)
/// about every twenty steps, O(n^2) memory: for structures of up to a few hundred degrees of freedom.
///
/// GSL's error handler, which would end the program and is one per process, is switched off during the call
/// and then restored.
///
/// Throws std::invalid_argument when the structure or the laws do not fit together, its mass is not positive
/// definite, frequency_hz (Hz) is not positive and finite, or an option is out of range.
TimeSteppingResult integrate_to_periodic(const LinearStructure& structure, const ContactLaws& laws,
                                         double frequency_hz, const TimeSteppingOptions& options = {});

}  // namespace wavebalance::solvers

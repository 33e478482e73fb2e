#include "wavebalance/solvers/period/time_stepping.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "linalg/enum_table.hpp"
#include "linalg/option_checks.hpp"
#include "period/bdf_map.hpp"
#include "period/past_periods.hpp"

namespace wavebalance::solvers {
namespace {

/// Whether two periods differ by no more than the errors of their steps, which a tenth of the tolerance
/// shows: they then cannot agree any better.
bool is_noise(BdfMap& map, const PeriodState& begin, const TimeSteppingOptions& options, double change,
              const Motion& last) {
  constexpr double finer = 0.1, accumulated = 100.0;
  const double operations = map.operations_of_step() * options.max_steps_per_period;
  const Period again = map.advance(begin, {finer * options.step_tolerance, operations});
  if (!again.complete()) return false;
  return change * last.displacement.norm() <=
         accumulated * (again.contacts.displacement - last.displacement).norm();
}

/// Integrates period after period until the motion repeats.
TimeSteppingStatus run(BdfMap& map, PeriodState state, const TimeSteppingOptions& options,
                       TimeSteppingResult& result) {
  PastPeriods past(options.longest, options.period_tolerance);
  PeriodState begin;
  while (result.periods < options.max_periods) {
    const double steps = double(options.max_steps_per_period) * (result.periods + 1) - double(map.steps());
    Period period = map.advance(state, {options.step_tolerance, map.operations_of_step() * steps});
    if (period.ended == Period::End::step_failure) return TimeSteppingStatus::step_failure;
    if (!period.complete()) return TimeSteppingStatus::iteration_limit;
    begin = std::exchange(state, std::move(period.state));
    past.add(period.contacts.displacement);
    result.contacts = std::move(period.contacts);
    if (++result.periods > 1) result.period_error.push_back(past.change());
    const double done = std::log(past.change()) / std::log(options.period_tolerance);
    const bool stop =
        !goes_on(options.observer, {"time stepping", result.periods, past.change(),
                                    "relative difference of periods", std::clamp(done, 0.0, 1.0)});
    const int repeats = past.repeats();
    if (repeats > 0) result.attractor_periods = repeats;
    if (repeats > 0) return repeats == 1 ? TimeSteppingStatus::converged : TimeSteppingStatus::subharmonic;
    if (stop) return TimeSteppingStatus::cancelled;
  }
  return is_noise(map, begin, options, past.change(), result.contacts) ? TimeSteppingStatus::tolerance_missed
                                                                       : TimeSteppingStatus::iteration_limit;
}

}  // namespace

std::string_view to_string(TimeSteppingStatus status) {
  using enum TimeSteppingStatus;
  return detail::name_in<TimeSteppingStatus>({{converged, "converged"},
                                              {subharmonic, "subharmonic"},
                                              {iteration_limit, "iteration_limit"},
                                              {tolerance_missed, "tolerance_missed"},
                                              {step_failure, "step_failure"},
                                              {cancelled, "cancelled"}},
                                             status);
}

void TimeSteppingOptions::validate(int dofs) const {
  constexpr const char* who = "TimeSteppingOptions";
  detail::require_at_least(who, "output_points", output_points, 2);
  detail::require_positive(who, "period_tolerance", period_tolerance);
  detail::require_at_least(who, "max_periods", max_periods, 1);
  detail::require_at_least(who, "longest", longest, 1);
  detail::require_at_least(who, "max_steps_per_period", max_steps_per_period, 1);
  detail::require_positive(who, "step_tolerance", step_tolerance);
  detail::require_positive(who, "step_floor", step_floor);
  detail::require_dofs(who, "initial_displacement", initial_displacement, dofs);
  detail::require_dofs(who, "initial_velocity", initial_velocity, dofs);
}

TimeSteppingResult integrate_to_periodic(const LinearStructure& structure, const ContactLaws& laws,
                                         double frequency_hz, const TimeSteppingOptions& options) {
  detail::require_positive("integrate_to_periodic", "frequency_hz", frequency_hz);
  structure.validate();
  options.validate(structure.size());
  BdfMap map(structure, laws, frequency_hz, options.output_points, options.step_floor);
  TimeSteppingResult result;
  result.status =
      run(map, map.state(options.initial_displacement, options.initial_velocity, structure.size()), options,
          result);
  if (options.full_history && result.periods > 0) result.structure = map.structure();
  const bool long_enough = result.periods == options.max_periods && result.periods > 2 * options.longest;
  if (result.status == TimeSteppingStatus::iteration_limit && long_enough) result.attractor_periods = 0;
  result.steps = map.steps();
  result.failed_steps = map.failed_steps();
  return result;
}

}  // namespace wavebalance::solvers

#include "wavebalance/solvers/period/time_stepping.hpp"

#include "linalg/enum_table.hpp"
#include "linalg/option_checks.hpp"

namespace wavebalance::solvers {
std::string_view to_string(TimeSteppingStatus status) {
  using enum TimeSteppingStatus;
  return detail::name_in<TimeSteppingStatus>({{converged, "converged"},
                                              {subharmonic, "subharmonic"},
                                              {iteration_limit, "iteration_limit"},
                                              {tolerance_missed, "tolerance_missed"},
                                              {step_failure, "step_failure"},
                                              {grows, "grows"},
                                              {cancelled, "cancelled"}},
                                             status);
}

void TimeSteppingOptions::validate() const {
  constexpr const char* who = "TimeSteppingOptions";
  detail::require_at_least(who, "output_points", output_points, 2);
  detail::require_positive(who, "period_tolerance", period_tolerance);
  detail::require_at_least(who, "max_periods", max_periods, 1);
  if (!(max_operations > 0.0)) detail::reject(who, "max_operations", max_operations, "positive");
  detail::require_at_least(who, "longest", longest, 1);
}

}  // namespace wavebalance::solvers

#pragma once
#include <stdexcept>
#include <string>

#include "wavebalance/solvers/period/time_stepping.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"

/// Solutions that a test needs: where there is none, it ends with the status.
namespace wavebalance::solvers::testing {

template <class... Guess>
PeriodicResponse solved_response(CondensedProblem& problem, const ContactLaws& laws,
                                 const ForcedResponseOptions& options = {}, const Guess&... guess) {
  PeriodicResponse response = forced_response(problem, laws, options, guess...);
  if (!response.converged())
    throw std::runtime_error("no response: " + std::string(to_string(response.status)));
  return response;
}

/// An interval of frequencies (Hz) or of load scales, whose points keep their unknowns.
inline FrequencySweepOptions between(double from, double to) {
  FrequencySweepOptions options;
  options.from = from;
  options.to = to;
  options.keep_unknowns = true;
  return options;
}

inline FrequencySweep complete_sweep(CondensedProblem& problem, const ContactLaws& laws,
                                     const FrequencySweepOptions& options) {
  FrequencySweep sweep = frequency_sweep(problem, laws, options);
  if (sweep.status != SweepStatus::reached_end)
    throw std::runtime_error("no complete curve: " + std::string(to_string(sweep.status)));
  return sweep;
}

inline TimeSteppingResult stepped_motion(const LinearStructure& structure, const ContactLaws& laws,
                                         double frequency, int points) {
  TimeSteppingOptions options;
  options.output_points = points;
  TimeSteppingResult result = integrate_to_periodic(structure, laws, frequency, options);
  if (result.status != TimeSteppingStatus::converged)
    throw std::runtime_error("no motion in time: " + std::string(to_string(result.status)));
  return result;
}

}  // namespace wavebalance::solvers::testing

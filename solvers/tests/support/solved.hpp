#pragma once
#include <stdexcept>
#include <string>

#include "support/small_problems.hpp"
#include "wavebalance/solvers/flow/periodic_flow.hpp"
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

/// The motion in time from event to event, without a basis in time and samples.
inline TimeSteppingResult stepped_motion(const LinearStructure& structure, const ContactLaws& laws,
                                         double frequency, int points) {
  const CondensedProblem problem = fourier_problem(structure, 7, 32, frequency);
  TimeSteppingOptions options;
  options.output_points = points;
  TimeSteppingResult result =
      integrate_by_events(problem, ContactDynamics(structure), laws, options).stepping;
  if (result.status != TimeSteppingStatus::converged)
    throw std::runtime_error("no motion in time: " + std::string(to_string(result.status)));
  return result;
}

}  // namespace wavebalance::solvers::testing

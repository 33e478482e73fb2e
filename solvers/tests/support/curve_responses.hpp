#pragma once
#include <vector>

#include "wavebalance/solvers/continuation/arc_length.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"

namespace wavebalance::solvers::testing {

/// The responses at `targets` (Hz) in the order in which the response curve passes them from the frequency
/// `from` on, towards growing frequencies at first. Fewer where the curve ends or `max_points` are not
/// enough.
inline std::vector<PeriodicResponse> responses_along(CondensedProblem& problem, const ContactLaws& laws,
                                                     double from, const std::vector<double>& targets,
                                                     double parameter_scale = 30.0, int max_points = 4000) {
  std::vector<PeriodicResponse> found;
  ForcedResponseOptions options;
  options.form = ContactForm::displacement;
  problem.set_frequency(from);
  const PeriodicResponse start = forced_response(problem, laws, options);
  if (!start.converged()) return found;
  options.fallbacks = false;
  ContactSystem system(problem, laws);
  const FrequencyParameter parameter;
  ArcLength curve(system, parameter,
                  {.displacement_scale = laws.largest_gap(), .parameter_scale = parameter_scale});
  if (curve.start(start.displacement, from, 1.0) != ArcLength::Status::advanced) return found;
  for (int i = 0; i < max_points && found.size() < targets.size(); ++i) {
    if (curve.advance() != ArcLength::Status::advanced) break;
    double last = 0.0;  // the curve passes a target once in a step
    while (found.size() < targets.size() && targets[found.size()] != last) {
      const double target = targets[found.size()];
      if ((curve.previous().parameter - target) * (curve.point().parameter - target) > 0.0) break;
      last = target;
      CurvePoint at;
      if (!curve.locate([&](const CurvePoint& point) { return point.parameter - target; }, at)) return found;
      problem.set_frequency(target);
      found.push_back(forced_response(problem, laws, options, at.displacement));
    }
  }
  return found;
}

}  // namespace wavebalance::solvers::testing

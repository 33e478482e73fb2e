#include "wavebalance/solvers/problem/exact_along.hpp"

#include "linalg/option_checks.hpp"
#include "problem/thread_problems.hpp"
#include "wavebalance/solvers/linalg/parallel_for.hpp"

namespace wavebalance::solvers {
namespace {

ExactAtPoint exact_at(ContactProblem& problem, const FrequencySweep& curve, const CurvePlace& place,
                      const ExactAlongOptions& options, bool kept) {
  const PeriodicResponse response = problem.response(curve, place.value, place.unknown);
  const ExactNearResponse found = exact_near(problem, response, options).value();
  ExactAtPoint result{found.motion.status, found.displacement_error, found.force_error, {}, 0, {}};
  if (kept && found.motion.parts != nullptr) result.motion = found.motion;
  if (options.stability && found.motion.converged())
    result.stability = problem.stability(response, &found.motion);
  return result;
}

ExactAtPoint exact_near_place(ContactProblem& problem, const FrequencySweep& curve,
                              const std::vector<CurvePlace>& places, const ExactAlongOptions& options,
                              bool kept) {
  ExactAtPoint first;
  for (std::size_t i = 0; i < places.size(); ++i) {
    ExactAtPoint found = exact_at(problem, curve, places[i], options, kept);
    found.place = i;
    if (found.status != ExactStatus::not_found) return found;
    if (i == 0) first = std::move(found);
  }
  return first;
}

}  // namespace

void ExactAlongOptions::validate() const {
  exact.validate();
  detail::require_positive("ExactAlongOptions", "max_distance", max_distance);
  thread_count(threads);
}

std::optional<ExactNearResponse> exact_near(ContactProblem& problem, const PeriodicResponse& response,
                                            const ExactAlongOptions& options) {
  std::optional<ExactNearResponse> found = problem.exact_near(response, options.exact);
  if (!found || !(found->displacement_error > options.max_distance)) return found;
  return ExactNearResponse{ExactSolution(), missing, missing};
}

ExactAlongCurve exact_along(const ProblemMaker& make, const FrequencySweep& curve,
                            const std::vector<std::vector<CurvePlace>>& places,
                            const ExactAlongOptions& options) {
  options.validate();
  ExactAlongCurve result;
  std::vector<ContactProblem> problems = detail::thread_problems(make, places.size(), options.threads);
  if (places.empty() || problems.front().dynamics() == nullptr) return result;
  result.points.resize(places.size());
  detail::PlacesProgress progress(options.observer, "exact solution",
                                  unit_of(problems.front().condensed(), curve.parameter));
  detail::at_places(
      problems, places.size(), progress, [&](ContactProblem& problem, std::size_t i, const Observer&) {
        result.points[i] = exact_near_place(problem, curve, places[i], options, options.kept == i);
        return places[i].front().value;
      });
  result.cancelled = progress.cancelled();
  return result;
}

}  // namespace wavebalance::solvers

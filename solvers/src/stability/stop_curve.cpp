#include "stability/stop_curve.hpp"

#include <numbers>
#include <utility>

#include "stability/floquet_determinant.hpp"

namespace wavebalance::solvers {

StopCurve::StopCurve(const ContactDynamics& dynamics, detail::LinearStops stops)
    : dynamics_(dynamics), motions_(dynamics, std::move(stops)) {}

std::optional<StopCurve> StopCurve::of(const CondensedProblem& problem, const ContactLaws& laws,
                                       const ContactDynamics& dynamics, const StabilityOptions& options) {
  const bool known = !dynamics.reduced() && !dynamics.structurally_damped() && dynamics.holding() == 0.0 &&
                     2 * int(dynamics.poles().size()) <= options.max_states;
  if (!known || laws.follow_frequency() || problem.structure().turns()) return std::nullopt;
  auto stops = detail::linear_stops(laws, problem.contacts());
  if (!stops) return std::nullopt;
  return StopCurve(dynamics, *std::move(stops));
}

bool StopCurve::is_needed(const PeriodicStiffness& stiffness, double frequency,
                          const StabilityOptions& options) const {
  return stiffness.status == StabilityStatus::converged &&
         !has_undamped_pole(dynamics_, 2.0 * std::numbers::pi * frequency) &&
         !harmonics_resolve(dynamics_, stiffness, frequency, options.harmonics, options.max_omitted);
}

std::optional<Eigen::MatrixXd> StopCurve::map_beside(const CondensedProblem& problem,
                                                     const PeriodicResponse& response,
                                                     const PeriodicStiffness& stiffness) {
  constexpr double farthest = 0.1;  // of motions of one kind
  if (!free_) free_.emplace(problem.structure(), problem.load_harmonics(), 0.0);
  const Eigen::MatrixXcd free = free_->at(problem.frequency(), problem.load_factor());
  const Eigen::MatrixXd displacement = response.displacement.reshaped(problem.points(), problem.contacts());
  auto found = motions_.near(
      {stiffness.intervals, free, response.frequency, displacement, problem.pair().first_sample()});
  if (!found || !(found->distance <= farthest)) return std::nullopt;
  return std::move(found->map);
}

}  // namespace wavebalance::solvers

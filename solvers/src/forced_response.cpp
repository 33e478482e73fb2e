#include "wavebalance/solvers/forced_response.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "wavebalance/solvers/arc_length.hpp"

namespace wavebalance::solvers {
namespace {

double rms(const Eigen::VectorXd& values) { return values.norm() / std::sqrt(double(values.size())); }

ArcLengthOptions homotopy_options(ContactSystem& system) {
  ArcLengthOptions options;
  options.displacement_scale = std::max(rms(system.problem().free_response()), system.laws().largest_gap());
  options.parameter_scale = 4.0;
  options.largest_step = 0.25;
  options.smallest_step = 1e-5;
  options.largest_angle = 0.6;
  options.corners = Corners::where_needed;
  return options;
}

// Follows the solution from a nearly vanishing law to the law itself; true when `u` is a start for it.
bool follow_stiffness(ContactSystem& system, Eigen::VectorXd& u, const ForcedResponseOptions& options,
                      int& iterations) {
  const double softest = std::log(1e-8);
  const StiffnessParameter parameter;
  u = system.problem().free_response();
  parameter.set(system, softest);
  const NewtonResult first = newton(system, u, options.newton);
  iterations += first.iterations;
  if (first.status != SolveStatus::converged) return false;
  ArcLength curve(system, parameter, homotopy_options(system));
  if (curve.start(u, softest, 1.0) != ArcLength::Status::advanced) return false;
  for (int step = 0; step < options.homotopy_steps; ++step) {
    if (curve.advance() != ArcLength::Status::advanced) return false;
    ++iterations;
    const CurvePoint& point = curve.point();
    if (options.observer && !options.observer("homotopy", step, point.residual)) return false;
    if (point.parameter < softest) return false;
    if (point.parameter < 0.0) continue;
    CurvePoint landed;
    const bool located = curve.locate([](const CurvePoint& p) { return p.parameter; }, landed);
    u = located ? landed.displacement : point.displacement;
    return true;
  }
  return false;
}

void require_start(const CondensedProblem& problem, const Eigen::VectorXd& guess) {
  if (problem.frequency() == 0.0)
    throw std::invalid_argument(
        "forced_response: the problem has no frequency yet; call set_frequency first");
  if (guess.size() != 0 && guess.size() != problem.samples())
    throw std::invalid_argument("forced_response: guess has " + std::to_string(guess.size()) +
                                " samples; it must be empty or have the problem's " +
                                std::to_string(problem.samples()));
}

}  // namespace

PeriodicResponse forced_response(CondensedProblem& problem, const ContactLaws& laws,
                                 const ForcedResponseOptions& options, const Eigen::VectorXd& guess) {
  require_start(problem, guess);
  ContactSystem system(problem, laws);
  PeriodicResponse response;
  response.frequency = problem.frequency();
  Eigen::VectorXd u = guess.size() != 0 ? guess : problem.free_response();
  NewtonResult result = newton(system, u, options.newton);
  response.iterations = result.iterations;
  if (result.status != SolveStatus::converged && options.homotopy) {
    response.used_homotopy = true;
    Eigen::VectorXd followed;
    const bool found = follow_stiffness(system, followed, options, response.iterations);
    system.set_stiffness_factor(1.0);
    if (found) {
      NewtonResult retry = newton(system, followed, options.newton);
      response.iterations += retry.iterations;
      if (retry.residual < result.residual) {
        result = std::move(retry);
        u = followed;
      }
    }
    system.evaluate(u);
  }
  response.status = result.status;
  response.residual = result.residual;
  response.residual_history = std::move(result.residual_history);
  response.condition = result.condition;
  response.contact_force = system.force();
  response.coefficients = problem.coefficients(system.force());
  response.displacement = std::move(u);
  return response;
}

}  // namespace wavebalance::solvers

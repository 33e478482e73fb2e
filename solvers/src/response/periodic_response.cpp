#include "wavebalance/solvers/response/periodic_response.hpp"

#include <utility>

namespace wavebalance::solvers {

std::string_view to_string(Strategy strategy) {
  switch (strategy) {
    case Strategy::none:
      return "none";
    case Strategy::newton:
      return "newton";
    case Strategy::gap_continuation:
      return "gap_continuation";
    case Strategy::load_continuation:
      return "load_continuation";
    case Strategy::settling:
      return "settling";
    case Strategy::recurrence:
      return "recurrence";
    case Strategy::residual_homotopy:
      return "residual_homotopy";
    case Strategy::perturbation:
      return "perturbation";
  }
  return "unknown";
}

PeriodicResponse response_at(ContactSystem& system, Eigen::VectorXd unknown) {
  const CondensedProblem& problem = system.problem();
  PeriodicResponse response;
  response.status = SolveStatus::converged;
  response.residual = system.evaluate(unknown);
  response.frequency = problem.frequency();
  response.load_scale = problem.load_scale();
  response.contact_force = system.force();
  response.held_force = system.held_force();
  response.coefficients = system.problem().coefficients(response.held_force);
  response.unknown_coefficients = system.unknown_coefficients();
  response.regularization = system.regularization();
  response.displacement =
      response.regularization.size() == 0 ? unknown : system.problem().displacement(response.held_force);
  response.unknown = std::move(unknown);
  return response;
}

}  // namespace wavebalance::solvers

#include "wavebalance/solvers/response/periodic_response.hpp"

#include <utility>

#include "linalg/enum_table.hpp"

namespace wavebalance::solvers {

std::string_view to_string(Strategy strategy) {
  using enum Strategy;
  return detail::name_in<Strategy>({{none, "none"},
                                    {newton, "newton"},
                                    {stiffness_continuation, "stiffness_continuation"},
                                    {gap_continuation, "gap_continuation"},
                                    {load_continuation, "load_continuation"},
                                    {sticking, "sticking"},
                                    {settling, "settling"},
                                    {recurrence, "recurrence"},
                                    {residual_homotopy, "residual_homotopy"},
                                    {perturbation, "perturbation"}},
                                   strategy);
}

PeriodicResponse response_at(ContactSystem& system, Eigen::VectorXd unknown) {
  const CondensedProblem& problem = system.problem();
  PeriodicResponse response;
  response.status = SolveStatus::converged;
  response.residual = system.evaluate(unknown);
  response.frequency = problem.frequency();
  response.load_scale = problem.load_scale();
  response.contact_force = system.force();
  response.force_on_held_structure = system.force_on_held_structure();
  response.coefficients = system.problem().coefficients(response.force_on_held_structure);
  response.unknown_coefficients = system.unknown_coefficients();
  response.series_flexibility = system.series_flexibility();
  response.displacement = response.series_flexibility.size() == 0
                              ? unknown
                              : system.problem().displacement(response.force_on_held_structure);
  response.unknown = std::move(unknown);
  return response;
}

}  // namespace wavebalance::solvers

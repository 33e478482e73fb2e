#include "wavebalance/solvers/collocation/exact_near_response.hpp"

#include <algorithm>

#include "balance/free_contacts.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"

namespace wavebalance::solvers {
namespace {

double relative_distance(const Eigen::MatrixXd& values, const Eigen::MatrixXd& exact) {
  const double size = exact.norm();
  return size > 0.0 ? (values - exact).norm() / size : missing;
}

}  // namespace

ExactProblem exact_problem(const CondensedProblem& problem, const ContactLaws& laws,
                           const ContactDynamics& dynamics) {
  detail::FreeContacts free(problem.structure(), problem.load_harmonics(), dynamics.holding());
  return {dynamics, laws.at(problem.load_frequency()), free.at(problem.frequency(), problem.load_factor()),
          problem.frequency()};
}

ExactNearResponse exact_near_response(const CondensedProblem& problem, const PeriodicResponse& response,
                                      const ExactProblem& exact, const CollocationOptions& options,
                                      IntervalFinder find) {
  // A start needs no more, but fewer alias the force of a damper that rises within a small depth.
  constexpr int least_points = 256, enough = 1024, enough_of_dampers = 8192;
  const int points = std::clamp(
      problem.points(), least_points,
      exact.laws.depend_on_velocity() && !exact.laws.act_over_period() ? enough_of_dampers : enough);
  const Motion balance = contact_motion(problem, response, exact.laws, points);
  ExactNearResponse result{find(exact, balance.displacement, options, balance.force), missing, missing};
  if (result.motion.parts == nullptr) return result;
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(points, 0.0, 1.0 - 1.0 / points);
  result.displacement_error = result.motion.start_error;
  result.force_error = relative_distance(balance.force, result.motion.force(times));
  return result;
}

ExactNearResponse exact_near_response(const CondensedProblem& problem, const ContactLaws& laws,
                                      const PeriodicResponse& response, const ContactDynamics& dynamics,
                                      const CollocationOptions& options, IntervalFinder find) {
  return exact_near_response(problem, response, exact_problem(problem, laws, dynamics), options, find);
}

}  // namespace wavebalance::solvers

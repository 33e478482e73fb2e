#include "wavebalance/solvers/phases/response_phases.hpp"

#include <algorithm>
#include <cmath>

#include "balance/free_contacts.hpp"
#include "phases/phase_motion_parts.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"

namespace wavebalance::solvers {
namespace {

// By what the force of a contact grows where phases end and begin, N.
double force_jump(const detail::PhaseIterate& iterate, int contact, double time) {
  const auto is_now = [time](double at) { return std::abs(at - time - std::round(at - time)) < 1e-12; };
  double jump = 0.0;
  for (std::size_t p = 0; p < iterate.layout.phases.size(); ++p) {
    const detail::Phase& phase = iterate.layout.phases[p];
    if (phase.contact != contact || phase.begin < 0) continue;
    const double begin = iterate.layout.begin(phase), end = iterate.layout.end(phase);
    if (is_now(begin)) jump += iterate.forces.in_phase(static_cast<int>(p), begin);
    if (is_now(end)) jump -= iterate.forces.in_phase(static_cast<int>(p), end);
  }
  return jump;
}

double relative_distance(const Eigen::MatrixXd& values, const Eigen::MatrixXd& exact) {
  const double size = exact.norm();
  return size > 0.0 ? (values - exact).norm() / size : missing;
}

}  // namespace

PhasesProblem phases_problem(const CondensedProblem& problem, const ContactLaws& laws,
                             const ContactDynamics& dynamics) {
  detail::FreeContacts free(problem.structure(), problem.load_harmonics(), dynamics.holding());
  return {dynamics, laws.at(problem.load_frequency()), free.at(problem.frequency(), problem.load_factor()),
          problem.frequency()};
}

ResponsePhases response_phases(const CondensedProblem& problem, const PeriodicResponse& response,
                               const PhasesProblem& phases, const ContactPhasesOptions& options,
                               PhaseFinder find) {
  constexpr int least_points = 256, most_points = 1024;  // a start needs no more
  const int points = std::clamp(problem.points(), least_points, most_points);
  const Motion balance = contact_motion(problem, response, phases.laws, points);
  ResponsePhases result{find(phases, balance.displacement, options, balance.force), missing, missing};
  if (result.motion.parts == nullptr) return result;
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(points, 0.0, 1.0 - 1.0 / points);
  result.displacement_error = result.motion.start_error;
  result.force_error = relative_distance(balance.force, result.motion.force(times));
  return result;
}

ResponsePhases response_phases(const CondensedProblem& problem, const ContactLaws& laws,
                               const PeriodicResponse& response, const ContactDynamics& dynamics,
                               const ContactPhasesOptions& options, PhaseFinder find) {
  return response_phases(problem, response, phases_problem(problem, laws, dynamics), options, find);
}

PeriodicStiffness contact_stiffness(const PhaseMotion& motion) {
  PeriodicStiffness result;
  if (!motion.converged()) {
    result.status = StabilityStatus::no_response;
    return result;
  }
  if (motion.parts->multipliers) {  // by the flow, which keeps no slopes
    result.status = StabilityStatus::unsupported_law;
    return result;
  }
  for (const ContactPhase& phase : motion.phases)
    result.intervals.push_back({phase.contact, phase.begin, phase.end});
  if (motion.is_rigid()) {
    result.status = StabilityStatus::no_finite_stiffness;
    return result;
  }
  result.tangent = [motion](int contact, double time) { return motion.tangent(contact, time); };
  if (!motion.depends_on_velocity()) return result;
  result.damping = [motion](int contact, double time) { return motion.damping(contact, time); };
  result.impulse = [motion](int contact, double time) {
    const double speed = motion.velocity(Eigen::VectorXd::Constant(1, time))(contact, 0);
    return speed != 0.0 ? force_jump(motion.parts->iterate, contact, time) / speed : 0.0;
  };
  return result;
}

}  // namespace wavebalance::solvers

#include "wavebalance/solvers/phases/response_phases.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "period/contact_free_motion.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"
#include "wavebalance/solvers/response/response_motion.hpp"

namespace wavebalance::solvers {
namespace {

// Amplitudes over the period of the problem of a motion that is known over that of its load.
Eigen::MatrixXcd amplitudes_of(const ContactFreeMotion& motion) {
  const Eigen::MatrixXcd& of_load = motion.responses();
  const Eigen::Index repeats = motion.load_periods();
  Eigen::MatrixXcd amplitudes = Eigen::MatrixXcd::Zero(of_load.rows(), repeats * (of_load.cols() - 1) + 1);
  for (Eigen::Index n = 0; n < of_load.cols(); ++n)
    amplitudes.col(repeats * n) =
        std::polar(1.0, -2.0 * std::numbers::pi * double(n) * motion.start()) * of_load.col(n);
  return amplitudes;
}

double relative_distance(const Eigen::MatrixXd& values, const Eigen::MatrixXd& exact) {
  const double size = exact.norm();
  return size > 0.0 ? (values - exact).norm() / size : missing;
}

}  // namespace

ResponsePhases response_phases(const CondensedProblem& problem, const ContactLaws& laws,
                               const PeriodicResponse& response, const ContactDynamics& dynamics,
                               const ContactPhasesOptions& options) {
  constexpr int least_points = 256, most_points = 1024;  // a start needs no more
  const int points = std::clamp(problem.points(), least_points, most_points);
  const Motion balance = contact_motion(problem, response, laws, points);
  const PhasesProblem phases{dynamics, laws, amplitudes_of(ContactFreeMotion(problem, 0)),
                             problem.frequency()};
  ResponsePhases result{contact_phases(phases, balance.displacement, options), missing, missing};
  if (result.motion.parts == nullptr) return result;
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(points, 0.0, 1.0 - 1.0 / points);
  result.displacement_error = relative_distance(balance.displacement, result.motion.displacement(times));
  result.force_error = relative_distance(balance.force, result.motion.force(times));
  return result;
}

PeriodicStiffness contact_stiffness(const PhaseMotion& motion) {
  PeriodicStiffness result;
  if (!motion.converged()) {
    result.status = StabilityStatus::no_response;
    return result;
  }
  for (const ContactPhase& phase : motion.phases)
    result.intervals.push_back({phase.contact, phase.begin, phase.end});
  result.tangent = [motion](int contact, double time) { return motion.tangent(contact, time); };
  if (!motion.depends_on_velocity()) return result;
  result.damping = [motion](int contact, double time) { return motion.damping(contact, time); };
  result.impulse = [motion](int contact, double time) {
    const double speed = motion.velocity(Eigen::VectorXd::Constant(1, time))(contact, 0);
    return speed != 0.0 ? std::abs(motion.force(Eigen::VectorXd::Constant(1, time))(contact, 0) / speed)
                        : 0.0;
  };
  return result;
}

}  // namespace wavebalance::solvers

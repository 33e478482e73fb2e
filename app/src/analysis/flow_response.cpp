#include <chrono>
#include <cmath>
#include <numbers>

#include "analysis/phases_response.hpp"
#include "analysis/response_parts.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {
namespace {

using solvers::FlowMotion;

// The Fourier coefficients of uniform samples of the forces less those of the holding springs, and of the
// impulses between them, N, C x count.
Eigen::MatrixXcd force_harmonics(const FlowMotion& found, double holding, double frequency, int count) {
  const Eigen::MatrixXd force =
      found.stepping.contacts.force - holding * found.stepping.contacts.displacement;
  const auto points = double(force.cols());
  Eigen::MatrixXcd result = Eigen::MatrixXcd::Zero(force.rows(), count);
  for (int n = 0; n < std::min(count, int(force.cols()) / 2); ++n) {
    const double turn = -2.0 * std::numbers::pi * n, weight = n == 0 ? 1.0 : 2.0;
    for (Eigen::Index k = 0; k < force.cols(); ++k)
      result.col(n) += weight / points * std::polar(1.0, turn * double(k) / points) * force.col(k);
    for (const solvers::FlowEvent& event : found.events)
      result(found.machines[std::size_t(event.contact)].row, n) +=
          weight * frequency * event.impulse * std::polar(1.0, turn * event.time * frequency);
  }
  return result;
}

// At times between the samples linearly.
Eigen::MatrixXd displacement_at(const Eigen::MatrixXd& samples, const Eigen::VectorXd& times) {
  Eigen::MatrixXd result(samples.rows(), times.size());
  const Eigen::Index points = samples.cols();
  for (Eigen::Index k = 0; k < times.size(); ++k) {
    const double at = (times[k] - std::floor(times[k])) * double(points), whole = std::floor(at);
    const Eigen::Index i = Eigen::Index(whole) % points;
    result.col(k) = samples.col(i) + (at - whole) * (samples.col((i + 1) % points) - samples.col(i));
  }
  return result;
}

void copy_structure(const solvers::CondensedProblem& problem, double holding, const FlowMotion& found,
                    int points, Response& result) {
  const double frequency = problem.frequency();
  const solvers::ContactSource source{
      [&](int count) { return force_harmonics(found, holding, frequency, count); },
      [&](const Eigen::VectorXd& times) {
        return displacement_at(found.stepping.contacts.displacement, times);
      },
      holding};
  const int most = std::max(1, int(result.contacts.points()) / 2);
  note_structure(result,
                 solvers::structure_motion_of(
                     problem, source, points,
                     {.tolerance = 1e-3,
                      .first_harmonics = std::min(solvers::StructurePhasesOptions().first_harmonics, most),
                      .max_harmonics = most}));
}

}  // namespace

Response flow_response(const Scene& scene, const StructureModel& model, const ResponseOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  Response result;
  result.status = "no_modes";
  result.residual = solvers::missing;
  if (model.contact_dynamics() == nullptr) return result;
  const solvers::ContactDynamics& dynamics = *model.contact_dynamics();
  Scene paired = scene;
  paired.time =
      balance_of(scene, least_start_functions(scene)).time;  // loads need a pair, which takes no part
  const solvers::CondensedProblem problem = make_problem(paired, model);
  solvers::TimeSteppingOptions stepping_options;
  stepping_options.output_points = scene.analysis.output_points;
  stepping_options.period_tolerance = scene.analysis.tolerance;
  stepping_options.max_periods = scene.analysis.max_periods;
  stepping_options.observer = options.observer;
  FlowMotion found = solvers::integrate_by_events(problem, dynamics, make_laws(scene), stepping_options);
  const solvers::TimeSteppingResult& stepping = found.stepping;
  result.converged = stepping.status == solvers::TimeSteppingStatus::converged;
  result.status = found.ended == solvers::FlowStatus::endless_events ? to_string(found.ended)
                                                                     : to_string(stepping.status);
  if (!stepping.period_error.empty()) result.residual = stepping.period_error.back();
  if (std::isfinite(found.closed)) result.residual = found.closed;
  result.iterations = stepping.periods;
  result.attractor_periods = stepping.attractor_periods;
  result.unknowns = int(found.multipliers.size());
  result.contacts = stepping.contacts;
  result.struck = found.impacts;
  result.moves = !result.contacts.empty() && stepping.status != solvers::TimeSteppingStatus::step_failure;
  result.contact = leading_contact(result.contacts, model.gaps);
  if (found.multipliers.size() > 0) result.stability = solvers::stability_of_multipliers(found.multipliers);
  if (result.moves && options.structure_points > 0)
    copy_structure(problem, dynamics.holding(), found, options.structure_points, result);
  result.flow = std::move(found);
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace wavebalance::app

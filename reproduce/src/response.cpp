#include "wavebalance/reproduce/response.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "resampling.hpp"
#include "wavebalance/reproduce/compose.hpp"
#include "wavebalance/solvers/periodic_field.hpp"
#include "wavebalance/solvers/rigid_response.hpp"
#include "wavebalance/solvers/shooting.hpp"
#include "wavebalance/solvers/time_stepping.hpp"

namespace wavebalance::reproduce {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1e", value);
  return text;
}

void tell(const ProgressObserver& observer, const Progress& progress) {
  if (observer) observer(progress);
}

/// Share of the way from 1 down to `tolerance` that a falling error has gone, on a logarithmic scale.
double logarithmic_share(double error, double tolerance) {
  if (!(error > 0.0) || !std::isfinite(error)) return 0.0;
  return std::clamp(std::log(error) / std::log(tolerance), 0.0, 1.0);
}

solvers::SolveObserver solve_observer(const ProgressObserver& observer) {
  if (!observer) return {};
  return [observer](const std::string& phase, int step, double residual) {
    observer({phase, "step " + std::to_string(step) + ", residual " + short_number(residual), {}});
    return true;
  };
}

/// Displacement, velocity and, if asked for, the field of all degrees of freedom.
solvers::PeriodSamples sample_motion(solvers::CondensedProblem& problem,
                                     const solvers::PeriodicResponse& response, int points,
                                     bool full_history) {
  solvers::MotionEvaluator motion(problem.pair().trial(), points);
  solvers::PeriodSamples samples;
  samples.contacts = problem.contacts();
  samples.displacement = motion.displacement(response.coefficients).reshaped();
  samples.velocity = motion.velocity(response.coefficients, response.frequency).reshaped();
  if (!full_history) return samples;
  auto field = solvers::periodic_field(problem, response.contact_force, points);
  samples.displacements = std::move(field.displacement);
  samples.velocities = std::move(field.velocity);
  return samples;
}

void note_solution(Response& result, const solvers::PeriodicResponse& found) {
  result.converged = found.converged();
  result.status = to_string(found.status);
  result.residual = found.residual;
  result.iterations = found.iterations;
  result.used_homotopy = found.used_homotopy;
}

void solve_law(const Scene& scene, solvers::CondensedProblem& problem, const ResponseOptions& options,
               Response& result) {
  solvers::ForcedResponseOptions solver;
  solver.observer = solve_observer(options.observer);
  const solvers::AnyContactLaw law = make_law(scene.contact);
  const auto found = solvers::forced_response(problem, law, solver, options.guess);
  note_solution(result, found);
  result.samples = sample_response(problem, found, law, scene.analysis.output_points, options.full_history);
}

void solve_rigid(const Scene& scene, solvers::CondensedProblem& problem, const ResponseOptions& options,
                 Response& result) {
  solvers::RigidResponseOptions solver;
  solver.observer = solve_observer(options.observer);
  const auto found = solvers::rigid_response(problem, scene.contact.gap, solver);
  note_solution(result, found.response);
  const auto& contact = found.complementarity;
  result.rigid = {contact.max_penetration, contact.min_force, contact.product, found.stiffness};
  result.residual = std::max(found.response.residual, contact.product);
  result.samples = sample_motion(problem, found.response, scene.analysis.output_points, options.full_history);
  result.samples.contact_force = nearest_samples(found.response.contact_force, scene.analysis.output_points);
}

}  // namespace

solvers::PeriodSamples sample_response(solvers::CondensedProblem& problem,
                                       const solvers::PeriodicResponse& response,
                                       const solvers::AnyContactLaw& law, int points, bool full_history) {
  solvers::PeriodSamples samples = sample_motion(problem, response, points, full_history);
  samples.contact_force = samples.displacement.unaryExpr([&law](double u) { return law.force(u); });
  return samples;
}

Response weighted_residual_response(const Scene& scene, const ResponseOptions& options) {
  const auto start = Clock::now();
  Response result;
  result.unknowns = scene.time.functions;
  try {
    solvers::CondensedProblem problem = make_problem(scene);
    const bool rigid = scene.contact.law == ContactLawType::rigid;
    (rigid ? solve_rigid : solve_law)(scene, problem, options, result);
  } catch (const solvers::SingularSystem& error) {
    result.status = std::string("singular: ") + error.what();
    result.residual = std::numeric_limits<double>::quiet_NaN();
  }
  result.wall_seconds = seconds_since(start);
  return result;
}

Response time_stepping_response(const Scene& scene, const ResponseOptions& options) {
  const auto start = Clock::now();
  solvers::TimeSteppingOptions stepping;
  stepping.output_points = scene.analysis.output_points;
  stepping.period_tolerance = scene.analysis.tolerance;
  stepping.max_periods = scene.analysis.max_periods;
  stepping.full_history = options.full_history;
  stepping.observer = [&](int period, double difference) {
    tell(options.observer,
         {"time stepping", "period " + std::to_string(period) + ", difference " + short_number(difference),
          logarithmic_share(difference, scene.analysis.tolerance)});
    return true;
  };
  auto found = solvers::integrate_to_periodic(make_structure(scene), make_law(scene.contact),
                                              scene.forcing.frequency, stepping);
  Response result;
  result.wall_seconds = seconds_since(start);
  result.converged = found.status == solvers::TimeSteppingStatus::converged;
  result.status = to_string(found.status);
  result.residual =
      found.period_error.empty() ? std::numeric_limits<double>::quiet_NaN() : found.period_error.back();
  result.iterations = found.periods;
  result.unknowns = 2 * scene.structure.elements;
  result.samples = std::move(found.samples);
  return result;
}

Response shooting_response(const Scene& scene, const ResponseOptions& options) {
  const auto start = Clock::now();
  solvers::ShootingOptions shooting;
  shooting.output_points = scene.analysis.output_points;
  shooting.full_history = options.full_history;
  auto found =
      solvers::shoot(make_structure(scene), make_law(scene.contact), scene.forcing.frequency, shooting);
  Response result;
  result.wall_seconds = seconds_since(start);
  result.converged = found.status == solvers::ShootingStatus::converged;
  result.status = to_string(found.status);
  result.residual = found.residual;
  result.iterations = found.iterations;
  result.unknowns = 2 * scene.structure.elements;
  result.samples = std::move(found.samples);
  return result;
}

}  // namespace wavebalance::reproduce


#include "analysis/analysis_parts.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/wall_clock.hpp"

namespace wavebalance::app {
namespace {

using solvers::FlowMotion;

// A motion that is not closed jumps at the end of its period.
void copy_structure(const solvers::CondensedProblem& problem, const FlowMotion& found, int points,
                    Response& result) {
  constexpr double of_rest = 1e-9, of_impacts = 1e-4, of_transient = 1e-3;  // whose harmonics do not decay
  solvers::ExactStructureOptions options;
  options.tolerance = found.impacts.empty() ? of_rest : of_impacts;
  if (!std::isfinite(found.closed)) {
    options.tolerance = of_transient;
    options.max_harmonics = 2 * options.first_harmonics;
  }
  note_structure(result, solvers::exact_structure_motion(problem, found.motion, points, options));
}

}  // namespace

Response flow_response(const Scene& scene, const StructureModel& model, const ResponseOptions& options) {
  const WallClock clock;
  Response result;
  result.status = "no_modes";
  result.residual = solvers::missing;
  if (model.contact_dynamics() == nullptr) return result;
  const solvers::ContactDynamics& dynamics = *model.contact_dynamics();
  Scene paired = scene;
  paired.time = balance_of(scene, least_start_functions(scene)).time;  // loads need a pair, which is not used
  const solvers::CondensedProblem problem = make_problem(paired, model);
  solvers::TimeSteppingOptions stepping_options;
  stepping_options.output_points = scene.analysis.output_points;
  stepping_options.period_tolerance = scene.analysis.tolerance;
  stepping_options.max_periods = scene.analysis.max_periods;
  stepping_options.max_operations = options.max_operations;
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
  result.moves = !result.contacts.empty() && found.ended == solvers::FlowStatus::converged;
  result.contact = leading_contact(scene, result.contacts, model.gaps);
  if (found.multipliers.size() > 0) result.stability = solvers::stability_of_multipliers(found.multipliers);
  if (found.motion.parts != nullptr && options.structure_points > 0)
    copy_structure(problem, found, options.structure_points, result);
  result.flow = std::move(found);
  result.wall_seconds = clock.seconds();
  return result;
}

}  // namespace wavebalance::app

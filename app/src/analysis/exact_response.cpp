#include "analysis/analysis_parts.hpp"

#include <iterator>

#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/wall_clock.hpp"
#include "wavebalance/solvers/response/complementarity.hpp"

namespace wavebalance::app {
namespace {

/// The largest harmonic of the load that a balance has to hold.
int highest_harmonic(const Forcing& forcing) {
  int highest = 1;
  for (const ForcingTerm& term : forcing.terms)
    if (term.samples.empty()) highest = std::max(highest, term.harmonic);
  return highest;
}

/// Result of a search for an exact solution.
struct ExactFound {
  std::string status = "no_start";
  std::string strategy;
  int start_functions = 0;
  int load_periods = 1;
  std::optional<solvers::ExactSolution> motion;
  std::optional<AttractorFromRest> settled;  ///< the attractor, where that was the start

  bool may_go_on() const { return !motion || motion->status == solvers::ExactStatus::not_found; }
  /// Whether a slider is where the start has it.
  bool depends_on_history() const {
    return motion && std::ranges::any_of(motion->friction, &solvers::FrictionAlong::always_sticks);
  }
};

void note(ExactFound& found, solvers::ExactSolution motion, const char* strategy, int functions) {
  found.status = to_string(motion.status);
  found.strategy = strategy;
  found.start_functions = functions;
  found.motion = std::move(motion);
}

/// From one harmonic balance after the other, as long as the time allows.
ExactFound from_balances(const Scene& scene, const StructureModel& model, const Observer& observer) {
  constexpr double most_seconds = 60.0;  // after which no further balance is begun
  const WallClock clock;
  ExactFound found;
  if (model.contact_dynamics() == nullptr) {
    found.status = "no_modes";
    return found;
  }
  for (const int functions : exact_starts) {
    if (functions < least_start_functions(scene)) continue;
    if (clock.seconds() > most_seconds) break;
    solvers::ContactProblem problem = compose_problem(balance_of(scene, functions), model);
    solvers::ForcedResponseOptions options;
    options.observer = observer;
    const auto balance = problem.respond(scene.forcing.frequency, options);
    if (balance.status == solvers::SolveStatus::cancelled) {
      found.status = to_string(balance.status);
      return found;
    }
    if (!balance.converged()) continue;
    auto exact = problem.exact_near(balance, {.tolerance = exact_tolerance(scene), .observer = observer});
    note(found, std::move(exact->motion), "from_balance", functions);
    if (!found.may_go_on()) return found;
  }
  return found;
}

/// From the attractor, from event to event, which may repeat after several periods
/// of the load.
ExactFound by_events(const Scene& scene, solvers::ContactProblem& problem, const Observer& observer) {
  ExactFound found;
  if (problem.dynamics() == nullptr) {
    found.status = "no_modes";
    return found;
  }
  solvers::TimeSteppingOptions stepping;
  stepping.observer = observer;
  solvers::ExactAttractor all = problem.exact_attractor(
      scene.forcing.frequency, stepping, {.tolerance = exact_tolerance(scene), .observer = observer});
  const solvers::Motion& last = all.settled.stepping.contacts;
  if (!last.empty())
    found.settled = {all.settled.stepping.attractor_periods, last.displacement.maxCoeff(),
                     last.force.maxCoeff()};
  note(found, std::move(all.motion), "from_settling", 0);
  found.load_periods = all.load_periods;
  return found;
}

/// From the attractor, where there is one: its sliders are where the first periods
/// from rest have put them.
void try_attractor(ExactFound& found, solvers::ContactProblem& problem, const Scene& scene,
                   const Observer& observer) {
  solvers::AttractorOptions options;
  options.observer = observer;
  const solvers::AttractorMotion settled = problem.settle(scene.forcing.frequency, options);
  if (settled.cancelled) found.status = "cancelled";
  if (settled.cancelled || !settled.integrated() || !settled.last.displacement.allFinite()) return;
  found.settled = from_rest(settled);
  auto motion = problem.exact_near(scene.forcing.frequency, settled,
                                   {.tolerance = exact_tolerance(scene), .observer = observer});
  if (motion && (motion->converged() || found.may_go_on()))
    note(found, *std::move(motion), "from_settling", 0);
}

/// `settling`: whether to start from that motion where no balance leads to one.
void solve_by_collocation(const Scene& scene, const StructureModel& model, const ResponseOptions& options,
                          bool settling, Response& result) {
  const bool events = moves_by_events(scene);
  ExactFound found;
  if (!events) found = from_balances(scene, model, options.observer);
  solvers::ContactProblem problem =
      compose_problem(balance_of(scene, std::max({exact_starts.front(), found.start_functions,
                                                  events ? least_start_functions(scene) : 0})),
                      model);
  if (events) found = by_events(scene, problem, options.observer);
  const bool searched = found.status == "no_start" || found.motion.has_value();
  if (!events && settling && searched && (found.may_go_on() || found.depends_on_history()))
    try_attractor(found, problem, scene, options.observer);
  result.status = found.status;
  result.strategy = found.strategy;
  result.start_functions = found.start_functions;
  result.residual = solvers::missing;
  if (!found.motion) {
    result.settled = found.settled;
    return;
  }
  if (found.load_periods > 1) problem = problem.over_periods(found.load_periods);
  copy_exact(problem, *found.motion, found.load_periods, scene, model, options, result);
  if (!result.moves) result.settled = found.settled;
  if (events && result.stability && result.stability->unstable > 0) result.settled = found.settled;
}

Response timed_response(const Scene& scene, const StructureModel& model, const ResponseOptions& options,
                        bool settling) {
  const WallClock clock;
  Response result;
  result.solved_by = name_of(TimeMethod::exact);
  try {
    solve_by_collocation(scene, model, options, settling, result);
  } catch (const solvers::SingularSystem& error) {
    result.converged = result.moves = false;
    result.status = std::string("singular: ") + error.what();
    result.residual = solvers::missing;
  }
  result.wall_seconds = clock.seconds() - (result.stability ? result.stability->wall_seconds : 0.0);
  return result;
}

/// Exact solutions need no pair. A scene that names a pair other than Fourier functions requests its
/// balance.
bool may_leave_pair(const Time& time) {
  return time.trial.empty() || (time.trial == "fourier" && time.weight == "fourier");
}

}  // namespace

void copy_motion(solvers::ContactProblem& problem, const solvers::ExactSolution& motion, const Scene& scene,
                 const StructureModel& model, const ResponseOptions& options, Response& result) {
  constexpr double least_left_out = 1e-9, of_impacts = 1e-4;  // whose harmonics do not decay
  const double frequency = scene.forcing.frequency;
  result.contacts = contacts_of(motion, scene.analysis.output_points);
  result.struck = motion.impacts;
  result.contact = leading_contact(scene, result.contacts, model.gaps);
  if (is_rigid(scene.contact.law) && !has_impacts(scene.contact)) {
    const auto contact_major = [](const Eigen::MatrixXd& values) -> Eigen::VectorXd {
      return values.transpose().reshaped();
    };
    const auto held = solvers::complementarity(contact_major(result.contacts.displacement),
                                               contact_major(result.contacts.force), model.gaps);
    result.rigid = {held.max_penetration, held.min_force, held.product};
  }
  if (options.structure_points > 0)
    note_structure(result, problem.structure_motion(
                               frequency, motion, options.structure_points,
                               {.tolerance = std::max(motion.impacts.empty() ? least_left_out : of_impacts,
                                                      exact_tolerance(scene))}));
  if (options.stability && result.converged) result.stability = problem.stability(frequency, motion);
  if (!moves_by_events(scene)) note_attractor(problem, scene, options.observer, result);
}

void copy_exact(solvers::ContactProblem& problem, const solvers::ExactSolution& motion, int load_periods,
                const Scene& scene, const StructureModel& model, const ResponseOptions& options,
                Response& result) {
  result.exact = {motion, solvers::missing, solvers::missing};
  result.iterations = motion.iterations;
  result.unknowns = motion.unknowns;
  result.converged = motion.converged();
  result.moves = motion.parts != nullptr;
  if (!result.moves) return;
  result.residual = motion.residual;
  result.periods = result.motion_periods = load_periods;
  copy_motion(problem, motion, scene, model, options, result);
}

Scene balance_of(Scene scene, int functions) {
  scene.analysis.type = AnalysisType::forced_response;
  scene.time = {};
  scene.time.trial = scene.time.weight = "fourier";
  scene.time.functions = functions;
  scene.time.quadrature_points = 4 * (functions + 1);
  return scene;
}

int least_start_functions(const Scene& scene) {
  const int highest = highest_harmonic(scene.forcing);
  return *std::find_if(exact_starts.begin(), std::prev(exact_starts.end()),
                       [&](int functions) { return (functions - 1) / 2 >= highest; });
}

double largest_exact_tolerance(int contacts) {
  constexpr int few = 6;
  return contacts <= few ? 1e-6 : 1e-8;
}

std::optional<Response> exact_to_tolerance(const Scene& scene, const StructureModel& model,
                                           const ResponseOptions& options) {
  const double tolerance = scene.time.tolerance;
  const bool cheaper = tolerance > 0.0 && tolerance < largest_exact_tolerance(model.contacts());
  if (!cheaper || !may_leave_pair(scene.time)) return std::nullopt;
  Response found = timed_response(scene, model, options, false);
  if (!found.converged && found.status != to_string(solvers::SolveStatus::cancelled)) return std::nullopt;
  return found;
}

double exact_tolerance(const Scene& scene) {
  return scene.time.tolerance > 0.0 ? scene.time.tolerance : default_exact_tolerance;
}

bool is_exact(const Response& response) { return response.solved_by == name_of(TimeMethod::exact); }

Response exact_response(const Scene& scene, const ResponseOptions& options) {
  return exact_response(scene, make_model(scene, options.observer), options);
}

Response exact_response(const Scene& scene, const StructureModel& model, const ResponseOptions& options) {
  return timed_response(scene, model, options, true);
}

}  // namespace wavebalance::app

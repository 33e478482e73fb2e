#include "compare/exact_reference.hpp"

#include "analysis/analysis_parts.hpp"
#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {
namespace {

struct CollocationLevel {
  double tolerance;
  int nodes;  // of a panel at first
};

// The last one has other panels than the one before, so that their distance is an error.
constexpr std::array<CollocationLevel, 4> exact_levels{{{1e-6, 8}, {1e-9, 8}, {1e-12, 12}, {1e-12, 16}}};
constexpr double coarsest_reference = 1e-6;  // with a larger error a refined balance is as good
constexpr double least_error = 1e-14;        // rounding
// With a single motion, whose error estimate may be too small.
constexpr const char* unchecked = "no time was left to check it with more nodes";
constexpr int most_divided = 64;  // panels: rounding may keep the estimate above the tolerance

struct NamedStatus {
  solvers::ExactStatus status;
  bool refusal;  // wherever the search starts
  const char* phrase;
};

/// Other statuses belong to curves and impacts.
NamedStatus named(solvers::ExactStatus status) {
  using enum solvers::ExactStatus;
  static constexpr std::array<NamedStatus, 10> statuses{
      {{rigid_contact, true, "the contact is rigid and has mass"},
       {velocity_and_no_mass, true, "a rate-dependent force acts at a massless contact"},
       {resonant, true, "the linear structure has a free motion of this period"},
       {structural_damping, true, "a loss factor has no equation in time"},
       {slip_in_a_plane, true, "a contact has rigid friction along two tangents"},
       {law_over_period, true, "a law acts over the whole period and has no states"},
       {tolerance_missed, false, "its error stays above 1e-6"},
       {too_many_intervals, false, "it has too many unknowns"},
       {not_found, false, "none is found near the computed response"},
       {cancelled, false, "no time was left for it"}}};
  const auto found = std::ranges::find(statuses, status, &NamedStatus::status);
  return found == statuses.end() ? NamedStatus{status, false, ""} : *found;
}

}  // namespace

std::optional<Guide> refined_guide(const Scene& scene, const StructureModel& model, double tolerance,
                                   const solvers::Observer& observer) {
  Scene refined = discretised(scene, {"fourier", "fourier"}, 0, 0);
  refined.time.tolerance = tolerance;
  ResponseOptions options;
  options.observer = observer;
  const solvers::ContactLaws laws = make_laws(scene);
  Response outcome;
  auto found = solve_to_tolerance(refined, model, laws, options, outcome);
  if (!outcome.converged || outcome.rounding_error > largest_rounding_error) return std::nullopt;
  const auto& last = found.levels.back();
  Guide guide{{std::move(*found.problem), laws, model.dynamics},
              std::move(found.response),
              {},
              found.estimated_error,
              last.functions,
              last.points};
  guide.contacts = guide.problem.motion(guide.response, scene.analysis.output_points);
  return guide;
}

std::optional<Guide> sized_guide(const Scene& scene, const StructureModel& model, int functions,
                                 const solvers::Observer& observer, const StartMotion& start) {
  const int points = 4 * (functions + 1);
  const Scene sized = discretised(scene, {"fourier", "fourier"}, functions, points);
  solvers::ContactProblem problem = uncondensed_problem(sized, model);
  solvers::PeriodicResponse response = response_near(scene, problem, response_start(start, sized), observer);
  if (!response.converged()) return std::nullopt;
  Guide guide{std::move(problem), std::move(response), {}, solvers::missing, functions, points};
  guide.contacts = guide.problem.motion(guide.response, scene.analysis.output_points);
  return guide;
}

std::string phrase_of(solvers::ExactStatus status) { return named(status).phrase; }

std::string exact_refusal(const StructureModel& model) {
  const solvers::ContactDynamics* dynamics = model.contact_dynamics();
  if (dynamics == nullptr) return "the structure has no modes to compute";
  return dynamics->reduced() ? "the structure has too many degrees of freedom for all of its modes" : "";
}

solvers::Motion sampled(const solvers::ExactSolution& motion, int points) {
  const Eigen::VectorXd times = Eigen::VectorXd::LinSpaced(points, 0.0, 1.0 - 1.0 / points);
  solvers::Motion samples;
  samples.displacement = motion.displacement(times);
  samples.force = motion.force(times);
  return samples;
}

ExactReference exact_reference(Guide& guide, const solvers::Observer& observer) {
  ExactReference best;
  best.error = coarsest_reference;
  int levels = 0;
  for (const auto& [tolerance, nodes] : exact_levels) {
    const auto found = guide.problem.exact_near(
        guide.response,
        {.tolerance = tolerance, .nodes = nodes, .max_panels = most_divided, .observer = observer});
    const solvers::ExactSolution& motion = found->motion;
    const bool first = levels == 0;
    const bool better =
        motion.parts != nullptr && (motion.converged() || motion.estimated_error <= best.error);
    if (!better && first) {
      best.missing_because = phrase_of(motion.status);
      best.refused = named(motion.status).refusal;
    }
    if (!better) break;
    solvers::Motion contacts = sampled(motion, guide.contacts.points());
    // An estimate is too small at most by the factor of the previous motion.
    double too_small = 1.0;
    if (!first) {
      too_small = std::max(1.0, displacement_error(best.contacts, contacts) / best.error);
      best.force_error = std::max(least_error, force_error(best.contacts, contacts));
    }
    ++levels;
    best.contacts = std::move(contacts);
    best.error = std::max(least_error, too_small * motion.estimated_error);
    if (!motion.converged()) break;
    best.motion = motion;
  }
  if (levels == 1) best.missing_because = unchecked;
  return best;
}

}  // namespace wavebalance::app

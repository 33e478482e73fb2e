#include "command/commands.hpp"

#include "command/scene_moves.hpp"

namespace wavebalance::app {
namespace {

using namespace moves;

using Remedies = std::map<std::string, std::vector<Move>>;

const Move integrate = always("analysis.type = \"time_stepping\"", {.analysis = "time_stepping"});
const Move recorded = always(
    "analysis.type = \"time_stepping\" with analysis.max_periods = 200, which has statistics of what does "
    "not repeat",
    statistics_in_time());
const Move diagram = always(
    "analysis.type = \"bifurcation_diagram\", which integrates over the interval, with or without periodic "
    "motions",
    {.analysis = "bifurcation_diagram"});
const Move all_motions = always("analysis.type = \"motions\"", {.analysis = "motions"});
const Move static_load = always("a static load that presses the structure against a contact (forcing.terms)",
                                {.added = "[[forcing.terms]]\nharmonic = 0\namplitude = 1.0"});
const Move moved_contact = always("a contact that the load moves");
const Move softer_contact = always("a softer contact");
const Move larger_tolerance = scaled("a larger", "time.tolerance", 10.0, 0.5);
const Move larger_step_tolerance = scaled("a larger", "analysis.tolerance", 10.0, 0.5);
const Move other_frequency = scaled("another", "forcing.frequency", 1.01);
const Move other_gap = scaled("another", "contact.gap", 1.01);
const Move less_rebound = scaled("a smaller", "contact.restitution", 0.5);
const Move more_curve_points = scaled("a larger", "analysis.max_points", 4);
const Move more_mode_points = scaled("more", "analysis.points", 2);
const Move higher_ratio = scaled("a higher", "analysis.last_frequency_ratio", 2.0);
const Move more_periods = scaled("more", "analysis.max_periods", 2);
const Move longer_record = scaled("more", "analysis.recorded_periods", 4);
const Move longer_period = scaled("a larger", "analysis.longest_period", 2);

const Remedies& of_responses() {
  static const std::vector<Move> sizes{more_functions, odd_functions, more_points, tolerance_in_place};
  static const std::vector<Move> elsewhere{balance, integrate};
  static const Remedies all{
      {"stalled", {more_functions, odd_functions, more_points, tolerance_in_place, recorded}},
      {"iteration_limit", sizes},
      {"effort_limit", {more_functions, odd_functions, more_points, tolerance_in_place, recorded}},
      {"inaccurate", {other_frequency, more_damping, moved_contact}},
      {"singular", {more_damping, other_frequency}},
      {"unbalanced", {static_load}},
      {"size_limit", {larger_tolerance}},
      {"stagnated", {larger_tolerance}},
      {"no_start", elsewhere},
      {"not_found", elsewhere},
      {"tolerance_missed", {larger_tolerance}},
      {"rigid_contact", {balance}},
      {"velocity_and_no_mass", {balance}},
      {"structural_damping", {balance}},
      {"no_modes", {balance}},
      {"resonant", {other_frequency, more_damping}},
      {"chattering", {all_motions, no_rebound, stiff_law, more_rebound}},
      {"lasting_contact", {stiff_law}},
      {"too_many_impacts", {stiff_law, more_damping, less_rebound}},
      {"grazing", {other_frequency, other_gap}},
      {"not_settled", {recorded, all_motions, more_damping, other_frequency}},
      {"aperiodic", {longer_record, all_motions, more_damping}},
      {"not_converged", {sizes_in_place, more_damping}}};
  return all;
}

const Remedies& of_sweeps() {
  static const Remedies all{{"returned", {reversed, other_start}},
                            {"no_start", {other_start, diagram}},
                            {"closed", {other_start, reversed, more_points}},
                            {"ended", {other_start, reversed}},
                            {"lost", {exact_curve, damping_depth, smaller_step, more_points, odd_functions}},
                            {"missed_part", {exact_curve, damping_depth, smaller_step, more_points}},
                            {"unbounded", {more_damping, dropped_nyquist}},
                            {"point_limit", {more_curve_points, exact_curve, damping_depth}}};
  return all;
}

const Remedies& of_exact_sweeps() {
  static const Remedies all{{"returned", {reversed, other_start}},
                            {"no_start", {damping_depth, other_start, curve_of_balance}},
                            {"ended", {other_start, reversed}},
                            {"lost", {damping_depth, smaller_step}},
                            {"point_limit", {more_curve_points}}};
  return all;
}

const Remedies& of_modes() {
  static const std::vector<Move> twice{samples_of_harmonics};
  static const Remedies all{{"cycling", twice},
                            {"singular", twice},
                            {"ended", {more_harmonics, more_mode_points}},
                            {"ended at the ratio", {higher_ratio}},
                            {"lost", {more_mode_points, more_harmonics}},
                            {"point_limit", {more_mode_points}}};
  return all;
}

const Remedies& of_integration() {
  static const Remedies all{
      {"incomplete", {elastic_friction, no_rebound, stiff_law, softer_contact}},
      {"aperiodic", {longer_record, all_motions, more_damping}},
      {"iteration_limit", {more_periods, larger_step_tolerance, all_motions, more_damping, fewer_modes}},
      {"subharmonic", {response_of_periods, all_motions}},
      {"tolerance_missed", {larger_step_tolerance}},
      {"step_failure", {softer_contact}},
      {"grows", {all_motions, more_damping}},
      {"endless_events", {elastic_friction, no_rebound, stiff_law, softer_contact, more_damping}}};
  return all;
}

const Remedies& of_motions() {
  static const Remedies all{{"not_settled", {longer_period, more_starts, recorded, more_damping, response}},
                            {"not_solved", {response}},
                            {"grows", {more_damping, response}},
                            {"no_modes", {response}}};
  return all;
}

const Remedies& of_analysis(const Analysis& analysis) {
  if (is_sweep(analysis.type)) return analysis.exact ? of_exact_sweeps() : of_sweeps();
  if (analysis.type == AnalysisType::nonlinear_mode) return of_modes();
  if (integrates_in_time(analysis.type)) return of_integration();
  return analysis.type == AnalysisType::motions ? of_motions() : of_responses();
}

/// The status without its numbers.
std::string known_status(const std::string& status) {
  if (!status.starts_with("ended at")) return status;
  return status.find("last_frequency_ratio") == std::string::npos ? "ended" : "ended at the ratio";
}

}  // namespace

std::vector<NextStep> next_steps(const Scene& scene, const std::string& status) {
  const Remedies& remedies = of_analysis(scene.analysis);
  const auto found = remedies.find(known_status(status));
  std::vector<NextStep> steps;
  if (found == remedies.end()) return steps;
  for (const Move& move : found->second)
    if (auto step = move(scene); step && accepts(scene, step->change)) steps.push_back(std::move(*step));
  return steps;
}

std::vector<std::string> statuses_with_next_steps(AnalysisType type) {
  std::vector<std::string> statuses;
  for (const bool exact : {false, true}) {
    Analysis analysis;
    analysis.type = type;
    analysis.exact = exact;
    for (const auto& [status, moves] : of_analysis(analysis)) statuses.push_back(status);
  }
  return statuses;
}

}  // namespace wavebalance::app

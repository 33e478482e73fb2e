#include "command/next_steps.hpp"

#include <map>

namespace wavebalance::app {
namespace {

using Remedies = std::map<std::string, std::string>;

const Remedies& of_responses() {
  static const std::string other_sizes =
      "another time.functions (odd for Fourier), more time.quadrature_points, or time.tolerance in place of both";
  static const std::string balance = "time.method = \"balance\"";
  static const Remedies all{
      {"stalled", other_sizes},
      {"iteration_limit", other_sizes},
      {"effort_limit", other_sizes},
      {"inaccurate", "another forcing.frequency, more damping, or a contact that the load moves"},
      {"singular", "damping, such as structure.stiffness_damping, or another forcing.frequency"},
      {"unbalanced", "a static load that presses the structure against a contact (forcing.terms)"},
      {"size_limit", "a larger time.tolerance"},
      {"stagnated", "a larger time.tolerance"},
      {"no_start",
       "time.method = \"balance\" with other time.functions, or analysis.type = \"time_stepping\""},
      {"not_found",
       "time.method = \"balance\" with more time.functions, or analysis.type = \"time_stepping\""},
      {"tolerance_missed", "a larger time.tolerance"},
      {"rigid_contact", balance},
      {"velocity_and_no_mass", balance},
      {"structural_damping", balance},
      {"no_modes", balance},
      {"resonant", "another forcing.frequency, or damping such as structure.stiffness_damping"},
      {"chattering",
       "analysis.type = \"motions\", contact.restitution = 0, a stiff \"linear\" law, or a larger contact.restitution"},
      {"lasting_contact", "a stiff \"linear\" law"},
      {"too_many_impacts", "a stiff \"linear\" law, more damping, or a smaller contact.restitution"},
      {"grazing", "another forcing.frequency, or another contact.gap"},
      {"not_settled", "analysis.type = \"motions\", more damping, or another forcing.frequency"},
      {"not_converged",
       "time.functions and time.quadrature_points in place of time.tolerance, or more damping"}};
  return all;
}

const Remedies& of_sweeps() {
  static const Remedies all{
      {"returned", "both ends of the interval exchanged, or a start outside the resonance"},
      {"no_start", "another start of the interval, away from the resonance"},
      {"closed", "another start or direction of the interval, or more time.quadrature_points"},
      {"lost",
       "analysis.exact = true, a smaller analysis.largest_step, more time.quadrature_points, or an odd time.functions"},
      {"missed_part",
       "analysis.exact = true, a smaller analysis.largest_step, or more time.quadrature_points"},
      {"unbounded", "more damping, or time.nyquist = \"drop\""},
      {"point_limit", "a larger analysis.max_points, or analysis.exact = true"}};
  return all;
}

const Remedies& of_exact_sweeps() {
  static const Remedies all{
      {"returned", "both ends of the interval exchanged, or a start outside the resonance"},
      {"no_start", "another start of the interval, away from the resonance, or analysis.exact = false"},
      {"lost", "a smaller analysis.largest_step, or analysis.exact = false"},
      {"point_limit", "a larger analysis.max_points"}};
  return all;
}

const Remedies& of_modes() {
  static const Remedies all{{"cycling", "analysis.samples = 2 x analysis.harmonics"},
                            {"singular", "analysis.samples = 2 x analysis.harmonics"},
                            {"lost", "more analysis.points, or other analysis.harmonics"},
                            {"point_limit", "more analysis.points"}};
  return all;
}

const Remedies& of_time_stepping() {
  static const Remedies all{
      {"iteration_limit",
       "more analysis.max_periods, a larger analysis.tolerance, more damping, or for large matrices "
       "structure.kept_modes"},
      {"subharmonic", "analysis.type = \"forced_response\" with analysis.subharmonic"},
      {"step_failure", "a softer contact"}};
  return all;
}

const Remedies& of_shooting() {
  static const std::string others = "analysis.type = \"forced_response\" or \"time_stepping\"",
                           balance = "analysis.type = \"forced_response\"";
  static const Remedies all{{"no_start", others},
                            {"not_found", others},
                            {"tolerance_missed", "a larger time.tolerance"},
                            {"rigid_contact", balance},
                            {"velocity_and_no_mass", balance},
                            {"structural_damping", balance},
                            {"no_modes", balance},
                            {"resonant", of_responses().at("resonant")}};
  return all;
}

const Remedies& of_motions() {
  static const Remedies all{
      {"not_settled",
       "a larger analysis.longest_period, more analysis.random_starts, more damping, or analysis.type = "
       "\"forced_response\""},
      {"not_solved", "analysis.type = \"forced_response\" with time.method = \"balance\""},
      {"no_modes", "analysis.type = \"forced_response\""}};
  return all;
}

}  // namespace

std::string next_step(AnalysisType type, const std::string& status, bool exact) {
  if (type == AnalysisType::nonlinear_mode && status.starts_with("ended at"))
    return status.ends_with("last_frequency_ratio is reached")
               ? "a higher analysis.last_frequency_ratio, or none"
               : "other analysis.harmonics and analysis.samples, or more analysis.points";
  const Remedies& remedies = type == AnalysisType::forced_response  ? of_responses()
                             : type == AnalysisType::nonlinear_mode ? of_modes()
                             : type == AnalysisType::time_stepping  ? of_time_stepping()
                             : type == AnalysisType::shooting       ? of_shooting()
                             : type == AnalysisType::motions        ? of_motions()
                             : exact                                ? of_exact_sweeps()
                                                                    : of_sweeps();
  const auto found = remedies.find(status);
  return found == remedies.end() ? "" : found->second;
}

}  // namespace wavebalance::app

#include "results/summary_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "files/missing.hpp"
#include "plot/unit_prefix.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/other_analysis.hpp"
#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/results/tables.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {

Summary solution_entries(bool converged, const std::string& status, double residual, int iterations,
                         int unknowns, double solve_seconds) {
  return {{quantities::converged, converged},
          {quantities::status, status},
          {quantities::residual, residual},
          {quantities::iterations, std::int64_t{iterations}},
          {quantities::unknowns, std::int64_t{unknowns}},
          {quantities::solve_seconds, solve_seconds}};
}

void insert_wall_seconds(Summary& summary, double seconds) {
  const auto place = std::find_if(summary.begin(), summary.end(), [](const Entry& entry) {
    return entry.name == quantities::solve_seconds.name;
  });
  summary.insert(place, Entry(quantities::wall_seconds, seconds));
}

void append_discretisation(Summary& summary, const Time& time) {
  summary.emplace_back(quantities::trial, time.trial);
  summary.emplace_back(quantities::weight, time.weight);
  summary.emplace_back(quantities::formulation, name_of(time.formulation));
  summary.emplace_back(quantities::inner_products, name_of(effective_inner_products(time)));
  summary.emplace_back(quantities::functions, std::int64_t{time.functions});
  summary.emplace_back(quantities::quadrature_points, std::int64_t{time.quadrature_points});
  if (time.sample_offset != 0.0) summary.emplace_back(quantities::sample_offset, time.sample_offset);
  if (time.functions % 2 == 0) summary.emplace_back(quantities::nyquist, name_of(time.nyquist));
}

void append_structure(Summary& summary, const Scene& scene, const StructureModel& model) {
  const int contacts = whole_contact_count(scene);
  summary.emplace_back(quantities::contacts, std::int64_t{contacts});
  if (const std::string unit = displacement_unit(scene); unit != "m")
    summary.emplace_back(quantities::displacement_unit, unit);
  if (contacts != model.contacts())
    summary.emplace_back(quantities::contact_directions, std::int64_t{model.contacts()});
  summary.emplace_back(quantities::degrees_of_freedom, std::int64_t{model.unknowns});
  summary.emplace_back(quantities::reduced_degrees_of_freedom, std::int64_t{model.size()});
  summary.emplace_back(quantities::reduction_seconds, model.reduction_seconds);
  if (std::isfinite(model.frequency_change))
    summary.emplace_back(quantities::contact_mass_frequency_change, model.frequency_change);
}

void append_condition(Record& record, double condition, double rounding_error) {
  constexpr double largest_condition = 1e12;
  if (std::isinf(condition)) {
    record.warnings.emplace_back("a system of the solution is singular to working precision");
  } else if (condition > largest_condition) {
    record.warnings.push_back(
        fmt::format("the condition estimate {:.1e} is past {:.0e}: up to {:.0f} of 16 digits may be lost",
                    condition, largest_condition, std::ceil(std::log10(condition))));
  }
  constexpr double ordinary_rounding_error = 1e-6;
  if (rounding_error > ordinary_rounding_error)
    record.warnings.push_back(fmt::format(
        "the rounding error of the condensation is estimated at {:.1e} of the motion: fewer than six digits are accurate",
        rounding_error));
  record.summary.emplace_back(quantities::condition_estimate, condition);
  record.summary.emplace_back(quantities::rounding_error_estimate, rounding_error);
  record.summary.emplace_back(quantities::warnings, record.warnings);
}

void add_contacts(Record& record, const Scene& scene, const solvers::Motion& contacts, int leading) {
  if (contacts.rows() < 2) return;
  const SceneContact place = contact_places(scene).at(static_cast<std::size_t>(leading));
  record.summary.emplace_back(quantities::leading_contact, std::int64_t{place.number});
  if (place.directions > 1) record.summary.emplace_back(quantities::leading_direction, direction_name(place));
  record.contacts = contacts_table(scene, contacts);
}

void warn_of_scene(Record& record, const Scene& scene) {
  if (scene.forcing.amplitude == 0.0 && scene.forcing.terms.empty() && scene.forcing.weight.empty() &&
      scene.analysis.type != AnalysisType::amplitude_sweep)
    record.warnings.emplace_back("No load acts: forcing.amplitude is 0, and there are no [[forcing.terms]].");
  for (std::size_t i = 0; i < scene.contact.pairs.size(); ++i) {
    const ContactPair& pair = scene.contact.pairs[i];
    if (pair.side == ObstacleSide::both && has_gap(pair.law) && pair.gap < 0.0)
      record.warnings.push_back(fmt::format(
          "{}.gap is {:.4g} {} with side = \"both\": both obstacles press on the structure at rest.",
          pair_section(i), pair.gap, displacement_unit(scene)));
  }
}

void warn_of_open_contacts(Record& record, double distance, double gap, const std::string& unit) {
  if (std::isnan(distance)) {
    record.warnings.emplace_back("No contact closes.");
    return;
  }
  record.warnings.push_back(
      distance > 0.0
          ? fmt::format("No contact closes: the nearest stays {} short of its gap of {}.",
                        quantity(distance, unit), quantity(gap, unit))
          : fmt::format("No contact exerts a force, though one reaches its gap of {}.", quantity(gap, unit)));
}

void append_motion(Summary& summary, const Scene& scene, const solvers::Motion& contacts, int row) {
  const bool empty = contacts.empty();
  const solvers::Motion leading = empty ? solvers::Motion{} : contacts.contact(row);
  const Eigen::MatrixXd& u = leading.displacement;
  summary.emplace_back(quantities::max_displacement, empty ? missing : u.maxCoeff());
  summary.emplace_back(quantities::min_displacement, empty ? missing : u.minCoeff());
  summary.emplace_back(quantities::rms_displacement, empty ? missing : rms(u.reshaped()));
  const solvers::Vibration vibration =
      empty ? solvers::Vibration{missing, missing} : solvers::largest_vibration(u);
  summary.emplace_back(quantities::vibration, vibration.half_peak_to_peak);
  summary.emplace_back(quantities::rms_vibration, vibration.rms);
  summary.emplace_back(quantities::max_contact_force,
                       empty ? missing : largest_contact_force(scene, contacts, row));
  summary.emplace_back(quantities::contact_fraction,
                       empty ? missing : contact_fraction(scene, contacts, row));
}

void append_period(Record& record, int periods, int motion_periods) {
  if (periods == 1) return;
  record.summary.emplace_back(quantities::subharmonic, std::int64_t{periods});
  record.summary.emplace_back(quantities::period_of_motion, std::int64_t{motion_periods});
  if (motion_periods == periods) return;
  record.warnings.push_back(fmt::format(
      "analysis.subharmonic is {}, but the motion found repeats after {} of the load already: none of {} "
      "periods was found.",
      periods, motion_periods == 1 ? "one period" : fmt::format("{} periods", motion_periods), periods));
}

/// ", which analysis.subharmonic = 2 computes", where the scene takes it.
std::string computed_by(const Scene& scene, int periods) {
  SceneChange change = as_response(scene);
  change.set.push_back(fmt::format("analysis.subharmonic={}", periods));
  if (!accepts(scene, change)) return "";
  return fmt::format(
      ", which {}analysis.subharmonic = {} computes",
      scene.analysis.type == AnalysisType::forced_response ? "" : "analysis.type = \"forced_response\" with ",
      periods);
}

void append_attractor(Record& record, const Scene& scene, const Response& response) {
  if (response.attractor_periods < 0) return;
  record.summary.emplace_back(quantities::attractor_periods, std::int64_t{response.attractor_periods});
  const int attractor = response.attractor_periods;
  const char* start = response.flow ? "From contacts at rest" : "From rest";
  if (attractor > 0 && response.periods % attractor == 0) {
    if (!response.moves)
      record.warnings.push_back(
          "From rest the structure settles to a motion of this period, which the equations of these functions "
          "and points were not solved for. More time.functions or time.method = \"exact\" may find it.");
    return;
  }
  record.warnings.push_back(
      attractor == 0
          ? fmt::format("{} the motion did not repeat after up to 16 periods of the load within the periods "
                        "integrated: it is aperiodic, or has not settled yet.",
                        start)
          : fmt::format("{} the structure settles to a motion of {} periods of the load{}.", start, attractor,
                        computed_by(scene, attractor)));
}

void append_settled(Record& record, const Scene& scene, const Response& response) {
  if (!response.settled) return;
  const SettledBeside& beside = *response.settled;
  record.summary.emplace_back(quantities::settled_periods, std::int64_t{beside.periods});
  record.summary.emplace_back(quantities::settled_max_displacement,
                              beside.periods > 0 ? beside.max_displacement : missing);
  const std::string others =
      std::string(" Other motions were not sought") +
      (accepts(scene, {.analysis = "motions"}) ? "; analysis.type = \"motions\" seeks them." : ".");
  if (beside.periods > 0)
    record.warnings.push_back(fmt::format(
        "From rest the structure settles to {} motion, which repeats after {} of the load and has a largest "
        "displacement of {:.6g} m{}.{}",
        response.moves ? "another" : "a",
        beside.periods == 1 ? "one period" : fmt::format("{} periods", beside.periods),
        beside.max_displacement, response.moves ? "" : " by integration; contact phases did not solve for it",
        others));
  else
    record.warnings.push_back(
        (beside.periods == 0
             ? "From rest the motion did not repeat after up to 16 periods of the load within the periods "
               "integrated."
             : "What the structure settles to from rest is not known.") +
        others);
}

void append_other_motions(Record& record, const Scene& scene, const Response& response) {
  if (!response.moves || scene.contact.law == no_law) return;
  const bool integrated = integrates_in_time(scene.analysis.type) && !is_by_phases(response);
  const bool from_rest = response.settled || (response.attractor_periods >= 0 && !integrated);
  record.summary.emplace_back(quantities::other_motions,
                              std::string(from_rest ? "settled_from_rest" : "not_sought"));
}

void append_dissipation(Summary& summary, const Scene& scene, const Response& response) {
  if (!has_damped_contact(scene)) return;
  const solvers::Motion& motion = response.contacts;
  const solvers::ContactLaws laws = make_laws(scene);
  double power = !response.moves || motion.empty() ? missing : 0.0;
  for (int row = 0; row < motion.rows(); row += laws[row].rows())
    if (!laws[row].friction()) power += motion.force.row(row).dot(motion.velocity.row(row)) / motion.points();
  summary.emplace_back(quantities::contact_dissipation, power / scene.forcing.frequency);
}

std::string_view name_of(solvers::FrictionPart::State state) {
  using enum solvers::FrictionPart::State;
  if (state == open) return "open";
  return state == stick ? "stick" : "slip";
}

/// Of contacts with friction all parts of the period, by what they do in them.
Table phases_table(const Scene& scene, const solvers::PhaseMotion& motion) {
  const std::vector<SceneContact> places = contact_places(scene);
  const auto number_of = [&](int row) { return std::int64_t{places.at(std::size_t(row)).number}; };
  if (motion.friction.empty()) {
    Table phases({"contact", "begin", "end"});
    for (const solvers::ContactPhase& phase : motion.phases)
      if (places.at(std::size_t(phase.contact)).place == 0)
        phases.append_row({number_of(phase.contact), phase.begin, phase.end});
    return phases;
  }
  Table phases({"contact", "state", "begin", "end"});
  for (const solvers::FrictionAlong& contact : motion.friction)
    for (const solvers::FrictionPart& part : contact.parts)
      phases.append_row({number_of(contact.row), std::string(name_of(part.state)), part.begin, part.end});
  return phases;
}

/// The relative error of the vibration of the leading contact; missing without a motion.
double error_of_vibration(const solvers::PhaseMotion& motion, const Response& response) {
  if (motion.parts == nullptr) return missing;
  const Eigen::MatrixXd exact = motion.displacement(time_fractions(response.contacts.points()));
  const double vibration = solvers::largest_vibration(exact.row(response.contact)).half_peak_to_peak;
  return std::abs(solvers::largest_vibration(response.leading().displacement).half_peak_to_peak - vibration) /
         vibration;
}

void append_phases(Record& record, const Scene& scene, const Response& response) {
  const solvers::ResponsePhases& found = *response.phases;
  const bool known = found.motion.parts != nullptr;
  if (is_by_phases(response)) {
    record.summary.emplace_back(quantities::tolerance, scene.time.tolerance);
    record.summary.emplace_back(quantities::estimated_error, known ? found.motion.estimated_error : missing);
    record.summary.emplace_back(quantities::start_functions, std::int64_t{response.start_functions});
  } else {
    record.summary.emplace_back(quantities::phases_status, std::string(to_string(found.motion.status)));
    record.summary.emplace_back(quantities::error_of_vibration, error_of_vibration(found.motion, response));
    record.summary.emplace_back(quantities::error_of_displacement, found.displacement_error);
    record.summary.emplace_back(quantities::error_of_force, found.force_error);
  }
  record.summary.emplace_back(quantities::phases_estimated_error,
                              known ? found.motion.estimated_error : missing);
  record.summary.emplace_back(quantities::phases_unknowns, std::int64_t{found.motion.unknowns});
  record.summary.emplace_back(quantities::phases, phases_table(scene, found.motion));
  const bool none = found.motion.status == solvers::PhasesStatus::not_found && !is_by_phases(response);
  if (response.stability && !none)
    record.summary.emplace_back(quantities::stability_by,
                                std::string(response.stability->by_phases ? "phases" : "balance"));
  if (!none) return;
  record.warnings.emplace_back(
      "Contact phases found no motion of the structure near this response, which solves the equations at its samples "
      "alone. Whether there is one is not known. More functions may lead to it.");
}

void append_start(Record& record, const StartMotion& start, bool found, double distance) {
  if (start.contacts.empty()) return;
  record.summary.emplace_back(quantities::start_from, start.source);
  record.summary.emplace_back(quantities::start_distance, found ? distance : missing);
  constexpr double as_large_as_the_start = 0.9;
  if (found && distance > as_large_as_the_start)
    record.warnings.push_back(fmt::format(
        "The motion found differs from the start by {:.2g} times the start: it may lie on another branch.",
        distance));
  if (!found && !record.interrupted)
    record.warnings.push_back(
        "No response was found near the start. One closer to the scene, or a sweep that begins at it, may lead "
        "there; without a start other ways of finding a response are tried.");
}

void set_warnings(Record& record) {
  const std::string_view name = quantities::warnings.name;
  const auto found = std::find_if(record.summary.begin(), record.summary.end(),
                                  [name](const Entry& entry) { return entry.name == name; });
  if (found != record.summary.end())
    *found = Entry(quantities::warnings, record.warnings);
  else
    record.summary.emplace_back(quantities::warnings, record.warnings);
}

}  // namespace wavebalance::app

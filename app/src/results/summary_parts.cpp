#include "results/record_parts.hpp"

#include "files/missing.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {

void begin_summary(Record& record, double residual, int iterations, int unknowns, double solve_seconds) {
  record.summary = {{quantities::converged, record.converged},
                    {quantities::status, record.status},
                    {quantities::residual, residual},
                    {"iterations", iterations},
                    {"unknowns", unknowns},
                    {quantities::solve_seconds, solve_seconds}};
}

void insert_wall_seconds(Summary& summary, double seconds) {
  summary.insert(std::ranges::find(summary, quantities::solve_seconds.name, &Entry::name),
                 Entry(quantities::wall_seconds, seconds));
}

void append_discretisation(Summary& summary, const Time& time) {
  summary.emplace_back(quantities::trial, time.trial);
  summary.emplace_back(quantities::weight, time.weight);
  summary.emplace_back(quantities::formulation, name_of(time.formulation));
  summary.emplace_back(quantities::inner_products, name_of(effective_inner_products(time)));
  summary.emplace_back(quantities::functions, time.functions);
  summary.emplace_back(quantities::quadrature_points, time.quadrature_points);
  if (time.sample_offset != 0.0) summary.emplace_back(quantities::sample_offset, time.sample_offset);
  if (time.functions % 2 == 0) summary.emplace_back(quantities::nyquist, name_of(time.nyquist));
}

void append_structure(Summary& summary, const Scene& scene, const StructureModel& model) {
  const int contacts = whole_contact_count(scene);
  summary.emplace_back(quantities::contacts, contacts);
  if (const std::string unit = displacement_unit(scene); unit != "m")
    summary.emplace_back(quantities::displacement_unit, unit);
  if (contacts != model.contacts()) summary.emplace_back(quantities::contact_directions, model.contacts());
  summary.emplace_back(quantities::degrees_of_freedom, model.unknowns);
  summary.emplace_back(quantities::reduced_degrees_of_freedom, model.size());
  summary.emplace_back(quantities::reduction_seconds, model.reduction_seconds);
  if (std::isfinite(model.frequency_change))
    summary.emplace_back("contact_mass_frequency_change", model.frequency_change);
}

void append_condition(Record& record, double condition, double rounding_error) {
  constexpr double largest_condition = 1e12;
  if (std::isinf(condition)) {
    record.warnings.emplace_back("a system of the solution is singular to working precision");
  } else if (condition > largest_condition) {
    warn(record, "the condition estimate {} is past {}: up to {:.0f} of 16 digits may be lost",
         short_number(condition, 2), short_number(largest_condition, 1), std::ceil(std::log10(condition)));
  }
  constexpr double ordinary_rounding_error = 1e-6;
  if (rounding_error > ordinary_rounding_error)
    warn(record,
         "poor conditioning: rounding errors of the dynamic condensation are about {} of the "
         "motion, so fewer than six digits are accurate",
         short_number(rounding_error, 2));
  record.add("condition_estimate", condition);
  record.add("rounding_error_estimate", rounding_error);
  record.add(quantities::warnings, record.warnings);
}

void add_contacts(Record& record, const Scene& scene, const solvers::Motion& contacts, int leading) {
  if (contacts.rows() < 2) return;
  const SceneContact place = contact_places(scene).at(static_cast<std::size_t>(leading));
  record.add(quantities::leading_contact, place.number);
  if (!place.name.empty()) record.add(quantities::leading_contact_name, place.name);
  if (place.directions > 1) record.add(quantities::leading_direction, direction_name(place));
  record.contacts = contacts_table(scene, contacts);
}

void warn_of_scene(Record& record, const Scene& scene) {
  if (scene.forcing.amplitude == 0.0 && scene.forcing.terms.empty() && scene.forcing.weight.empty() &&
      scene.analysis.type != AnalysisType::amplitude_sweep && kind_of(scene.analysis.type).under_load)
    record.warnings.emplace_back("No load acts: forcing.amplitude is 0, and there are no [[forcing.terms]].");
  for (std::size_t i = 0; i < scene.contact.pairs.size(); ++i) {
    const ContactPair& pair = scene.contact.pairs[i];
    if (pair.side == ObstacleSide::both && has_gap(pair.law) && pair.gap < 0.0)
      warn(record, "{}.gap is {} with side = \"both\": both obstacles press on the structure at rest.",
           pair_section(i), quantity(pair.gap, displacement_unit(scene)));
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

void warn_of_unbalanced_load(Record& record, const StructureModel& model) {
  const Eigen::MatrixXd& rigid = model.structure.rigid_modes;
  if (rigid.cols() == 0 || record.status != "unbalanced") return;
  const Eigen::MatrixXd moved = model.reduced() ? Eigen::MatrixXd(model.recovery * rigid) : rigid;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index i = 0; i < moved.cols(); ++i) {
    Eigen::Index row = 0;
    moved.col(i).cwiseAbs().maxCoeff(&row);
    if (std::ranges::find(rows, row + 1) == rows.end()) rows.push_back(row + 1);
  }
  warn(record,
       "The structure is free to move along {} rigid motion{}, which move degree{} of freedom "
       "{} most. No contact force balances its static load, so no periodic motion exists.",
       rigid.cols(), rigid.cols() == 1 ? "" : "s", rows.size() == 1 ? "" : "s", fmt::join(rows, ", "));
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

void append_free_motion(Record& record, const Scene& scene, const StructureModel& model, Response& response,
                        double frequency, double shown,
                        const std::function<solvers::Motion(int)>& structure) {
  if (scene.analysis.has_outputs()) response.structure = structure(scene.analysis.output_points);
  append_outputs(record, scene, model, response, {frequency, 0.0, 1});
  record.response = response_table(response.leading());
  add_contacts(record, scene, response.contacts, response.contact);
  if (scene.analysis.motion_points > 0)
    for (RecordFile& file : motion_files(model, structure(scene.analysis.motion_points).displacement))
      record.files.push_back(std::move(file));
  record.figure = motion_figure(scene, response, shown);
  lead_with_output(record, scene);
}

void append_period(Record& record, int periods, int motion_periods) {
  if (periods == 1) return;
  record.add(quantities::subharmonic, periods);
  record.add(quantities::period_of_motion, motion_periods);
  if (motion_periods == periods) return;
  warn(record,
       "analysis.subharmonic is {}, but the motion repeats after {} of the load: no motion of "
       "{} periods was found.",
       periods, motion_periods == 1 ? "one period" : fmt::format("{} periods", motion_periods), periods);
}

/// Contacts with friction: all parts of the period, by state.
Table intervals_table(const Scene& scene, const solvers::ExactSolution& motion) {
  const std::vector<SceneContact> places = contact_places(scene);
  const auto number_of = [&](int row) { return std::int64_t{places.at(std::size_t(row)).number}; };
  const bool named = !contact_labels(scene).empty();
  std::vector<Summary> rows;
  const auto add = [&](int contact, const std::string& state, double begin, double end) {
    Summary& row = rows.emplace_back(Summary{{"contact", number_of(contact)}});
    if (!state.empty()) row.emplace_back("state", state);
    row.emplace_back("begin", begin);
    row.emplace_back("end", end);
    if (named) row.emplace_back("name", whole_name_of(places.at(std::size_t(contact))));
  };
  if (motion.friction.empty()) {
    for (const solvers::ForceInterval& interval : motion.intervals)
      if (places.at(std::size_t(interval.contact)).place == 0)
        add(interval.contact, "", interval.begin, interval.end);
    return rows.empty() ? Table({"contact", "begin", "end"}) : table_of(rows);
  }
  for (const solvers::FrictionAlong& contact : motion.friction)
    for (const solvers::FrictionPart& part : contact.parts)
      add(contact.row, state_name(part.state), part.begin, part.end);
  return rows.empty() ? Table({"contact", "state", "begin", "end"}) : table_of(rows);
}

void append_start(Record& record, const StartMotion& start, bool found, double distance) {
  if (start.contacts.empty()) return;
  record.add(quantities::start_from, start.source);
  record.add("start_distance", found ? distance : missing);
  constexpr double as_large_as_the_start = 0.9;
  if (found && distance > as_large_as_the_start)
    warn(record, "The motion differs from the start by {} times the start: it may be on another branch.",
         short_number(distance, 2));
  if (!found && !record.interrupted)
    record.warnings.push_back(
        "No response was found near the start. A closer start, or a sweep from it, may lead "
        "there. Without a start other strategies are tried.");
}

void set_warnings(Record& record) {
  if (Entry* found = find_entry(record.summary, quantities::warnings.name))
    *found = Entry(quantities::warnings, record.warnings);
  else
    record.add(quantities::warnings, record.warnings);
}

}  // namespace wavebalance::app

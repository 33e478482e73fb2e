#include "results/record_parts.hpp"

#include "drawing/figures.hpp"
#include "files/missing.hpp"
#include "files/number_text.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

using solvers::SweepPoint;

double displacement_error(const ExactAlongSweep::Point& point) {
  return point ? point->displacement_error : missing;
}
double force_error(const ExactAlongSweep::Point& point) { return point ? point->force_error : missing; }

/// Over the curve and its branches.
void append_exact_of_points(Record& record, const Sweep& sweep) {
  std::vector<ExactAlongSweep::Point> points;
  for (const ExactAlongSweep& curve : sweep.exact)
    points.insert(points.end(), curve.points.begin(), curve.points.end());
  if (points.empty()) return;
  const auto found = std::ranges::count_if(points, [](const ExactAlongSweep::Point& point) {
    return point && point->status == solvers::ExactStatus::converged;
  });
  const auto none = std::ranges::count_if(points, was_not_found);
  const auto all = static_cast<std::int64_t>(points.size());
  record.add("largest_error_of_displacement", largest_of(points, displacement_error));
  record.add("largest_error_of_force", largest_of(points, force_error));
  record.add("points_phases_converged", found);
  record.add("points_not_found", none);
  record.add("points_phases_not_known", all - found - none);
  if (none == 0) return;
  warn(record,
       "At {} of {} points of the curve no exact periodic solution was found, for example "
       "between a computed fold and the exact one. Their stability is not reported. More "
       "functions may help.",
       none, all);
}

/// "the fold at 1312.3 Hz", of those without a motion near.
void append_places(std::vector<std::string>& places, const std::vector<solvers::SpecialPoint>& points,
                   const ExactAlongSweep& exact, const Sweep& sweep) {
  for (std::size_t i = 0; i < exact.special_points.size(); ++i) {
    if (!was_not_found(exact.special_points[i])) continue;
    const std::string type(to_string(points[i].type));
    places.push_back(
        fmt::format("the {} at {}", spaced_words(type),
                    quantity(parameter_of(points[i], sweep.curve.parameter), sweep_axis(sweep).unit, 7)));
  }
}

void warn_of_places(Record& record, const Sweep& sweep) {
  std::vector<std::string> places;
  if (was_not_found(sweep.exact.front().peak)) places.emplace_back("the peak");
  for (std::size_t i = 0; i < sweep.exact.size(); ++i)
    append_places(places, sweep.balances_of(i).special_points, sweep.exact[i], sweep);
  if (places.empty()) return;
  warn(record,
       "No exact periodic solution was found near these points of the curve: {}. Whether the "
       "exact branch has these points is not known. More functions may help.",
       fmt::join(places, ", "));
}

void append_exact(Record& record, const Sweep& sweep) {
  if (sweep.exact.empty()) return;
  const ExactAlongSweep::Point& peak = sweep.exact.front().peak;
  record.add(quantities::phases_status, exact_status(peak));
  record.add(quantities::error_of_displacement, displacement_error(peak));
  record.add(quantities::error_of_force, force_error(peak));
  append_exact_of_points(record, sweep);
  warn_of_places(record, sweep);
}

void append_vibration(Record& record, const Scene& scene, const Sweep& sweep) {
  const solvers::FrequencySweep& curve = sweep.curve;
  const SweepAxis axis = sweep_axis(sweep);
  std::vector<double> places, values;
  for (const SweepPoint& point : curve.points) {
    places.push_back(parameter_of(point, curve.parameter));
    values.push_back(point.vibration);
  }
  const bool any = !values.empty();
  const std::size_t peak = any ? vibration_peak_of(curve) : 0;
  const PeakResolution resolution =
      any ? peak_resolution(places, values, peak) : PeakResolution{missing, missing};
  record.add(quantities::vibration, any ? values[peak] : missing);
  record.add(quantities::in_unit(quantities::vibration_places, axis.unit), any ? places[peak] : missing);
  record.add(quantities::rms_vibration, largest_of(curve.points, &SweepPoint::rms_vibration));
  record.add(quantities::peak_value_resolution, resolution.value);
  record.add(quantities::peak_place_resolution, resolution.place);
  if (!sweep.exact.empty() && !scene.analysis.exact)
    record.add(quantities::error_of_vibration,
               error_of_vibration(curve, sweep.exact.front().peak, scene.analysis.output_points));
}

void append_friction_along(Record& record, const Sweep& sweep) {
  if (sweep.friction.empty()) return;
  const std::vector<FrictionShares>& along = sweep.friction.front();
  record.add(quantities::max_slip_fraction, largest_of(along, &FrictionShares::slip_fraction));
  record.add(quantities::max_open_fraction, largest_of(along, &FrictionShares::open_fraction));
}

void append_impacts(Record& record, const Sweep& sweep) {
  if (sweep.impacts.empty()) return;
  const std::vector<PointImpacts>& along = sweep.impacts.front();
  record.add(quantities::max_impulse, largest_of(along, &PointImpacts::largest_impulse));
  record.add(quantities::max_impact_velocity, largest_of(along, &PointImpacts::largest_speed));
  if (sweep.by_impacts() && sweep.periods > 1) record.add(quantities::period_of_motion, sweep.periods);
}

/// The largest contact force of a curve: from the law at the largest displacement, or from the samples if
/// contacts differ or the displacement does not determine it.
double largest_force(const Scene& scene, const solvers::FrequencySweep& curve, double displacement) {
  if (curve.points.empty() || solves_by_impacts(scene)) return missing;
  const std::vector<SceneContact> contacts = contacts_of(scene);
  const bool one = std::ranges::all_of(
      contacts, [&](const SceneContact& other) { return !other.pair && other.same_law(contacts.front()); });
  const std::string& law = scene.contact.law;
  if (one && curve.form != solvers::ContactForm::force && !is_damped(law) && !acts_on_both_sides(law))
    return make_laws(scene)[0].force(displacement);
  return largest_of(curve.points, &SweepPoint::max_force);
}

/// Whether a contact closes anywhere along the curve.
bool touches(const Sweep& sweep) {
  const auto strikes = [](const PointImpacts& point) { return point.count > 0; };
  return largest_of(sweep.curve.points, &SweepPoint::max_force) > 0.0 ||
         (!sweep.impacts.empty() && std::ranges::any_of(sweep.impacts.front(), strikes));
}

/// Per point, the largest if they differ.
int unknowns_of(const Scene& scene, const StructureModel& model, const Sweep& sweep) {
  if (!sweep.by_impacts()) return model.contacts() * scene.time.functions;
  const auto unknowns = [](const PointImpacts& point) { return 2.0 * point.count + 1.0; };
  return sweep.impacts.front().empty() ? 0 : int(largest_of(sweep.impacts.front(), unknowns));
}

}  // namespace

void append_exact(Summary& row, const ExactAlongSweep::Point& point) {
  row.emplace_back(quantities::error_of_displacement, displacement_error(point));
  row.emplace_back(quantities::error_of_force, force_error(point));
  row.emplace_back(quantities::phases_status, exact_status(point));
}

PeakResolution peak_resolution(std::span<const double> places, std::span<const double> values,
                               std::size_t index) {
  if (index == 0 || index + 1 >= values.size()) return {};
  const auto [low, high] = std::minmax_element(places.begin(), places.end());
  const double extent = std::max(*high - *low, 1e-300), height = values[index];
  const auto distance = [&](std::size_t a, std::size_t b) {
    return std::hypot((places[a] - places[b]) / extent, (values[a] - values[b]) / height);
  };
  const double before = distance(index - 1, index), after = distance(index, index + 1);
  if (!(before > 0.0) || !(after > 0.0)) return {};
  const double rise = (values[index] - values[index - 1]) / before,
               fall = (values[index + 1] - values[index]) / after;
  const double slope = (rise * after + fall * before) / (before + after),
               curvature = (fall - rise) / (before + after);
  if (!(curvature < 0.0)) return {};
  const double way = -0.5 * slope / curvature;
  const std::size_t beside = way < 0.0 ? index - 1 : index + 1;
  return {std::abs(0.25 * slope * slope / curvature / height),
          std::abs(way / (way < 0.0 ? before : after) * (places[beside] - places[index]))};
}

void leave_out_contact_fractions(const Scene& scene, Sweep& sweep) {
  const std::vector<SceneContact> contacts = contacts_of(scene);
  if (std::ranges::none_of(contacts, [](const SceneContact& one) { return acts_everywhere(one.law); }))
    return;
  const auto leave_out = [](solvers::FrequencySweep& curve) {
    for (solvers::SweepPoint& point : curve.points) point.contact_fraction = missing;
  };
  leave_out(sweep.curve);
  for (solvers::Branch& branch : sweep.branches) leave_out(branch.curve);
  for (Sweep& isola : sweep.isolas) leave_out(isola.curve);
}

Record sweep_record(const Scene& scene, const StructureModel& model, const Sweep& sweep,
                    const SweepOutputs& outputs, const std::vector<CurveMotion>& motions) {
  Record record;
  record.interrupted = sweep.stopped();
  record.converged = sweep.converged() && !record.interrupted;
  const bool undetermined = sweep.start_status == to_string(solvers::ExactStatus::undetermined);
  record.status = record.interrupted ? "interrupted" : undetermined ? sweep.start_status : sweep.status();
  record.warnings = model.warnings;
  warn_of_unbalanced_load(record, model);
  if (!sweep.start_status.empty() && !record.interrupted && !undetermined)
    warn(record, "No periodic motion was found at the start of the curve: {}.", sweep.start_status);
  const double highest = largest_of(sweep.curve.points, &SweepPoint::max_displacement);
  const int points = static_cast<int>(sweep.curve.points.size());
  begin_summary(record, largest_of(sweep.curve.points, &SweepPoint::residual), points,
                unknowns_of(scene, model, sweep), sweep.wall_seconds);
  record.add(quantities::max_displacement, highest);
  record.axis = sweep_axis(sweep);
  record.add(
      quantities::in_unit(quantities::peak_places, record.axis.unit),
      points == 0 ? missing : parameter_of(sweep.curve.points[peak_of(sweep.curve)], sweep.curve.parameter));
  record.add(quantities::min_displacement, least_of(sweep.curve.points, &SweepPoint::min_displacement));
  record.add(quantities::rms_displacement, largest_of(sweep.curve.points, &SweepPoint::rms_displacement));
  append_vibration(record, scene, sweep);
  append_friction_along(record, sweep);
  record.add(quantities::max_contact_force, largest_force(scene, sweep.curve, highest));
  record.add(quantities::contact_fraction, largest_of(sweep.curve.points, &SweepPoint::contact_fraction));
  record.add(quantities::analysis, name_of(scene.analysis.type));
  if (scene.analysis.type == AnalysisType::amplitude_sweep)
    record.add(quantities::frequency, scene.forcing.frequency);
  record.add(quantities::points, points);
  warn_of_scene(record, scene);
  if (points > 0 && scene.contact.law != no_law && !touches(sweep))
    warn_of_open_contacts(record, common_gap(scene) - highest, common_gap(scene), displacement_unit(scene));
  if (!sweep.by_impacts()) append_period(record, sweep.periods, sweep.motion_periods);
  append_impacts(record, sweep);
  append_stability(record, scene, sweep);
  append_exact(record, sweep);
  if (scene.analysis.branches) append_branches(record, sweep);
  append_isolas(record, scene, sweep);
  append_motions(record, scene, model, sweep, motions);
  if (sweep.by_impacts()) {
    record.add(quantities::solved_by, "impacts");
  } else if (!sweep.exact_motions.empty() || scene.analysis.exact) {
    record.add(quantities::solved_by, name_of(TimeMethod::exact));
  } else {
    append_discretisation(record.summary, scene.time);
    record.add(quantities::form, to_string(sweep.curve.form));
    append_condition(record, sweep.curve.condition, sweep.curve.rounding_error);
  }
  append_structure(record.summary, scene, model);
  append_rest(record, scene, model);
  const bool each = scene.analysis.has_outputs() && whole_contact_count(scene) > 1;
  record.sweep =
      sweep_table(sweep, scene.analysis.branches, each ? contact_places(scene) : std::vector<SceneContact>());
  append_outputs(record, scene, sweep, outputs);
  append_whirls(record, scene, model);
  if (points > 0) record.figure = sweep_figure(scene, sweep, outputs);
  return record;
}

}  // namespace wavebalance::app

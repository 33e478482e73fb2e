#include "results/analyses.hpp"

#include "drawing/figures.hpp"
#include "files/missing.hpp"
#include "results/quantities.hpp"
#include "results/record_parts.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/modes.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/files/wall_clock.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/solvers/modes/mode_stability.hpp"

namespace wavebalance::app {
namespace {

using solvers::ModePoint;
using solvers::ModeStatus;

/// Whether the curve comes to its end along an internal resonance, whose points then belong to the mode.
bool ends_on_resonance(const Backbone& curve) {
  return curve.complete && !curve.points.empty() &&
         curve.points.back().status == ModeStatus::internal_resonance;
}

/// The largest of a number over the points of the mode.
template <class Number>
double largest(const Backbone& curve, Number number) {
  const bool resonant = ends_on_resonance(curve);
  double value = missing;
  for (const ModePoint& point : curve.points)
    if (point.accepted() || (resonant && point.status == ModeStatus::internal_resonance))
      value = std::fmax(value, number(point));
  return value;
}

std::string joined_names(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

std::vector<std::string> all_resonances(const Backbone& curve) {
  std::vector<std::string> names;
  for (const Interruption& gap : curve.interruptions)
    for (const auto& name : gap.resonances)
      if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  return names;
}

int iterations_of(const Backbone& curve) {
  int total = 0;
  for (const ModePoint& point : curve.points) total += point.iterations;
  return total;
}

double worst_residual(const Backbone& curve) {
  double value = missing;
  for (std::size_t i = 0; i < curve.points.size(); ++i)
    if (curve.points[i].accepted()) value = std::fmax(value, curve.residuals[i]);
  return value;
}

void append_discretisation(Summary& summary, const ModeStudy& study) {
  const Analysis& analysis = study.scene().analysis;
  summary.emplace_back(quantities::analysis, name_of(analysis.type));
  summary.emplace_back(quantities::mode, analysis.mode);
  if (!study.elastic_mode() || study.scene().time.trial.empty()) {
    summary.emplace_back(quantities::harmonics, analysis.harmonics);
    summary.emplace_back(quantities::samples, analysis.samples);
  }
  if (study.elastic_mode()) append_discretisation(summary, mode_time(study.scene()));
  summary.emplace_back(quantities::linear_frequency, study.linear_frequency());
  append_structure(summary, study.scene(), study.model());
}

/// The gap of all contacts; missing if they differ.
double common_gap(const ModeStudy& study) {
  const Eigen::VectorXd& gaps = study.model().gaps;
  return (gaps.array() == gaps[0]).all() ? gaps[0] : missing;
}

void append_curve(Summary& summary, const Backbone& curve, double gap) {
  const double penetration = largest(curve, [](const auto& point) { return point.max_penetration; });
  summary.emplace_back(quantities::max_displacement, gap * (1.0 + penetration));
  summary.emplace_back(quantities::min_displacement, missing);
  summary.emplace_back(quantities::rms_displacement, missing);
  summary.emplace_back(quantities::max_contact_force,
                       largest(curve, [](const auto& point) { return point.force.maxCoeff(); }));
  summary.emplace_back(quantities::contact_fraction,
                       largest(curve, [](const auto& point) { return point.contact_fraction; }));
}

void append_statuses(Summary& summary, const Backbone& curve) {
  summary.emplace_back(quantities::points, curve.points.size());
  for (const auto status : {ModeStatus::converged, ModeStatus::internal_resonance, ModeStatus::cycling,
                            ModeStatus::no_contact, ModeStatus::singular})
    summary.emplace_back("points_" + std::string(to_string(status)), std::int64_t{curve.count(status)});
  summary.emplace_back(quantities::tongues, joined_names(all_resonances(curve)));
  summary.emplace_back("interruptions", curve.interruptions.size());
}

/// The points of a curve where no motion was found, which near an internal resonance leave it converged.
void warn_of_failed_points(Record& record, const Backbone& curve) {
  std::vector<std::string> counts;
  int failed = 0;
  for (const auto status : {ModeStatus::cycling, ModeStatus::no_contact, ModeStatus::singular}) {
    const int count = curve.count(status);
    if (count > 0) counts.push_back(fmt::format("{} {}", count, to_string(status)));
    failed += count;
  }
  if (failed == 0) return;
  std::vector<std::string> ranges;
  for (const Interruption& gap : curve.interruptions)
    if (!gap.status.empty())
      ranges.push_back(gap.first_ratio < gap.last_ratio
                           ? short_number(gap.first_ratio, 5) + " to " + short_number(gap.last_ratio, 5)
                           : short_number(gap.first_ratio, 5));
  warn(record,
       "At {} of {} points of the branch no motion was found ({}), at frequency ratios {}. "
       "analysis.samples = 2 x analysis.harmonics, or other harmonics, may help.",
       failed, curve.points.size(), fmt::join(counts, ", "), fmt::join(ranges, ", "));
}

void append_quality(Summary& summary, double penetration, double min_force, double virial_residual) {
  summary.emplace_back(quantities::max_penetration_over_gap,
                       std::isnan(penetration) ? missing : std::max(0.0, penetration));
  summary.emplace_back(quantities::min_contact_force, min_force);
  summary.emplace_back(quantities::virial_residual, virial_residual);
}

/// The word for a rigid obstacle, at which contacts with mass have no linearised motion.
constexpr const char* no_law_of_impact = "no_law_of_impact";

Table table_of(const ModeStudy& study, const std::vector<solvers::ModeSpecialPoint>& points) {
  Table table(
      {"type", "frequency_Hz", "bracket_Hz", "energy_ratio", "multiplier_real", "multiplier_imag", "status"});
  const double hertz = study.linear_frequency() / study.mode().linear_omega();
  for (const auto& point : points)
    table.append_row({std::string(to_string(point.type)), hertz * point.omega, hertz * point.bracket,
                      point.energy_ratio, point.multiplier.real(), point.multiplier.imag(),
                      std::string(point.located ? "located" : "bracketed")});
  return table;
}

/// The stability along a backbone of an elastic mode; without points otherwise, and where analysis.stability
/// is false.
solvers::BackboneStability stability_of(const ModeStudy& study, const Backbone& curve,
                                        const Observer& observer) {
  if (!study.elastic_mode() || !study.scene().analysis.stability) return {};
  solvers::ModeStabilityOptions options;
  options.observer = observer;
  return solvers::backbone_stability(*study.elastic_mode(),
                                     {solvers::BackboneStatus::reached_energy, curve.points}, options);
}

/// The columns `unstable`, missing where it is not known, and `contacts` of a backbone_table() of the same
/// points, whose first rows are the linear ones. Without effect where there is no stability.
void add_stability(Table& table, const solvers::BackboneStability& stability) {
  const auto& points = stability.points;
  if (points.empty()) return;
  const std::size_t first = table.rows() - points.size();
  std::vector<double> unstable(table.rows(), 0.0), contacts(table.rows(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    unstable[first + i] = points[i].unstable >= 0 ? points[i].unstable : missing;
    contacts[first + i] = points[i].contacts;
  }
  table.add_column("unstable", unstable).add_column("contacts", contacts);
}

/// The fields of a curve's stability.
void append_stability(Summary& summary, const ModeStudy& study, const solvers::BackboneStability& stability) {
  if (!study.scene().analysis.stability) return;
  if (!study.elastic_mode()) {
    summary.emplace_back(quantities::stability, no_law_of_impact);
    return;
  }
  summary.emplace_back(quantities::stability,
                       stability.cancelled ? "interrupted" : std::string(to_string(stability.status())));
  summary.emplace_back(quantities::special_points, table_of(study, stability.special_points));
}

/// Multipliers of one motion, and a warning if it is unstable.
void append_stability(Record& record, const ModeStudy& study, const solvers::ModePoint& point) {
  if (!study.scene().analysis.stability) return;
  ResponseStability stability;
  stability.status = no_law_of_impact;
  stability.leading_error = missing;
  if (study.elastic_mode()) {
    const auto found = solvers::ModeMultipliers(*study.elastic_mode())(point);
    const bool known = found.status == solvers::StabilityStatus::converged;
    stability.status = !known ? to_string(found.status) : found.unstable > 0 ? "unstable" : "stable";
    stability.unstable = found.unstable;
    if (found.multipliers.size() > 0)
      stability.leading = {found.multipliers[0].real(), std::abs(found.multipliers[0].imag())};
    stability.leading_error = found.error;
  }
  append_stability(record, stability, "free motion");
}

Record curve_record(const ModeStudy& study, const Observer& observer) {
  const Backbone curve = study.backbone(observer);
  const solvers::BackboneStability stability = stability_of(study, curve, observer);
  Record record;
  record.converged = curve.converged();
  record.status = curve.status();
  begin_summary(record, worst_residual(curve), iterations_of(curve), study.unknowns(), curve.wall_seconds);
  append_curve(record.summary, curve, common_gap(study));
  append_discretisation(record.summary, study);
  append_statuses(record.summary, curve);
  warn_of_failed_points(record, curve);
  const bool gapless = study.scene().analysis.reference_length > 0.0;
  append_quality(record.summary,
                 gapless ? missing : largest(curve, [](const auto& point) { return point.max_penetration; }),
                 -largest(curve, [](const auto& point) { return -point.min_force; }),
                 largest(curve, [](const auto& point) { return point.virial_residual; }));
  record.add(quantities::largest_energy_ratio,
             largest(curve, [](const auto& point) { return point.energy_ratio; }));
  record.add(quantities::largest_frequency_ratio,
             largest(curve, [&](const auto& point) { return point.omega / study.mode().linear_omega(); }));
  append_stability(record.summary, study, stability);
  record.backbone = backbone_table(study, curve);
  const std::vector<ModeOutput> outputs =
      append_outputs(record, study.scene(), measure_outputs(study, curve));
  add_stability(record.backbone, stability);
  record.figure = backbone_figure(study.scene(), record.backbone, leading_of(outputs, study.scene()));
  draw_stability(record.figure, record.backbone, stability);
  draw_outputs(record, study.scene(), outputs, stability);
  if (!record.converged) record.figure.title += " (INCOMPLETE: " + plain(record.status) + ")";
  return record;
}

/// Whether a point is a motion of the requested energy, on an internal resonance or not.
bool is_motion_of(const ModePoint& point, double energy_ratio) {
  constexpr double same = 1e-8;
  return point.accepted() || (point.status == ModeStatus::internal_resonance &&
                              std::abs(point.energy_ratio / energy_ratio - 1.0) <= same);
}

Record motion_record(const ModeStudy& study) {
  const Scene& scene = study.scene();
  const WallClock clock;
  const ModePoint point = study.at_energy(scene.analysis.energy_ratio);
  Response response;
  response.contacts = study.contact_motion(point, scene.analysis.output_points);
  response.contact = leading_contact(response.contacts, study.model().gaps);
  response.wall_seconds = clock.seconds();
  const bool found = is_motion_of(point, scene.analysis.energy_ratio);
  const bool moves = found && !response.contacts.empty();
  const bool resonant = point.status == ModeStatus::internal_resonance;
  Record record;
  record.converged = response.converged = found;
  record.status = found && resonant ? "converged" : std::string(to_string(point.status));
  if (resonant && !found) record.status += " " + resonance_name(point.resonance);
  if (point.status == ModeStatus::no_contact) {
    const Backbone curve = study.backbone(scene.analysis.energy_ratio);
    record.status =
        curve.early_end.empty() ? "no neighbouring points of the branch enclose the energy" : curve.early_end;
  }
  begin_summary(record, moves ? study.residual(point) : missing, point.iterations, study.unknowns(),
                response.wall_seconds);
  append_motion(record.summary, scene, moves ? response.contacts : solvers::Motion{}, response.contact);
  append_discretisation(record.summary, study);
  const double ratio = point.omega / study.mode().linear_omega();
  record.add(quantities::frequency, moves ? ratio * study.linear_frequency() : missing);
  record.add(quantities::frequency_ratio, moves ? ratio : missing);
  record.add(quantities::rayleigh_frequency_ratio,
             moves ? std::sqrt(point.rayleigh) / study.mode().linear_omega() : missing);
  record.add(quantities::energy_ratio, moves ? point.energy_ratio : missing);
  if (found && resonant) {
    record.add(quantities::tongues, resonance_name(point.resonance));
    warn(record,
         "The motion is on the internal resonance {}: mode {} has {} of the kinetic energy. "
         "The branch follows this resonance, and no motion beyond it was found.",
         resonance_name(point.resonance), point.resonance.mode, percentage(point.resonance.share, 2));
  }
  const bool gapless = scene.analysis.reference_length > 0.0;
  append_quality(record.summary, moves && !gapless ? point.max_penetration : missing,
                 moves ? point.min_force : missing, moves ? point.virial_residual : missing);
  if (!moves) return record;
  append_stability(record, study, point);
  response.moves = true;
  const double frequency = ratio * study.linear_frequency();
  append_free_motion(record, scene, study.model(), response, frequency, std::round(100.0 * frequency) / 100.0,
                     [&](int points) { return study.structure_motion(point, points); });
  return record;
}

/// Modes of equal or nearly equal frequency, of which a mode follows one combination or runs into another.
void warn_of_equal_frequencies(Record& record, const ModeStudy& study) {
  constexpr double near = 1e-2, rounding = 1e-12;
  const Eigen::VectorXd omega = study.linear_modes().omega_squared.cwiseSqrt();
  const Eigen::Index mode = study.scene().analysis.mode - 1,
                     last = omega.size() - study.linear_modes().springs;
  for (const Eigen::Index other : {mode - 1, mode + 1}) {
    if (other < 0 || other >= last) continue;
    const double apart = std::abs(omega[other] - omega[mode]) / omega[mode];
    if (apart > near) continue;
    warn(record, "The linear frequencies of modes {} and {} {}: {}", std::min(mode, other) + 1,
         std::max(mode, other) + 1, apart <= rounding ? "are equal" : "differ by " + percentage(apart, 1),
         apart <= 2.0 * equal_frequencies
             ? "they were combined so that the first one moves the contacts most."
             : "beyond contact the branches may interact. Energies refer to the requested linear mode.");
  }
}

Record record_of(const ModeStudy& study, const Observer& observer) {
  return study.scene().analysis.energy_ratio > 0.0 ? motion_record(study) : curve_record(study, observer);
}

}  // namespace

Record mode_record(const Scene& scene, const StructureModel& model, const AnalysisOptions& how) {
  if (is_damped_mode(scene)) return damped_mode_record(scene, model, how);
  const Observer& observer = how.observer;
  goes_on(observer, {"linear modes"});
  const ModeStudy study(scene, model);
  goes_on(observer, {"backbone"});
  Record record = record_of(study, observer);
  warn_of_equal_frequencies(record, study);
  return record;
}

}  // namespace wavebalance::app

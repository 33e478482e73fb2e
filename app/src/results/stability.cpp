#include "results/record_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "files/missing.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

/// Frequencies, or amplitudes where these vary.
std::vector<double> places_of(const solvers::FrequencySweep& curve) {
  std::vector<double> places;
  for (const auto& turn : curve.turning_points) places.push_back(parameter_of(turn, curve.parameter));
  return places;
}

std::vector<double> folds_of(const solvers::CurveStability& stability, solvers::SweepParameter parameter) {
  std::vector<double> places;
  for (const auto& point : stability.special_points)
    if (point.type == solvers::SpecialPointType::fold) places.push_back(parameter_of(point, parameter));
  return places;
}

/// Points where contact begins may hide no fold.
bool folds_are_known(const solvers::CurveStability& stability) {
  using solvers::StabilityStatus;
  return !stability.points.empty() && std::ranges::all_of(stability.points, [](const auto& point) {
    return point.status == StabilityStatus::converged || point.status == StabilityStatus::too_few_samples;
  });
}

/// Rows of bifurcation and grazing points, each after `first`. Where the structure has no motion near there
/// is no multiplier. `exact` belongs to the curve, and is empty if computed only for others.
void append_special_points(std::vector<Summary>& rows, const Summary& first, const Sweep& sweep,
                           const solvers::CurveStability& stability, const ExactAlongSweep* exact) {
  for (std::size_t i = 0; i < stability.special_points.size(); ++i) {
    const solvers::SpecialPoint& point = stability.special_points[i];
    const bool sought = exact != nullptr && i < exact->special_points.size();
    const ExactAlongSweep::Point near = sought ? exact->special_points[i] : ExactAlongSweep::Point();
    const bool none = was_not_found(near);
    const SweepAxis axis = sweep_axis(sweep);
    Summary& row = rows.emplace_back(first);
    row.emplace_back("type", to_string(point.type));
    row.emplace_back(axis.column(), parameter_of(point, sweep.curve.parameter));
    row.emplace_back("bracket_" + axis.suffix, point.bracket);
    row.emplace_back("multiplier_real", none ? missing : point.multiplier.real());
    row.emplace_back("multiplier_imag", none ? missing : point.multiplier.imag());
    row.emplace_back(quantities::max_displacement, point.max_displacement);
    row.emplace_back(quantities::status, point.located ? "located" : "bracketed");
    if (exact != nullptr) append_exact(row, near);
  }
}

Table table_of(const Sweep& sweep) {
  std::vector<Summary> rows;
  append_special_points(rows, {}, sweep, sweep.stability, sweep.exact_of(0));
  return sweep.structure_points ? with_structure_points(std::move(rows), sweep) : table_of(rows);
}

/// No branch is followed there.
void warn_of_quasi_periodic_motions(Record& record, const std::vector<solvers::SpecialPoint>& points,
                                    const Sweep& sweep) {
  std::vector<std::string> places;  // as they are printed, each once
  for (const auto& point : points) {
    if (point.type != solvers::SpecialPointType::neimark_sacker) continue;
    const std::string place = quantity(parameter_of(point, sweep.curve.parameter), sweep_axis(sweep).unit, 6);
    if (std::ranges::find(places, place) == places.end()) places.push_back(place);
  }
  if (places.empty()) return;
  warn(record,
       "At the Neimark-Sacker point{} {} quasi-periodic motions begin, which are not on the "
       "curve. analysis.type = \"bifurcation_diagram\" follows them, and `wavebalance overlay` draws both.",
       places.size() == 1 ? "" : "s", fmt::join(places, ", "));
}

/// Where no motion of the curve stays.
void warn_where_all_are_unstable(Record& record, const std::vector<solvers::PointStability>& points) {
  std::size_t unstable = 0, unknown = 0;
  for (const solvers::PointStability& point : points) {
    unstable += point.unstable > 0;
    unknown += point.unstable < 0;
  }
  if (unstable == 0 || unstable + unknown < points.size()) return;
  const std::string known = unknown > 0
                                ? fmt::format("of known stability ({} of {}) ", unstable, points.size())
                                : std::string("of the curve ");
  warn(record, "All motions {}are unstable: the attractors are on other branches or not periodic.", known);
}

/// Whether a curve with this end can turn `count` times: an even number where it leaves the interval in the
/// direction in which it began, an odd one where it leaves it at its beginning.
bool can_turn(solvers::SweepStatus status, std::size_t count) {
  if (status == solvers::SweepStatus::reached_end) return count % 2 == 0;
  if (status == solvers::SweepStatus::returned) return count % 2 == 1;
  return true;
}

void append_turning_points(Record& record, const Sweep& sweep, bool known) {
  const std::string suffix = sweep_axis(sweep).suffix;
  const std::vector<double> of_samples = places_of(sweep.curve);
  const std::optional<std::vector<double>> of_structure = structure_folds(sweep);
  known = known || of_structure;
  const std::vector<double> folds =
      of_structure ? *of_structure : folds_of(sweep.stability, sweep.curve.parameter);
  const std::vector<double>& listed = known ? folds : of_samples;
  record.summary.emplace_back("turning_points_" + suffix, listed);
  const bool differ = known && folds.size() != of_samples.size();
  if (differ) record.summary.emplace_back("turning_points_of_samples_" + suffix, of_samples);
  if (!can_turn(sweep.curve.status, listed.size())) {
    warn(record,
         "turning_points_{} lists {} point{}, but a curve with this end has an {} number of "
         "folds: one is missing, or a listed point is none.{}",
         suffix, listed.size(), listed.size() == 1 ? "" : "s", listed.size() % 2 == 0 ? "odd" : "even",
         differ ? " All turning points of the sampled curve are in turning_points_of_samples_" + suffix + "."
                : "");
    return;
  }
  if (!known || folds.size() >= of_samples.size()) return;
  warn(
      record,
      "The curve turns {} times, but the motion has {} fold{}: the other turns are discretisation artefacts.",
      of_samples.size(), folds.size(), folds.size() == 1 ? "" : "s");
}

/// Whether stability is known along the curve, or at how many points it is not and why, and where motions are
/// unstable.
void append_status_along(Record& record, const Sweep& sweep, bool complete) {
  const StabilityAlong along = sweep.stability_of(0);
  const auto count = [&](auto is) { return std::ranges::count_if(along.points, is); };
  const auto known = count([](const auto& point) { return point.unstable >= 0; });
  const std::int64_t left = std::ssize(sweep.curve.points) - known;
  const bool partly = complete && known > 0 && left > 0;
  record.add(quantities::stability, !complete ? "interrupted" : partly ? "partly_known" : along.status);
  record.add(quantities::points_stability_not_known, left);
  if (partly) record.add(quantities::stability_not_known, along.status);
  Table parts = unstable_parts(sweep);
  if (!parts.empty()) record.add(quantities::unstable_parts, std::move(parts));
}

/// "frequency_to", or "amplitude_to" of a branch that left the interval of an amplitude sweep there.
std::string end_of_branch(const solvers::Branch& branch, const SweepAxis& axis) {
  const std::string end(to_string(branch.end));
  const bool left = branch.end == solvers::BranchEnd::from_end || branch.end == solvers::BranchEnd::to_end;
  return left ? axis.quantity + end.substr(end.find('_')) : end;
}

/// Where a branch began and how it ended.
std::vector<Cell> branch_row(const Sweep& sweep, std::size_t index) {
  const solvers::Branch& branch = sweep.branches[index];
  const solvers::CurveStability& parent = sweep.balances_of(std::size_t(branch.parent));
  const solvers::SpecialPoint& origin = parent.special_points[std::size_t(branch.special_point)];
  const std::vector<solvers::SweepPoint>& points = branch.curve.points;
  const auto place = [&](const auto& point) { return parameter_of(point, sweep.curve.parameter); };
  return row_of(index + 1, branch.parent, to_string(origin.type), place(origin),
                branch.periods * sweep.periods, least_of(points, place), largest_of(points, place),
                largest_of(points, &solvers::SweepPoint::max_displacement), points.size(),
                end_of_branch(branch, sweep_axis(sweep)), points.empty() ? missing : place(points.back()),
                branch.stability.points.empty() ? "none" : to_string(branch.stability.status()));
}

bool ended_well(const solvers::Branch& branch) {
  using solvers::BranchEnd;
  return branch.end == BranchEnd::special_point || branch.end == BranchEnd::parent_curve ||
         branch.end == BranchEnd::from_end || branch.end == BranchEnd::to_end ||
         branch.end == BranchEnd::closed;
}

/// Where an isola lies and how it ended.
std::vector<Cell> isola_row(const Sweep& isola, std::size_t number) {
  const std::vector<solvers::SweepPoint>& points = isola.curve.points;
  const StabilityAlong stability = isola.stability_of(0);
  double unstable = missing;
  for (const auto& point : stability.points)
    if (point.unstable >= 0) unstable = (std::isnan(unstable) ? 0.0 : unstable) + (point.unstable > 0);
  const char* from = isola.origin.start == 0 ? "rest" : isola.origin.start < 0 ? "resonance" : "random";
  return row_of(number, isola.origin.frequency, from, least_of(points, &solvers::SweepPoint::frequency),
                largest_of(points, &solvers::SweepPoint::frequency),
                largest_of(points, &solvers::SweepPoint::max_displacement),
                largest_of(points, &solvers::SweepPoint::max_force), points.size(), unstable, isola.status(),
                stability.points.empty() ? "none" : stability.status);
}

void warn_of_isola(Record& record, const Sweep& isola, std::size_t number) {
  warn_of_quasi_periodic_motions(record, isola.stability.special_points, isola);
  if (isola.origin.meets_known)
    warn(record,
         "Isola {}, found at {}, ends on a known branch: a step was too long, and it is a "
         "missed loop of that branch or crosses it. A smaller analysis.largest_step decides it.",
         number, quantity(isola.origin.frequency, "Hz", 6));
  if (!isola.converged()) warn(record, "Isola {} was not followed to an end: {}.", number, isola.status());
}

void append_isolas_found(Record& record, const Sweep& sweep) {
  Table table({"isola", "found_at_Hz", "found_from", "lowest_frequency_Hz", "highest_frequency_Hz",
               "max_displacement_m", "max_contact_force_N", "points", "points_unstable", "status",
               "stability"});
  std::vector<Summary> special;
  const ExactAlongSweep none, *without = sweep.exact.empty() ? nullptr : &none;
  for (std::size_t i = 0; i < sweep.isolas.size(); ++i) {
    const Sweep& isola = sweep.isolas[i];
    table.append_row(isola_row(isola, i + 1));
    warn_of_isola(record, isola, i + 1);
    append_special_points(special, {{"isola", i + 1}}, isola, isola.stability,
                          without != nullptr && isola.exact_of(0) != nullptr ? isola.exact_of(0) : without);
  }
  record.add(quantities::isolas, table);
  record.add("special_points_of_isolas", table_of(special));
}

/// Without the digits that an error leaves open.
double known_digits(double value, double error) {
  if (!(error > 0.0)) return value;
  const double decimals = std::pow(10.0, -std::floor(std::log10(error)));
  return std::round(value * decimals) / decimals;
}

}  // namespace

void append_stability(Record& record, const ResponseStability& stability, std::string_view motion) {
  record.add(quantities::stability, stability.status);
  record.add(quantities::unstable_multipliers, stability.unstable >= 0
                                                   ? SummaryValue(std::int64_t{stability.unstable})
                                                   : SummaryValue(missing));
  const double error = stability.leading_error;
  record.add(quantities::leading_multiplier_real, known_digits(stability.leading.real(), error));
  record.add(quantities::leading_multiplier_imag, known_digits(stability.leading.imag(), error));
  if (error != 0.0) record.add(quantities::leading_multiplier_error, error);
  if (stability.unstable <= 0) return;
  constexpr double real = 1e-6;  // of the modulus
  const bool pair = stability.unstable == 2 && stability.leading.imag() > real * std::abs(stability.leading);
  const double rotation = std::arg(stability.leading) / (2.0 * std::numbers::pi);
  warn(record, "The {} is unstable, with {} Floquet multiplier{} outside the unit circle{}.", motion,
       stability.unstable, stability.unstable == 1 ? "" : "s",
       pair ? fmt::format(
                  ", a complex pair as after a Neimark-Sacker point: perturbations grow and rotate at {} "
                  "times its frequency, and the motion that occurs is often quasi-periodic",
                  short_number(rotation, 4))
            : "");
}

void append_stability(Record& record, const Scene& scene, const Sweep& sweep) {
  const bool complete =
      !sweep.stability.cancelled && sweep.stability.points.size() == sweep.curve.points.size();
  // Curves with impacts turn at grazings, too, and exactly.
  const bool folds_alone = sweep.impacts.empty() && folds_are_known(sweep.stability);
  append_turning_points(record, sweep, complete && folds_alone && scene.analysis.special_points);
  if (sweep.stability.points.empty() && record.interrupted && scene.analysis.stability)
    record.add(quantities::stability, "interrupted");
  if (sweep.stability.points.empty()) return;
  append_status_along(record, sweep, complete);
  warn_where_all_are_unstable(record, sweep.stability_of(0).points);
  if (!scene.analysis.special_points) return;
  record.add(quantities::special_points, table_of(sweep));
  append_structure_points(record, sweep);
  if (!sweep.unexplained.empty())
    warn(record,
         "Before {} {} the number of unstable multipliers changes without a listed "
         "bifurcation point: one is missing.",
         short_numbers(sweep.unexplained, 6), sweep_axis(sweep).unit);
  warn_of_quasi_periodic_motions(record, sweep.stability.special_points, sweep);
}

void append_branches(Record& record, const Sweep& sweep) {
  const std::string place = sweep_axis(sweep).column();
  Table table({"branch", "parent", "type", place, "period", "lowest_" + place, "highest_" + place,
               "max_displacement_m", "points", "end", "end_" + place, "stability"});
  for (std::size_t i = 0; i < sweep.branches.size(); ++i) {
    table.append_row(branch_row(sweep, i));
    warn_of_quasi_periodic_motions(record, sweep.branches[i].stability.special_points, sweep);
    if (ended_well(sweep.branches[i])) continue;
    warn(record, "Branch {} was not followed to an end: {}.", i + 1, to_string(sweep.branches[i].end));
  }
  record.add("branches", table);
  std::vector<Summary> special;
  for (std::size_t i = 0; i < sweep.branches.size(); ++i)
    append_special_points(special, {{"branch", i + 1}}, sweep, sweep.branches[i].stability,
                          sweep.exact_of(i + 1));
  record.add("special_points_of_branches", table_of(special));
}

void append_isolas(Record& record, const Scene& scene, const Sweep& sweep) {
  if (scene.contact.law == no_law || sweep.curve.points.empty()) return;
  const IsolaSearch& search = sweep.isola_search;
  const bool sought = !search.frequencies.empty();
  record.add(quantities::other_motions, sought ? "sought" : "not_sought");
  if (!sought) return;
  record.add(quantities::isola_frequencies, search.frequencies.size());
  record.add(quantities::isola_starts, search.starts);
  record.add(quantities::isola_seconds, search.wall_seconds);
  append_isolas_found(record, sweep);
  if (!search.unmatched.empty())
    warn(record,
         "At {} Hz time integration converges to a motion of the forcing period near which no "
         "discretised response was found. More functions may lead to one.",
         short_numbers(search.unmatched, 6));
}

}  // namespace wavebalance::app

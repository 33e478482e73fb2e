#include "results/motions_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "drawing/motions_figure.hpp"
#include "files/missing.hpp"
#include "results/impacts_record.hpp"
#include "results/motion_files.hpp"
#include "results/quantities.hpp"
#include "results/summary_parts.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/motions.hpp"
#include "wavebalance/app/results/tables.hpp"

namespace wavebalance::app {
namespace {

std::string name_of_motion(std::size_t number) { return fmt::format("motion_{}", number); }

/// Missing of a motion with impacts alone, which pass on impulses.
double largest_force(const Scene& scene, const FoundMotion& one) {
  const bool impulses = solves_by_impacts(scene) && one.found.motion.phases.empty();
  return impulses ? missing : one.contacts.force.maxCoeff();
}

/// The largest displacement, at samples and at impacts, which lie between them.
double largest_displacement(const FoundMotion& one) {
  return std::max(one.contacts.displacement.maxCoeff(), highest_at_impacts(one.found.motion));
}

Table motions_table(const Scene& scene, const Motions& all) {
  Table table({"file", "number", "period", "stability", "unstable_multipliers", "leading_multiplier_real",
               "leading_multiplier_imag", "max_displacement_m", "max_contact_force_N", "share", "share_error",
               "found_by"});
  for (std::size_t i = 0; i < all.motions.size(); ++i) {
    const FoundMotion& one = all.motions[i];
    const solvers::MotionStability& stability = one.found.stability;
    table.append_row({name_of_motion(i + 1) + ".csv", std::int64_t(i + 1), std::int64_t{one.found.periods},
                      stability.status, stability.unstable < 0 ? missing : double(stability.unstable),
                      stability.leading.real(), stability.leading.imag(), largest_displacement(one),
                      largest_force(scene, one), one.found.share, one.found.share_error,
                      std::string(to_string(one.found.found_by))});
  }
  return table;
}

std::string words_of(const FoundMotion& motion, std::size_t number) {
  const std::string periods =
      motion.found.periods == 1 ? "" : fmt::format(" over {} periods of the load", motion.found.periods);
  return fmt::format("motion {}{}, {}", number, periods, motion.found.stability.status);
}

void append_files(Record& record, const Scene& scene, const StructureModel& model, const FoundMotion& motion,
                  std::size_t number) {
  const std::string name = name_of_motion(number), about = words_of(motion, number);
  const bool several = motion.contacts.rows() > 1;
  record.files.push_back({name + ".csv", csv_text(response_table(motion.contacts.contact(motion.contact))),
                          about + (several ? ": the leading contact" : "")});
  if (several)
    record.files.push_back({name + "_contacts.csv", csv_text(contacts_table(scene, motion.contacts)),
                            about + ": every contact"});
  if (solves_by_impacts(scene) || !motion.found.motion.impacts.empty())
    record.files.push_back({name + "_impacts.csv",
                            csv_text(impacts_table(scene, motion.found.motion.impacts)),
                            about + ": its impacts"});
  for (RecordFile& file : motion_files(model, motion.structure, name)) {
    file.about = about + ": the whole structure";
    record.files.push_back(std::move(file));
  }
}

void warn_of_none(Record& record, const Motions& all, int longest) {
  if (all.none == 0) return;
  std::vector<std::string> ends;
  for (const auto& [status, count] : all.none_by_status) ends.push_back(fmt::format("{} {}", count, status));
  record.warnings.push_back(fmt::format(
      "{} of {} random starts came to no motion of up to {} periods within the periods integrated{}: "
      "motions may be missing.",
      all.none, all.starts, longest, ends.empty() ? "" : fmt::format(" ({})", fmt::join(ends, ", "))));
}

/// Motions that are known by integration alone.
void append_unsolved(Record& record, const Motions& all) {
  if (all.unsolved.empty()) return;
  Table table({"phases_status", "period", "max_displacement_m", "max_contact_force_N", "share"});
  for (const solvers::UnsolvedMotion& one : all.unsolved) {
    const std::string status(to_string(one.status));
    const double share = all.starts > 0 ? double(one.arrivals) / all.starts : missing;
    table.append_row({status, std::int64_t{one.periods}, one.max_displacement, one.max_force, share});
    record.warnings.push_back(fmt::format(
        "The structure settles to a motion over {} period{} of the load with a largest displacement of {:.6g} m, by "
        "integration, which contact phases did not solve for ({}).",
        one.periods, one.periods == 1 ? "" : "s", one.max_displacement, status));
  }
  record.summary.emplace_back(quantities::unsolved_motions, table);
}

/// The box of the random states, by mode.
void append_box(Record& record, const Motions& all) {
  if (all.box.empty()) return;
  Table table({"mode", "largest_displacement_m", "largest_velocity_m_per_s"});
  for (std::size_t i = 0; i < all.box.size(); ++i)
    table.append_row({std::int64_t(i + 1), all.box[i].displacement, all.box[i].velocity});
  record.summary.emplace_back(quantities::start_box, table);
}

/// The largest of a number of all motions; missing without any.
template <class Number>
double largest(const Motions& all, const Number& number) {
  double value = missing;
  for (const FoundMotion& one : all.motions) value = std::fmax(value, double(number(one)));
  return value;
}

}  // namespace

Record motions_record(const Scene& scene, const StructureModel& model, const Observer& observer) {
  const Motions all = coexisting_motions(scene, model, observer);
  int iterations = 0, unknowns = 0;
  for (const FoundMotion& one : all.motions) {
    iterations += one.found.motion.iterations;
    unknowns = std::max(unknowns, one.found.motion.unknowns);
  }
  Record record;
  record.warnings = model.warnings;
  record.converged = all.status == "converged";
  record.interrupted = all.status == "cancelled";
  record.status = record.interrupted ? "interrupted" : all.status;
  record.summary =
      solution_entries(record.converged, record.status,
                       largest(all, [](const FoundMotion& one) { return one.found.motion.residual; }),
                       iterations, unknowns, all.wall_seconds);
  record.summary.emplace_back(quantities::max_displacement, largest(all, largest_displacement));
  record.summary.emplace_back(quantities::min_displacement, -largest(all, [](const FoundMotion& one) {
                                return -one.contacts.displacement.minCoeff();
                              }));
  record.summary.emplace_back(quantities::max_contact_force, largest(all, [&](const FoundMotion& one) {
                                return largest_force(scene, one);
                              }));
  record.summary.emplace_back(quantities::analysis, name_of(scene.analysis.type));
  record.summary.emplace_back(quantities::frequency, scene.forcing.frequency);
  const bool impacts = solves_by_impacts(scene);
  record.summary.emplace_back(quantities::solved_by, impacts ? "impacts" : name_of(TimeMethod::exact));
  record.summary.emplace_back(quantities::random_starts, std::int64_t{all.starts});
  record.summary.emplace_back(quantities::starts_without_motion, std::int64_t{all.none});
  warn_of_scene(record, scene);
  warn_of_none(record, all, scene.analysis.longest_period);
  record.summary.emplace_back(quantities::motions, motions_table(scene, all));
  append_unsolved(record, all);
  append_box(record, all);
  record.summary.emplace_back(quantities::warnings, record.warnings);
  // read_start_motion() takes these, since tables are not read.
  for (std::size_t i = 0; i < all.motions.size(); ++i)
    if (all.motions[i].found.periods > 1)
      record.summary.emplace_back(name_of_motion(i + 1) + "_period",
                                  std::int64_t{all.motions[i].found.periods});
  append_structure(record.summary, scene, model);
  record.figure = motions_figure(scene, all);
  for (std::size_t i = 0; i < all.motions.size(); ++i)
    append_files(record, scene, model, all.motions[i], i + 1);
  return record;
}

}  // namespace wavebalance::app

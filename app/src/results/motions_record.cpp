#include "results/analyses.hpp"

#include "drawing/figures.hpp"
#include "files/missing.hpp"
#include "files/number_text.hpp"
#include "results/quantities.hpp"
#include "results/record_parts.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/motions.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {
namespace {

std::string name_of_motion(std::size_t number) { return fmt::format("motion_{}", number); }

/// Missing with impacts only, which have impulses.
double largest_force(const Scene& scene, const FoundMotion& one) {
  const bool impulses = solves_by_impacts(scene) && one.found.motion.intervals.empty();
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
    table.append_row(row_of(name_of_motion(i + 1) + ".csv", i + 1, one.found.periods, stability.status,
                            stability.unstable < 0 ? missing : double(stability.unstable),
                            stability.leading.real(), stability.leading.imag(), largest_displacement(one),
                            largest_force(scene, one), one.found.share, one.found.share_error,
                            to_string(one.found.found_by)));
  }
  return table;
}

std::string words_of(const FoundMotion& motion, std::size_t number) {
  const std::string periods =
      motion.found.periods == 1 ? "" : fmt::format(" over {} periods of the load", motion.found.periods);
  return fmt::format("motion {}{}, {}", number, periods, motion.found.stability.status);
}

WrittenMotion written(const Scene& scene, const FoundMotion& motion) {
  const std::vector<solvers::Impact>& impacts = motion.found.motion.impacts;
  const bool strikes = solves_by_impacts(scene) || !impacts.empty();
  return {motion.contacts, motion.contact, motion.structure,
          strikes ? impacts_table(scene, impacts) : Table()};
}

void warn_of_none(Record& record, const Motions& all, int longest) {
  if (all.none == 0) return;
  std::vector<std::string> ends;
  for (const auto& [status, count] : all.none_by_status) ends.push_back(fmt::format("{} {}", count, status));
  warn(record,
       "{} of {} random starts did not converge to a motion of up to {} periods within the "
       "integrated periods{}: motions may be missing.",
       all.none, all.starts, longest, ends.empty() ? "" : fmt::format(" ({})", fmt::join(ends, ", ")));
}

/// Motions that are known only from integration.
void append_unsolved(Record& record, const Motions& all) {
  if (all.unsolved.empty()) return;
  Table table({"phases_status", "period", "max_displacement_m", "max_contact_force_N", "share"});
  for (const solvers::UnsolvedMotion& one : all.unsolved) {
    const std::string status(to_string(one.status));
    const double share = all.starts > 0 ? double(one.arrivals) / all.starts : missing;
    table.append_row({status, std::int64_t{one.periods}, one.max_displacement, one.max_force, share});
    warn(record,
         "Time integration converges to a motion of {} forcing period{} with a largest "
         "displacement of {}. No exact solution was found for it ({}).",
         one.periods, one.periods == 1 ? "" : "s", quantity(one.max_displacement, "m"), status);
  }
  record.add("unsolved_motions", table);
}

/// The box of the random states, by mode.
void append_box(Record& record, const Motions& all) {
  if (all.box.empty()) return;
  Table table({"mode", "largest_displacement_m", "largest_velocity_m_per_s"});
  for (std::size_t i = 0; i < all.box.size(); ++i)
    table.append_row({std::int64_t(i + 1), all.box[i].displacement, all.box[i].velocity});
  record.add("start_box", table);
}

}  // namespace

std::string motions_plan(const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  return fmt::format(
      "motions    of up to {} forcing periods, from rest and {} random states (seed {}), by {}\n",
      analysis.longest_period, analysis.random_starts, analysis.seed,
      solves_by_impacts(scene) ? "exact solutions with impacts"
      : seeks_by_events(scene)
          ? "event-driven integration over a period"
          : "exact solutions to a relative error of " + short_number(scene.time.tolerance));
}

Record motions_record(const Scene& scene, const StructureModel& model, const AnalysisOptions& how) {
  const Motions all = coexisting_motions(scene, model, how.observer);
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
  begin_summary(record,
                largest_of(all.motions, [](const FoundMotion& one) { return one.found.motion.residual; }),
                iterations, unknowns, all.wall_seconds);
  record.add(quantities::max_displacement, largest_of(all.motions, largest_displacement));
  record.add(quantities::min_displacement, least_of(all.motions, [](const FoundMotion& one) {
               return one.contacts.displacement.minCoeff();
             }));
  record.add(quantities::max_contact_force,
             largest_of(all.motions, [&](const FoundMotion& one) { return largest_force(scene, one); }));
  record.add(quantities::analysis, name_of(scene.analysis.type));
  record.add(quantities::frequency, scene.forcing.frequency);
  const bool impacts = solves_by_impacts(scene);
  record.add(quantities::solved_by, impacts ? "impacts" : name_of(TimeMethod::exact));
  record.add(quantities::random_starts, all.starts);
  record.add("starts_without_motion", all.none);
  warn_of_scene(record, scene);
  warn_of_none(record, all, scene.analysis.longest_period);
  record.add(quantities::motions, motions_table(scene, all));
  append_unsolved(record, all);
  append_box(record, all);
  record.add(quantities::warnings, record.warnings);
  // read_start_motion() uses these, because tables are not read.
  for (std::size_t i = 0; i < all.motions.size(); ++i)
    if (all.motions[i].found.periods > 1)
      record.summary.emplace_back(name_of_motion(i + 1) + "_period",
                                  std::int64_t{all.motions[i].found.periods});
  append_structure(record.summary, scene, model);
  record.figure = motions_figure(scene, all);
  for (std::size_t i = 0; i < all.motions.size(); ++i)
    append_motion_files(record, scene, model, written(scene, all.motions[i]), name_of_motion(i + 1),
                        words_of(all.motions[i], i + 1));
  return record;
}

}  // namespace wavebalance::app

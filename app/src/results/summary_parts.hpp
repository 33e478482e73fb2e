#pragma once
#include <fmt/format.h>

#include <string>
#include <utility>

#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// Adds a sentence to the warnings of the record.
template <class... Values>
void warn(Record& record, fmt::format_string<Values...> text, Values&&... values) {
  record.warnings.push_back(fmt::format(text, std::forward<Values>(values)...));
}

/// The first entries of every summary.
Summary solution_entries(bool converged, const std::string& status, double residual, int iterations,
                         int unknowns, double solve_seconds);
/// Puts the total time before the time of the solution.
void insert_wall_seconds(Summary& summary, double seconds);

/// Pair of bases, its formulation and its sizes.
void append_discretisation(Summary& summary, const Time& time);

/// Sizes of the structure before and after its reduction.
void append_structure(Summary& summary, const Scene& scene, const StructureModel& model);

/// Adds condition_estimate and rounding_error_estimate (NaN: none) to the summary, and `warnings` to summary
/// and record. There is a warning for a condition above 1e12, where fewer than four of the sixteen digits of
/// a double are accurate, and for a rounding error above 1e-6.
void append_condition(Record& record, double condition, double rounding_error);

/// The table of all contacts, and which of them the record shows, where there are several.
void add_contacts(Record& record, const Scene& scene, const solvers::Motion& contacts, int leading);

/// Which motion a search for several forcing periods found.
void append_period(Record& record, int periods, int motion_periods);

/// Sentences about loads and gaps that were probably meant otherwise: no load at all, and a gap below zero
/// with obstacles on both sides.
void warn_of_scene(Record& record, const Scene& scene);
/// The same about contacts of which none closes, by how far (m) the one that comes nearest to its gap (m)
/// stays from it; NaN where contacts differ.
void warn_of_open_contacts(Record& record, double distance, double gap, const std::string& unit);

/// Why a structure that is free to move has no periodic motion, and along what it moves. A response that
/// failed for another reason gives no information on its load.
void warn_of_unbalanced_load(Record& record, const StructureModel& model);

/// Where the solution started, and what to do if that led nowhere.
void append_start(Record& record, const StartMotion& start, bool found, double distance);
/// All warnings of the record in its summary, also those that came after the summary's own.
void set_warnings(Record& record);

/// The fields of the motion of the direction of contact `leading`; missing values of an empty motion.
void append_motion(Summary& summary, const Scene& scene, const solvers::Motion& contacts, int leading);

/// The phases of contact of a motion; of contacts with friction all parts of the period, by what they do in
/// them.
Table phases_table(const Scene& scene, const solvers::ExactSolution& motion);

}  // namespace wavebalance::app

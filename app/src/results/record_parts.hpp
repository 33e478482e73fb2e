#pragma once
#include <fmt/format.h>

#include "drawing/figures.hpp"
#include "files/missing.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/attractors/recorded_motion.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/outputs/mode_outputs.hpp"
#include "wavebalance/app/outputs/output_measures.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

/// The name of a state of a contact, of any of the enums that have some of them.
template <class State>
std::string state_name(State state) {
  if (state == State::open) return "open";
  if (state == State::stick) return "stick";
  return state == State::slip ? "slip" : "closed";
}

/// Results of contacts with friction. The summary has work, fractions of the period, slip, wear, and the
/// difference of the friction work from the work of the load (frequency, Hz) less damping. friction.csv has
/// the loops of force and displacement and the state at every instant.
void append_friction(Record& record, const Scene& scene, const Response& response, double frequency);

/// The damping ratio of an oscillator with the same largest kinetic energy that dissipates per cycle as
/// much as the friction per forcing period: work / (4 pi energy), relative to a moving base. Missing
/// without Response::structure and its velocities. Nothing without friction. O(entries of the mass,
/// instants).
void append_equivalent_damping(Record& record, const Scene& scene, const StructureModel& model,
                               const Response& response);

/// impact, time_fraction, contact, velocity_before_m_per_s, velocity_after_m_per_s, impulse_Ns,
/// energy_lost_J: a row for each impact of the motion's period, by time; contacts are counted from 1.
Table impacts_table(const Scene& scene, const std::vector<solvers::Impact>& impacts);

/// Results of impacts: their number, the largest impulse, the energy dissipated per forcing period,
/// impacts.csv, and without a solution the reason.
void append_impacts(Record& record, const Scene& scene, const Response& response);

/// The files and pictures of the motions of a sweep, their table `motions` in the summary, their instants of
/// contact where these are known, and a warning for each place
/// without one and each motion that was not solved for.
void append_motions(Record& record, const Scene& scene, const StructureModel& model, const Sweep& sweep,
                    const std::vector<CurveMotion>& motions);

/// The largest of a number of all rows, which a member or a function gives; missing without any.
template <class Rows, class Number>
double largest_of(const Rows& rows, const Number& number) {
  double value = missing;
  for (const auto& row : rows) value = std::fmax(value, std::invoke(number, row));
  return value;
}

/// The least likewise.
template <class Rows, class Number>
double least_of(const Rows& rows, const Number& number) {
  double value = missing;
  for (const auto& row : rows) value = std::fmin(value, std::invoke(number, row));
  return value;
}

/// Adds the columns of the outputs to the record's backbone, which is complete but for its stability, and
/// what is known of each along the mode to its summary. Returns the outputs as pictures draw them.
std::vector<ModeOutput> append_outputs(Record& record, const Scene& scene, const ModeOutputs& outputs);

/// The first output; null if contacts are the only outputs.
const ModeOutput* leading_of(const std::vector<ModeOutput>& outputs, const Scene& scene);

/// Adds the picture of the outputs along a mode; none without any, and none of a single one that leads, which
/// the record's own figure draws.
void draw_outputs(Record& record, const Scene& scene, const std::vector<ModeOutput>& outputs,
                  const solvers::BackboneStability& stability = {});

/// The motion of the whole structure from the reduced one (r x frames, uniform over the period): with a
/// mesh a series for ParaView, whose times are fractions of the period, with displacement and stress;
/// without one motion.mtx, a Matrix Market array of a column an instant. Nothing for no frames. `name`
/// replaces "motion" in the names of the files.
std::vector<RecordFile> motion_files(const StructureModel& model, const Eigen::MatrixXd& coordinates,
                                     const std::string& name = "motion");

/// One of several motions of a record.
struct WrittenMotion {
  const solvers::Motion& contacts;
  int contact;                       ///< the leading one
  const Eigen::MatrixXd& structure;  ///< coordinates of motion_files()
  Table impacts = {};                ///< impacts_table(); without columns: none
};

/// Its files: NAME.csv of the contact with the largest force, NAME_contacts.csv of all if there are
/// several, NAME_impacts.csv, and files of the structure. `about` describes the motion.
void append_motion_files(Record& record, const Scene& scene, const StructureModel& model,
                         const WrittenMotion& motion, const std::string& name, const std::string& about);

/// Whether the motion of the whole structure is needed for the orbit in the plane of an unbalance.
bool has_unbalance_orbit(const Scene& scene);

/// Adds orbits.csv and a picture of y over x: in the plane of the first unbalance that has two rows, and of
/// each contact in a ring. Without effect on scenes that have neither, and on motions that are not known
/// there.
void append_orbits(Record& record, const Scene& scene, const StructureModel& model, const Response& response);
/// The same of the motions of points of a curve.
void append_orbits(Record& record, const Scene& scene, const std::vector<CurveMotion>& motions);

/// The table with the columns of all outputs. Rows have the values of their points, null or empty if not
/// measured.
Table with_outputs(const Table& table, const std::vector<Output>& outputs,
                   const std::vector<const MeasuredPoint*>& points, int harmonics);

/// Puts the output that leads and what is known of each of analysis.outputs right behind how the run ended.
void insert_outputs(Summary& summary, const Scene& scene, const std::vector<Output>& outputs,
                    Summary entries);

/// Adds the columns of the outputs to the record's sweep table, which is complete, their peaks to its
/// summary, and their picture.
void append_outputs(Record& record, const Scene& scene, const Sweep& sweep, const SweepOutputs& outputs);

/// Adds the motion of the scene's outputs over one period to the record, their measures to its summary, and
/// their picture. The response has the structure's motion at all output_points instants. The load is the
/// scene's, or none for a free motion.
void append_outputs(Record& record, const Scene& scene, const StructureModel& model, const Response& response,
                    const LoadAt& load);

/// The same for a motion that does not repeat: the summary gets the statistics of outputs that are
/// displacements. One period does not determine the motion of the structure.
void append_outputs(Record& record, const Scene& scene, const RecordedMotion& motion);

/// Puts the motion of the first output before the contacts in the record's picture.
void lead_with_output(Record& record, const Scene& scene);

/// Gives the record of time stepping that did not repeat the statistics of the recorded periods instead of
/// the values of its last period, with their errors, the Poincare section and the spectrum. The status is
/// `aperiodic` where the motion is known to be so. `contact` is the leading direction of contact.
void append_recorded(Record& record, const RecordedMotion& motion, const Scene& scene, int contact);

/// With the instants at which the motion of the whole structure is computed: as needed for files, outputs,
/// energies with friction, or a bar's report.
ResponseOptions response_options(const Scene& scene, const Observer& observer);

/// The record of one response, whatever it was solved by.
Record response_record(const Scene& scene, const StructureModel& model, const Response& response);

/// Adds the static deflection under static loads to the record's summary; nothing if it is zero.
void append_rest(Record& record, const Scene& scene, const StructureModel& model);

/// How many contacts are closed with these forces, one for each direction of contact: one contact with a
/// normal direction and tangents counts once, by its normal force.
std::int64_t closed_contacts(const Scene& scene, const std::vector<double>& forces);

/// The same in lines of text, for scenes of matrices; empty if it is zero.
std::string rest_lines(const Scene& scene);

/// The fields of the stability of a `motion`, and a warning where it is unstable.
void append_stability(Record& record, const ResponseStability& stability,
                      std::string_view motion = "response");

/// The turning points of a sweep, its stability and its bifurcation and grazing points. Where stability is
/// known the turning points are folds of the motion; folds that only the samples have are reported
/// separately, with a warning.
void append_stability(Record& record, const Scene& scene, const Sweep& sweep);

/// The table `branches`, and a warning about each that was not followed to an end.
void append_branches(Record& record, const Sweep& sweep);
/// Whether isolated branches were searched for, and the table `isolas` of those found, with a warning about
/// each incomplete one.
void append_isolas(Record& record, const Scene& scene, const Sweep& sweep);

/// The table of the bifurcation points of a balance with two columns more: the frequency or amplitude of the
/// structure's next to each, NaN where there is none, and solvers::StructurePointStatus.
Table with_structure_points(std::vector<Summary> special_points, const Sweep& sweep);

/// The folds of the structure in the order of its curve, where this was followed as a whole.
std::optional<std::vector<double>> structure_folds(const Sweep& sweep);

/// The table of the exact bifurcation points along a sweep, and warnings where the balance has others and
/// where it misses part of the structure's curve. Nothing if not requested.
void append_structure_points(Record& record, const Sweep& sweep);

/// The parts of a sweep, its branches and its isolas whose motions are unstable, in their order: `branch` (0
/// of the main curve), where each begins and ends, and with isolas `isola` (0 of the sweep). That is the
/// fold, period doubling or other point at which the multipliers pass the unit circle, of the structure where
/// its whole curve is known; a part without one begins or ends at its own first or last point.
Table unstable_parts(const Sweep& sweep);

/// Adds a sentence to the warnings of the record.
template <class... Values>
void warn(Record& record, fmt::format_string<Values...> text, Values&&... values) {
  record.warnings.push_back(fmt::format(text, std::forward<Values>(values)...));
}

/// The first entries of every summary, of a record whose status is known.
void begin_summary(Record& record, double residual, int iterations, int unknowns, double solve_seconds);
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

/// Files and pictures of a free motion with its contacts in `response` and the structure's motion at so
/// many instants; `shown` is the frequency in the title (Hz).
void append_free_motion(Record& record, const Scene& scene, const StructureModel& model, Response& response,
                        double frequency, double shown, const std::function<solvers::Motion(int)>& structure);

/// The fields of the motion of the direction of contact `leading`; missing values of an empty motion.
void append_motion(Summary& summary, const Scene& scene, const solvers::Motion& contacts, int leading);

/// The contact intervals of a motion; of contacts with friction all parts of the period, by what they do in
/// them.
Table intervals_table(const Scene& scene, const solvers::ExactSolution& motion);

/// The record of a curve over frequency or amplitude, with what was measured of its outputs and the motions
/// of analysis.motion_at.
Record sweep_record(const Scene& scene, const StructureModel& model, const Sweep& sweep,
                    const SweepOutputs& outputs, const std::vector<CurveMotion>& motions);

/// Leaves the share of the period out at all points where a spring acts everywhere: it is never open, so
/// that the fraction is 1.
void leave_out_contact_fractions(const Scene& scene, Sweep& sweep);

/// The errors of a point and the status of its exact solution.
void append_exact(Summary& row, const ExactAlongSweep::Point& point);

/// How well the points of a curve resolve the highest of them.
struct PeakResolution {
  double value = 0.0;  ///< by how much the parabola through it and its neighbours is higher, over its height
  double place = 0.0;  ///< how far from it the parabola is highest, in the unit of `places`
};

/// At the point `index` of a curve; zeros at the ends of the curve.
PeakResolution peak_resolution(std::span<const double> places, std::span<const double> values,
                               std::size_t index);

/// Adds the critical speeds of a structure that turns to the summary, and its Campbell diagram from rest to
/// the end of the sweep as campbell.csv and a picture. Without effect on other structures and analyses.
void append_whirls(Record& record, const Scene& scene, const StructureModel& model);

/// The lines of describe_scene() on the whirls at the speed of the scene, or at both ends of its sweep, and
/// on critical speeds; empty for other structures.
std::string whirl_lines(const Scene& scene);

}  // namespace wavebalance::app

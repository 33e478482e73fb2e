#pragma once
#include <Eigen/Core>

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/analysis/start_motion.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/branches/branches.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"
#include "wavebalance/solvers/collocation/exact_near_response.hpp"
#include "wavebalance/solvers/problem/exact_along.hpp"
#include "wavebalance/solvers/problem/structure_points.hpp"
#include "wavebalance/solvers/response/curve_peak.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"

namespace wavebalance::app {

/// Whether exact bifurcation points are computed along a curve of a scene. With many contacts they can take
/// a hundred times as long as the curve, and require analysis.phases.
bool seeks_exact_points(const Scene& scene);

/// How many bifurcation points of a curve have exact solutions unless analysis.phases requests all points.
inline constexpr std::size_t most_special_points_with_exact = 24;

/// The exact periodic solutions near a curve. Empty if not requested.
struct ExactAlongSweep {
  using Point = std::optional<solvers::ExactAtPoint>;

  Point peak;                         ///< of the main curve, with its motion
  std::vector<Point> special_points;  ///< one for each of CurveStability::special_points
  std::vector<Point> points;          ///< one for each point of the curve with analysis.phases; else none
};

/// "converged", "converged_beside" if found only a few points along the curve away, another
/// solvers::ExactStatus, or "not_computed".
std::string exact_status(const ExactAlongSweep::Point& point);
/// Whether the search found none nearby.
bool was_not_found(const ExactAlongSweep::Point& point);

/// The stability along a curve in its record.
struct StabilityAlong {
  std::vector<solvers::PointStability> points;
  /// Per point: "phases" if the count belongs to the exact motion, "balance", or "none" if no exact motion
  /// was found nearby and the stability is not known. Empty without ExactAlongSweep::points.
  std::vector<std::string> by;
  std::string status = "converged";  ///< or why the first count that is not known is not
};

/// A harmonic balance curve with the counts of the exact motions where these are known; null: without any.
StabilityAlong stability_along(const solvers::CurveStability& balance, const ExactAlongSweep* exact);

/// The index of the point with the largest displacement, of a curve with points.
std::size_t peak_of(const solvers::FrequencySweep& curve);
/// The index of the point that vibrates most.
std::size_t vibration_peak_of(const solvers::FrequencySweep& curve);

/// The relative error of the vibration, half the peak-to-peak value, at the peak of a curve against the
/// motion of the structure near it; NaN where that is not known there.
double error_of_vibration(const solvers::FrequencySweep& curve, const ExactAlongSweep::Point& peak,
                          int output_points);

/// The impacts of a point of a curve.
struct PointImpacts {
  int count = 0;                 ///< in the period of the motion
  double largest_impulse = 0.0;  ///< N s
  double largest_speed = 0.0;    ///< m/s, before an impact
  double energy_lost = 0.0;      ///< J in a period of the load
  std::vector<double> speeds =
      {};  ///< m/s, the largest of each direction of contact up to the last that is struck
};

/// Parameter of a sweep in words, columns and units.
struct SweepAxis {
  std::string quantity = "frequency";  ///< or "amplitude"
  std::string unit = "Hz";             ///< or "N", "m" or "m/s^2"
  std::string suffix = "Hz";           ///< the unit at the end of a column's name

  std::string column() const { return quantity + "_" + suffix; }
  std::string label() const;  ///< "Frequency (Hz)"
};

/// How isolated branches were searched for.
struct IsolaSearch {
  std::vector<double> frequencies = {};  ///< Hz; empty if not requested
  std::vector<double> unmatched = {};    ///< Hz, solvers::IsolatedCurves::unmatched
  int starts = 0;                        ///< at each: rest and random states
  bool cancelled = false;                ///< the observer stopped it
  double wall_seconds = 0.0;             ///< with the curves found, without their stability
};

/// Where an isolated branch was found.
struct IsolaOrigin {
  double frequency = std::numeric_limits<double>::quiet_NaN();  ///< Hz; NaN of a curve that is no isola
  int start = 0;                                                ///< solvers::IsolatedCurve::start
  bool meets_known = false;
};

/// A curve of responses over the frequency or the amplitude. Frequencies are forcing frequencies, also on
/// branches. Load scales of an amplitude sweep are amplitudes.
struct Sweep {
  solvers::FrequencySweep curve;
  solvers::CurveStability stability;        ///< set by add_stability(); without points otherwise
  std::vector<solvers::Branch> branches;    ///< set by add_stability() with analysis.branches
  std::vector<ExactAlongSweep> exact = {};  ///< set by add_exact(): of the curve, then of each branch
  /// With impacts: per point of the curve, then of each branch.
  std::vector<std::vector<PointImpacts>> impacts = {};
  /// Whether all contacts are impacts; motions then have no forces and no errors.
  bool by_impacts() const { return !impacts.empty() && exact.empty(); }
  /// With friction: per point of the curve, then of each branch.
  std::vector<std::vector<FrictionShares>> friction = {};
  /// The motions of the points of an exact curve, then of each branch.
  std::vector<std::vector<solvers::ExactSolution>> exact_motions = {};
  std::vector<double> unexplained = {};  ///< of an exact curve: ExactCurve::unexplained, values of the points
  std::string start_status = {};         ///< of impacts and exact curves: why there is no first motion
  /// The exact bifurcation points; set by add_exact() with analysis.stability.
  std::optional<solvers::StructurePoints> structure_points = {};
  bool exact_cancelled = false;  ///< the observer stopped add_exact()
  int periods = 1;               ///< of the load, over which its motions are solved for
  double start_distance = std::numeric_limits<double>::quiet_NaN();  ///< Response::start_distance
  int motion_periods =
      1;  ///< forcing periods after which the motion of the first point repeats, solvers::motion_periods()
  double wall_seconds = 0.0;
  std::string amplitude_unit = "N";                ///< of an amplitude sweep
  std::vector<std::string> motions_left_out = {};  ///< those that curve_motions() was stopped before
  std::optional<std::size_t> peak_of_output = {};  ///< of analysis.peak_of, set by measure_outputs()
  /// Where that vibration is largest between the points of the curve, set by measure_outputs() where it was
  /// solved for.
  std::optional<solvers::CurvePeak> solved_peak = {};
  bool outputs_cancelled = false;  ///< the observer stopped measure_outputs()
  /// Isolated branches in the order in which they were found, and their search; set by add_isolas() with
  /// analysis.isolas.
  std::vector<Sweep> isolas;
  IsolaSearch isola_search = {};
  IsolaOrigin origin = {};  ///< of one of the isolas

  /// Whether the curve is complete: it reached the end of the interval, or came back to its first point.
  /// An isola that enters and leaves at the same end of the interval is complete, too.
  bool converged() const {
    const bool returned = curve.status == solvers::SweepStatus::returned && std::isfinite(origin.frequency);
    return (curve.status == solvers::SweepStatus::reached_end || curve.closed_at_start || returned) &&
           curve.rounding_error <= largest_rounding_error && !misses_part();
  }
  /// A step was too long: the curve passes by folds of the structure or has gone over to another curve of it,
  /// or one of the isolas ends on a curve that was known.
  bool misses_part() const;
  /// The observer stopped the curve, which holds the points so far.
  bool interrupted() const { return curve.status == solvers::SweepStatus::cancelled; }
  /// The observer stopped it, its stability, a branch, its exact solutions or its motions.
  bool stopped() const;
  /// The point of the largest vibration of analysis.peak_of, or of the largest displacement. There must be
  /// one.
  std::size_t peak() const;
  /// "reached_end" or "closed", or the reason why not, such as "interrupted" or "missed_part".
  std::string status() const;
  /// The curve, 0, or a branch, from 1, and the stability of its balances.
  const solvers::FrequencySweep& curve_of(std::size_t number) const {
    return number == 0 ? curve : branches[number - 1].curve;
  }
  const solvers::CurveStability& balances_of(std::size_t number) const {
    return number == 0 ? stability : branches[number - 1].stability;
  }
  /// Exact solutions (null if not computed) and stability of the curve, 0, or of a branch, from 1.
  const ExactAlongSweep* exact_of(std::size_t number) const;
  StabilityAlong stability_of(std::size_t number) const;
};

/// The quantity over which a sweep runs, with its unit.
SweepAxis sweep_axis(const Sweep& sweep);
/// Axis of a scene's sweep or diagram; the frequency for other analyses.
SweepAxis sweep_axis(const Scene& scene);

/// The scene's frequency response by arc length. A change of frequency by 1/20 of the interval has the same
/// length as a change by all that vibrates, at most the gap. analysis.first_step and analysis.largest_step
/// are in Hz.
Sweep frequency_sweep(const Scene& scene, const Observer& observer = {});
/// The same for the scene's structure composed before. Its first point is searched for near `start` unless
/// that is empty, as weighted_residual_response() does.
Sweep frequency_sweep(const Scene& scene, const StructureModel& model, const Observer& observer = {},
                      const StartMotion& start = {});

/// The curve of the scene's responses over reference_load() at forcing.frequency. A change of the amplitude
/// by 1/20 of the interval has the same length as a change by all that vibrates, at most the gap.
Sweep amplitude_sweep(const Scene& scene, const Observer& observer = {});
Sweep amplitude_sweep(const Scene& scene, const StructureModel& model, const Observer& observer = {},
                      const StartMotion& start = {});

/// The scene's curve over frequency or amplitude with analysis.exact or with impacts only: exact periodic
/// solutions with their stability and bifurcation and grazing points. Turning points are its folds, and the
/// errors are estimates. Starts as frequency_sweep() does; impacts begin with the attractor, and with
/// analysis.branches have the motions of twice as many periods that begin at period doublings. An impact is
/// an impulse without a finite force, so points with impacts only have no contact force.
Sweep exact_sweep(const Scene& scene, const StructureModel& model, const Observer& observer = {},
                  const StartMotion& start = {});

/// Sets the exact solutions at the peak and the bifurcation points of a sweep of the scene and at the
/// bifurcation and grazing points of its branches, of which `model` is the structure; with analysis.phases
/// at all their points. Then at most most_special_points_with_exact bifurcation and grazing points per
/// curve are used, crossings of the unit circle before grazings. With analysis.stability the bifurcation
/// and grazing points of the structure along the main curve are solved for, as structure_points() does.
/// Without seeks_exact_points() only the peak is solved for. Nothing where neither analysis.stability nor
/// analysis.phases is true or the structure's modes cannot be computed. An observer that stops it leaves
/// those found so far.
void add_exact(const Scene& scene, const StructureModel& model, Sweep& sweep, const Observer& observer = {});

/// Searches for curves that a sweep of the scene with analysis.isolas did not follow, of which `model` is
/// the structure, its branches of one period among them: solvers::isolated_curves(), with the stability and
/// exact solution of each. For an exact curve they are searched for by harmonic balance and then followed
/// exactly. An observer that stops it leaves the curves so far.
void add_isolas(const Scene& scene, const StructureModel& model, Sweep& sweep, const Observer& observer = {});

/// Sets the stability of a sweep of the scene, of which `model` is the structure, unless analysis.stability
/// is false or the structure's modes cannot be computed, and with analysis.branches its branches. An observer
/// that stops it leaves the points so far.
void add_stability(const Scene& scene, const StructureModel& model, Sweep& sweep,
                   const Observer& observer = {});

/// The motion of one point of a sweep.
struct CurveMotion {
  std::string name;    ///< "motion_peak", "motion_fold_1", "motion_150Hz_2": its files without their ending
  std::string at;      ///< "peak", the solvers::SpecialPointType, "frequency" or "amplitude"
  double place = 0.0;  ///< of the load: its frequency (Hz), or its amplitude in an amplitude sweep
  bool converged = true;        ///< of one at a requested place: whether Newton's method solved for it
  double residual = 0.0;        ///< relative
  solvers::Motion contacts;     ///< of all contacts, analysis.output_points points
  int contact = 0;              ///< the leading one, see leading_contact()
  Eigen::MatrixXd structure;    ///< of the reduced structure at analysis.motion_points instants, m; or empty
  Eigen::MatrixXd plane;        ///< of StructureModel::plane, 2 x output_points, m; or empty
  ResponseStability stability;  ///< with analysis.stability; else its status is empty
  /// With analysis.stability or analysis.phases; where it is not empty, the stability belongs to the motion
  /// found, and is not known if none is near.
  ExactAlongSweep::Point exact;
  /// Where it is known: the motion of the structure itself near this one, with its contact intervals.
  std::optional<solvers::ExactNearResponse> near;
};

/// The motions of analysis.motion_at: at the point with the largest displacement, at bifurcation and
/// grazing points in their order along the curve, and at all points with a given frequency or amplitude,
/// numbered if there are several. Branches are left out. A place that the curve does not pass has none.
/// `sweep` is one of the scene with motion_at. A response, its exact solution and its stability for each. If
/// the observer stops, the remaining ones are named in sweep.motions_left_out.
std::vector<CurveMotion> curve_motions(const Scene& scene, const StructureModel& model, Sweep& sweep,
                                       const Observer& observer = {});

}  // namespace wavebalance::app

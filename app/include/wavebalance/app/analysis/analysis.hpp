#pragma once
#include <limits>
#include <string>
#include <vector>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/analysis/start_motion.hpp"
#include "wavebalance/app/files/summary.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/response/frequency_sweep.hpp"
#include "wavebalance/solvers/stability/branches.hpp"

namespace wavebalance::app {

/// A curve of responses over the frequency or the amplitude. Frequencies are those of the load, also of the
/// branches; of an amplitude sweep load scales are amplitudes.
struct Sweep {
  solvers::FrequencySweep curve;
  solvers::CurveStability stability;      ///< set by add_stability(); without points otherwise
  std::vector<solvers::Branch> branches;  ///< set by add_stability() with analysis.branches
  int periods = 1;                        ///< of the load, over which its motions are solved for
  double start_distance = std::numeric_limits<double>::quiet_NaN();  ///< Response::start_distance
  int motion_periods =
      1;  ///< of the load, after which that of the first point repeats, solvers::motion_periods()
  double wall_seconds = 0.0;
  std::string amplitude_unit = "N";                ///< of an amplitude sweep
  std::vector<std::string> motions_left_out = {};  ///< those that curve_motions() was stopped before

  bool converged() const {
    return curve.status == solvers::SweepStatus::reached_end &&
           curve.rounding_error <= largest_rounding_error;
  }
  /// The observer stopped the curve, which holds the points so far.
  bool interrupted() const { return curve.status == solvers::SweepStatus::cancelled; }
  /// The observer stopped it, its stability, a branch or its motions.
  bool stopped() const;
  /// "reached_end", or the reason why not, such as "interrupted".
  std::string status() const;
};

/// The scene's frequency response by arc length. A change of frequency by 1/20 of the interval has the same
/// length as a change of displacement by the gap. analysis.first_step and analysis.largest_step are in Hz.
Sweep frequency_sweep(const Scene& scene, const Observer& observer = {});
/// The same for the scene's structure composed before. Its first point is sought near `start` unless that is
/// empty, as weighted_residual_response() does.
Sweep frequency_sweep(const Scene& scene, const StructureModel& model, const Observer& observer = {},
                      const StartMotion& start = {});

/// The curve of the scene's responses over reference_load() at forcing.frequency. A change of the amplitude
/// by 1/20 of the interval has the same length as a change of displacement by the gap.
Sweep amplitude_sweep(const Scene& scene, const Observer& observer = {});
Sweep amplitude_sweep(const Scene& scene, const StructureModel& model, const Observer& observer = {});

/// Sets the stability of a sweep of the scene, of which `model` is the structure, unless analysis.stability
/// is false or the structure's modes cannot be computed, and with analysis.branches its branches. An observer
/// that stops it leaves the points so far.
void add_stability(const Scene& scene, const StructureModel& model, Sweep& sweep,
                   const Observer& observer = {});

/// A further file of a record, ready to be written.
struct RecordFile {
  std::string name;
  std::string contents;
  std::string about;  ///< one sentence without its full stop
};

/// The results of an analysis: summary.json, response.csv, sweep.csv or backbone.csv, and a picture.
struct Record {
  bool converged = false;
  bool interrupted = false;  ///< a sweep that its observer stopped, or its stability
  std::string status;
  /// Reasons why the result may be inaccurate, one sentence each; also in the summary.
  std::vector<std::string> warnings;
  Summary summary;  ///< in the order in which summary.json holds it; NaN where a value has no meaning
  Table response;   ///< time_fraction, displacement_m, velocity_m_per_s, contact_force_N; empty after a curve
  Table sweep;      ///< see sweep_table(); empty otherwise
  Table backbone;   ///< points of a nonlinear mode, see backbone_table(); empty otherwise
  Table contacts;   ///< motion and force of every contact, see contacts_table(); empty unless there are many
  /// The motion of the whole structure: motion.pvd with its .vtu files, or motion.mtx; of a sweep the motions
  /// of its points, see curve_motions.hpp.
  std::vector<RecordFile> files;
  /// Displacements of the nodes of a bar from its clamp on (rows) at uniform instants of the period, m; empty
  /// for other structures and after a curve.
  Eigen::MatrixXd bar_motion;
  Figure figure;  ///< without panels when there is nothing to draw
};

/// Where a solution starts, what watches it, and on how many threads it runs.
struct AnalysisOptions {
  /// A motion near which the response or the first point of a sweep is sought, see require_start_fits(); what
  /// is not found near it is not sought elsewhere. Empty: none.
  StartMotion start{};
  Observer observer{};
  int threads = 0;  ///< that condense several harmonics side by side; 0: one per core. Digits do not change
  /// That of the scene, made before, whose threads then hold; null: it is made.
  const StructureModel* model = nullptr;
};

/// Solves `scene`. A failure to converge is reported in the record. Throws std::invalid_argument or
/// solvers::InadmissiblePair for scenes that load_scene() would have rejected.
Record analyse(const Scene& scene, const Observer& observer = {});
Record analyse(const Scene& scene, const AnalysisOptions& options);

/// The table of a frequency sweep's record; those of a motion are in contact_motion.hpp.
Table sweep_table(const solvers::FrequencySweep& curve);
/// The same with the columns `unstable`, missing where it is not known, and `contacts`; with branches also
/// `branch`, 0 on the main curve, and `period` in periods of the load, all curves one below the other. Of an
/// amplitude sweep the first column is the amplitude in its unit.
Table sweep_table(const Sweep& sweep, bool with_branches = false);

/// What would be solved, how large it is and whether the pair is admissible, in a few lines of text.
std::string describe_scene(const Scene& scene);

}  // namespace wavebalance::app

#pragma once
#include <Eigen/Core>

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "wavebalance/app/analysis/response.hpp"
#include "wavebalance/app/analysis/start_motion.hpp"
#include "wavebalance/app/analysis/sweep.hpp"
#include "wavebalance/app/files/summary.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/solvers/time/motion.hpp"

namespace wavebalance::app {

/// A file of a record, ready to be written.
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
  /// Sentences on the result, if the analysis writes its own.
  std::vector<std::string> sentences;
  Summary summary;  ///< in the order in which summary.json holds it; NaN where a value has no meaning
  Table response;   ///< time_fraction, displacement_m, velocity_m_per_s, contact_force_N; empty after a curve
  Table sweep;      ///< see sweep_table(); empty otherwise
  SweepAxis axis;   ///< of sweep and of the bifurcation and grazing points
  Table backbone;   ///< points of a nonlinear mode, see backbone_table(); empty otherwise
  /// Poincare section: of a motion that does not repeat displacement and velocity of each place at the
  /// beginning of each recorded period; of a diagram a row for each point. Empty otherwise.
  Table section;
  Table outputs;   ///< motion of each output over one period; empty after a curve and without any
  Table contacts;  ///< motion and force of every contact, see contacts_table(); empty unless there are many
  StartMotion cycle;  ///< a limit cycle as a start of others; empty otherwise
  /// The motion of the whole structure: motion.pvd with its .vtu files, or motion.mtx; of a sweep the motions
  /// of its points, see curve_motions.hpp.
  std::vector<RecordFile> files;
  /// Displacements of the nodes of a bar from its clamp on (rows) at uniform instants of the period, m; empty
  /// for other structures and after a curve.
  Eigen::MatrixXd bar_motion;
  Figure figure;                               ///< without panels when there is nothing to draw
  std::vector<RecordPicture> motion_pictures;  ///< of the motions of points of a curve
  std::vector<RecordPicture> output_pictures;  ///< of analysis.outputs and of contacts, each for itself

  /// At the end of the summary, by a Quantity or by its name.
  template <class Name, class Value>
  void add(const Name& name, Value&& value) {
    summary.emplace_back(name, std::forward<Value>(value));
  }
};

/// A table of a record by its name in files and in Python.
struct RecordTable {
  const char* name;
  Table Record::*table;
  const char* about;  ///< as of RecordFile
};
inline constexpr std::array<RecordTable, 6> record_tables{{
    {"response", &Record::response, "motion of the contact with the largest force over one period"},
    {"contacts", &Record::contacts,
     "every contact degree of freedom over one period, positive towards the obstacle"},
    {"section", &Record::section, "Poincare section: states at the start of each forcing period"},
    {"outputs", &Record::outputs, "every output over one period"},
    {"sweep", &Record::sweep, "periodic responses along the curve"},
    {"backbone", &Record::backbone, "a nonlinear mode, a motion per row"},
}};

/// Where a solution starts, what watches it, and on how many threads it runs.
struct AnalysisOptions {
  /// Start of a response or of the first point of a sweep, see require_start_fits(); no other start is tried.
  /// Empty: none.
  StartMotion start{};
  Observer observer{};
  int threads = 0;  ///< that condense several harmonics together; 0: one per core. Digits do not change
  /// Composed before, and its number of threads applies; null: it is composed.
  const StructureModel* model = nullptr;
};

/// Solves `scene`. A failure to converge is reported in the record. Throws std::invalid_argument or
/// solvers::InadmissiblePair for scenes that load_scene() would have rejected.
Record analyse(const Scene& scene, const Observer& observer = {});
Record analyse(const Scene& scene, const AnalysisOptions& options);

/// A few lines of text: the problem, its size and whether the pair is admissible.
std::string describe_scene(const Scene& scene);

/// time_fraction, displacement_m, velocity_m_per_s, contact_force_N of one contact, 1 x points each.
Table response_table(const solvers::Motion& contact);

/// time_fraction, contact (from 1), displacement_m, contact_force_N: every contact at every time, and of
/// contacts with several directions a row for each, which the column `direction` names.
Table contacts_table(const Scene& scene, const solvers::Motion& contacts);

/// The table of a frequency sweep's record.
Table sweep_table(const solvers::FrequencySweep& curve);
/// The same with the columns `unstable`, missing where it is not known, and `contacts`; with branches also
/// `branch`, 0 on the main curve, and `period` in periods of the load, all curves one below the other. The
/// first column of an amplitude sweep is the amplitude in its unit.
Table sweep_table(const Sweep& sweep, bool with_branches = false,
                  const std::vector<SceneContact>& contacts = {});

}  // namespace wavebalance::app

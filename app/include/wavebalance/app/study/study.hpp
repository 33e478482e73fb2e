#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wavebalance/app/analysis/start_motion.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/files/summary.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/app/study/messenger.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"

namespace wavebalance::app {

/// The structure of the last scene, reused by the next ones if it is the same. Runs of a study often differ
/// only in frequency, gap, law or basis, and a reduction takes longer than a response. One per thread.
class LastStructure {
 public:
  /// The model of a scene, as make_model() makes it. The result lives until the next call.
  const StructureModel& model_of(const Scene& scene, const solvers::Observer& observer);
  /// A scene with the same files of matrices, which need not be read again; null at first.
  const Scene* earlier() const { return part_ ? &*part_ : nullptr; }
  /// The last limit cycle that was found, from which the next run of a study may start; empty at first.
  StartMotion cycle;
  /// How many structures were made.
  int made() const { return made_; }

 private:
  std::optional<Scene> part_;  // what the model depends on
  StructureModel model_;
  int made_ = 0;
};

/// How the runs of a study are chosen.
enum class Sampling {
  grid,            ///< every combination of the values of all parameters
  list,            ///< the first values of all parameters, then the second ones, ...
  sobol,           ///< points of Sobol's sequence
  latin_hypercube  ///< as many strata per parameter as runs, one run in each
};
std::string name_of(Sampling sampling);

/// A key of a scene with its values or its interval.
struct StudyParameter {
  std::string key;                  ///< "contact.gap"
  std::vector<std::string> values;  ///< as TOML; empty for an interval
  double from = 0.0, to = 0.0;
  bool logarithmic = false;  ///< equal ratios instead of equal differences
  int count = 0;             ///< values of an interval in a grid
  bool integer = false;      ///< numbers of the interval are rounded

  bool is_interval() const { return values.empty(); }
};

/// A scene over values of its keys.
struct Study {
  std::string name;              ///< of the file, for messages
  std::filesystem::path scene;   ///< the scene's file, for messages; relative paths in it refer to its folder
  std::string scene_text;        ///< TOML
  std::vector<std::string> set;  ///< "section.key=value" in all runs
  std::vector<std::string> unset;  ///< "section.key" in all runs
  Sampling sampling = Sampling::grid;
  int samples = 0;         ///< runs of sobol and latin_hypercube
  std::uint64_t seed = 1;  ///< of latin_hypercube
  std::vector<StudyParameter> parameters;
  /// Whether each run starts from the limit cycle of the last one before it that converged, one by one.
  bool follow = false;
  std::string quantity;  ///< of the summaries, that is drawn; empty: the first that all runs have
};

/// The most runs of a study.
inline constexpr std::int64_t max_study_runs = 1'000'000;

/// Reads a study file and the scene that it names, relative to itself. Throws SceneError with file, line and
/// key if it is no study, names no key of a scene or has more than max_study_runs runs.
Study load_study(const std::filesystem::path& file);
/// The same for `text`, which messages call `name`, with paths relative to its folder. A study without a
/// key `scene` uses `scene_text`, whose paths are relative to `name`, too.
Study parse_study(std::string_view text, const std::string& name, const std::string& scene_text = "");

/// The study as one text, equal for studies of the same runs. O(scene + values).
std::string study_identity(const Study& study);

/// The values of the parameters in each run, numbered from 0.
class StudyRuns {
 public:
  /// Throws SceneError if a sampling cannot have these parameters. O(samples x parameters).
  explicit StudyRuns(const Study& study);

  std::int64_t size() const { return size_; }
  std::size_t parameters() const { return parameters_.size(); }
  /// As TOML: 0.001, "haar". Interval ends are exact, others have 15 digits.
  std::string value(std::int64_t run, std::size_t parameter) const;
  /// The same as a cell of a table: a number, a truth value or text.
  Cell cell(std::int64_t run, std::size_t parameter) const;
  /// "section.key=value" for all parameters of a run.
  std::vector<std::string> overrides(std::int64_t run) const;

 private:
  double share(std::int64_t run, std::size_t parameter) const;

  Sampling sampling_;
  std::vector<StudyParameter> parameters_;
  std::vector<double> points_;  // runs x parameters, in [0, 1), of sobol and latin_hypercube
  std::int64_t size_ = 0;
};

/// The scene of a run, see parse_scene() for `earlier`. Throws SceneError.
Scene scene_of_run(const Study& study, const StudyRuns& runs, std::int64_t run,
                   const Scene* earlier = nullptr);

/// Throws SceneError if the first run, or one that differs from it by the first or last value of a parameter,
/// is no scene, so that nothing is computed of a study that cannot be meant. O(parameters) scenes.
void check_study(const Study& study, const StudyRuns& runs);

/// Result of one run of a study.
struct StudyRow {
  std::int64_t run = 0;  ///< from 0
  std::string status;    ///< of the record; "refused" or "failed" if there is none
  bool converged = false;
  double seconds = 0.0;  ///< wall time, with the scene's reading
  std::string message;   ///< why it was refused or failed; else the first warning of the record
  Summary values;        ///< numbers, truth values and texts of the record's summary
};

/// Solves a run. An error is a row, too: "refused" for a scene that is wrong or needs more memory than the
/// machine has, "failed" for any other. After an observer has returned false the row has no meaning.
StudyRow solve_run(const Study& study, const StudyRuns& runs, std::int64_t run,
                   const solvers::Observer& observer = {});
/// The same, reusing the reduced structure of the last run if it is equal. Equal digits.
StudyRow solve_run(const Study& study, const StudyRuns& runs, std::int64_t run, LastStructure& last,
                   const solvers::Observer& observer = {});

/// A row as JSON on one line without its end, with its run counted from 1.
std::string json_line(const StudyRow& row);
/// Reads json_line(). Throws std::invalid_argument if it is no such line.
StudyRow parse_row(std::string_view line);

/// The rows of a study in DIR/study.journal, a line of JSON each, after a first line that identifies the
/// study. A row is there once append() has returned, also if the process is killed after it; where the
/// machine loses power, rows of the last second may be lost. A line that was cut off is dropped as the file
/// is opened again; another one that cannot be read stays and is counted, and its run has no row.
class StudyJournal {
 public:
  static constexpr const char* file_name = "study.journal";

  /// Opens the journal in `folder`, or begins one; the folder is made if it is missing. Throws IoError if
  /// another process writes to it, it belongs to another study or another version of the program, or it
  /// cannot be read or written.
  StudyJournal(const std::filesystem::path& folder, const Study& study, const StudyRuns& runs);
  ~StudyJournal();
  StudyJournal(const StudyJournal&) = delete;
  StudyJournal& operator=(const StudyJournal&) = delete;

  /// The rows found as it was opened, each run once, in the order of the file. Moved out.
  std::vector<StudyRow> take_rows() { return std::move(rows_); }
  /// Lines that were no rows of the study as it was opened.
  std::int64_t unreadable_lines() const { return unreadable_lines_; }
  /// Throws IoError; the file then ends with the row before.
  void append(const StudyRow& row);

 private:
  void read(const std::string& header, std::int64_t runs);
  void read_rows(std::string_view text, std::int64_t runs);
  void write_line(const std::string& line);

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::int64_t size_ = 0;  // bytes of whole lines
  std::chrono::steady_clock::time_point flushed_;
  std::vector<StudyRow> rows_;
  std::int64_t unreadable_lines_ = 0;
};

/// The runs that have no row yet, in ascending order.
std::vector<std::int64_t> missing_runs(const std::vector<StudyRow>& rows, std::int64_t runs);

/// Takes rows in the order in which they end, called by one thread.
using RowSink = std::function<void(const StudyRow&)>;

struct StudyOptions {
  int threads = 0;  ///< that solve runs in this process; 0: one per core, or with a messenger one
  Messenger* messenger = nullptr;  ///< to processes that solve runs, too
  /// After which a process counts as dead, above 1 s. All send a message each second.
  std::chrono::milliseconds longest_silence{10'000};

  /// Throws std::invalid_argument.
  void validate() const;
};

/// How a study ran.
struct StudyOutcome {
  bool stopped = false;     ///< by the observer
  std::int64_t solved = 0;  ///< runs, each once
  int workers = 1;          ///< threads that solved runs, of all processes
  int lost = 0;  ///< processes that ended or fell silent; what they had not returned was solved by others
  double wall_seconds = 0.0;
};

/// Solves the runs `todo` and hands each row to `sink` once. Work is distributed as it is finished, so that
/// all workers end within the time of one run. The observer is called by this thread; once it returns
/// false, runs under way are dropped. Rows do not depend on the number of workers, but for their seconds.
/// An exception of `sink` ends the study. With a messenger this is the part of process 0.
StudyOutcome run_study(const Study& study, const StudyRuns& runs, const std::vector<std::int64_t>& todo,
                       const StudyOptions& options, const RowSink& sink,
                       const solvers::Observer& observer = {});

/// The part of all other processes: solves what process 0 sends until that ends the study or falls silent.
/// options.messenger is not used.
void serve_study(const Study& study, const StudyRuns& runs, Messenger& messenger,
                 const StudyOptions& options);

/// The results of a study, ready to be written and shown.
struct StudyRecord {
  bool converged = false;  ///< all runs have ended and converged
  bool complete = false;   ///< all runs have ended
  std::vector<std::string> warnings;
  std::vector<std::string> changes;  ///< where limit cycles that follow one another appear, end, or change
  std::string status;  ///< "converged", "not_converged" if a run did not, "interrupted" if runs are left
  Summary summary;
  Table table;  ///< study.csv and study.npz, see study_table()
  std::vector<RecordPicture> pictures;
};

/// run from 1, the parameters by their keys, status, converged, seconds, the values of the summaries, and
/// message; a row per run, in their order. Missing values are NaN, or "" in a column of texts.
Table study_table(const Study& study, const StudyRuns& runs, const std::vector<StudyRow>& rows);

/// quantity, runs, mean, min, q05, q25, median, q75, q95, max of the converged rows of all columns of numbers
/// that are not the same in all of them. Quantiles interpolate linearly between ordered values (type 7 of
/// R. J. Hyndman and Y. Fan, The American Statistician 50 (1996) 361-365).
Table quantiles_table(const Study& study, const Table& table);

/// status, runs: how often each occurred, the most frequent first.
Table statuses_table(const Table& table);

/// The name of the column that pictures show: study.quantity if there is such a column, max_displacement_m,
/// or the first column of numbers of the summaries; empty without any.
std::string drawn_quantity(const Study& study, const Table& table);

/// A response map of a grid over its two parameters of numbers, curves over one, and of samples the
/// distribution and the values over each parameter; without panels if nothing can be drawn.
Figure study_figure(const Study& study, const StudyRuns& runs, const Table& table,
                    const std::string& quantity);

/// All results of a study whose `rows` have ended, in any order; `unreadable_lines` counts lines of its
/// journal.
StudyRecord study_record(const Study& study, const StudyRuns& runs, std::vector<StudyRow> rows,
                         const StudyOutcome& outcome, std::int64_t unreadable_lines = 0);

}  // namespace wavebalance::app

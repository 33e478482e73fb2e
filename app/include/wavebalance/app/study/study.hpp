#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {

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

}  // namespace wavebalance::app

#pragma once

#include "report/arguments.hpp"
#include "wavebalance/app/compare/comparison.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/app/study/study.hpp"

namespace wavebalance::app {

/// report.html: the problem, results in sentences, warnings, stability, the picture with curves that zoom,
/// the motion of a bar, all values and files. It holds all that it shows; without scripts the pictures
/// stay. `scene_text` is the scene as the record has it.
std::string report_text(const RunArguments& arguments, const Scene& scene, const std::string& scene_text,
                        const Record& record, const Summary& summary, const std::vector<RecordFile>& files);

/// report.html of a comparison: recommendation with [time] tables to paste, pictures with curves that zoom,
/// results and failures of each pair, reference with its stability, warnings, command, all values and
/// files. The page is self-contained.
std::string comparison_report(const CompareArguments& arguments, const Scene& scene,
                              const ComparisonRecord& record, const Summary& summary,
                              const std::vector<RecordFile>& files);

/// The files of a run, ready to be written.
struct RunFiles {
  std::vector<RecordFile> files;  ///< all but the summary; with arguments.report the report first
  std::string summary;            ///< contents of summary.json
  std::string no_picture;         ///< why there is no picture; empty where one is drawn or none is due
};

/// The files of a record. Without gnuplot there is no picture.
RunFiles run_files(const RunArguments& arguments, const Scene& scene, const Record& record);

/// Whether a file of a record is a copy that scene_of_record() makes, by its name.
bool is_copy(std::string_view name);

/// The scene as a record in arguments.output holds it: its files are copies, which are appended to `files`,
/// or have names relative to the record if they are in the folder of the given scene or below it. Throws
/// IoError where a file cannot be read.
Scene scene_of_record(const RunArguments& arguments, const Scene& scene, std::vector<RecordFile>& files);

/// Appends pictures as SVG and, with `curves`, the data of those that a page can zoom. Returns why there are
/// none, if gnuplot was not found; else an empty text.
std::string append_pictures(std::vector<RecordFile>& files, const std::vector<RecordPicture>& pictures,
                            bool curves);

/// The files that a command reads, none of which it replaces.
using InputFiles = std::vector<std::filesystem::path>;

/// The scene's file, those that it names, and a start; `start` may be a folder of results.
InputFiles inputs_of(const std::filesystem::path& file, const Scene& scene,
                     const std::filesystem::path& start = {});

/// require_replaceable() for the files that a run of the scene may write, before it is solved.
void check_run_output(const RunArguments& arguments, const Scene& scene);

/// Writes all files at once and replaces the files of an earlier record. The summary is last, so that it
/// exists only if the others do. Throws IoError, also where require_replaceable() does.
void write_run_files(OutputFiles& output, const RunFiles& files, const InputFiles& inputs);

/// The files of a study. Its page has the numbers of runs by status, quantiles of all quantities, and the
/// runs that did not converge with the command that repeats one. Without gnuplot there is no picture.
RunFiles study_files(const StudyArguments& arguments, const Study& study, const StudyRecord& record);

/// The files that a study reads: its own, the scene, and those that the first run names.
InputFiles inputs_of(const StudyArguments& arguments, const Study& study, const StudyRuns& runs);

/// require_replaceable() for the files of a study, before anything is solved.
void check_study_output(const StudyArguments& arguments, const InputFiles& inputs);

/// The same outcome in a few lines for a terminal.
std::string study_outcome(const StudyRecord& record);

}  // namespace wavebalance::app

#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "report/arguments.hpp"
#include "report/run_report.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/results/record.hpp"

namespace wavebalance::app {

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

}  // namespace wavebalance::app

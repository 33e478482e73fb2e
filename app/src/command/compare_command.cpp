#include "command/commands.hpp"

#include <cstdio>

#include "report/page_parts.hpp"
#include "report/reports.hpp"
#include "wavebalance/app/compare/comparison.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/record_folder.hpp"
#include "wavebalance/solvers/linalg/parallel_for.hpp"

namespace wavebalance::app {
namespace {

ComparisonOptions options_of(const CompareArguments& arguments) {
  ComparisonOptions options;
  if (!arguments.pairs.empty()) options.pairs = parse_pairs(arguments.pairs);
  if (!arguments.error.empty()) options.measure = parse_error_measure(arguments.error);
  options.budget = arguments.budget;
  options.threads = arguments.run.threads;
  if (!arguments.run.start_from.empty()) options.start = read_start_motion(arguments.run.start_from);
  return options;
}

/// All files but the summary; with a report first this, still without contents.
std::vector<RecordFile> files_of(const RunArguments& arguments, const Scene& scene,
                                 const ComparisonRecord& record) {
  const bool report = arguments.report;
  std::vector<RecordFile> files, inputs;
  if (report) files.push_back({"report.html", "", "the report of this comparison"});
  const Scene written = scene_of_record(arguments, scene, inputs);
  files.push_back({"scene.toml", write_scene(written), "the scene that was compared"});
  for (RecordFile& input : inputs) files.push_back(std::move(input));
  if (!record.table.empty())
    files.push_back({"comparison.csv", csv_text(record.table), "a row for each solve"});
  files.push_back({"comparison.md", record.markdown, "the recommendation and the results of each pair"});
  say_no_picture(append_pictures(files, record.pictures, report));
  return files;
}

/// Whether a comparison may write a file of this name.
bool may_write(const RunArguments& arguments, const std::string& name) {
  if (name == "report.html") return arguments.report;
  if (is_copy(name)) return arguments.copy_inputs;
  for (const char* one : {"summary.json", "scene.toml", "comparison.csv", "comparison.md"})
    if (name == one) return true;
  for (const char* stem : {"error_over_time", "error_over_functions", "sweeps"})
    if (name == std::string(stem) + ".svg" || name == std::string(stem) + ".figure.js") return true;
  return false;
}

Summary whole_summary(const CompareArguments& arguments, const ComparisonRecord& record,
                      const std::vector<RecordFile>& files) {
  Summary summary = record.summary;
  summary.emplace_back("budget_seconds", arguments.budget);
  summary.emplace_back("threads", std::int64_t{solvers::thread_count(arguments.run.threads)});
  summary.emplace_back("scene", arguments.run.scene.string());
  summary.emplace_back("set", arguments.run.overrides);
  summary.emplace_back("unset", arguments.run.removed);
  if (!arguments.run.start_from.empty())
    summary.emplace_back("start_from", arguments.run.start_from.string());
  append_files(summary, files);
  return summary;
}

void say(const CompareArguments& arguments, const ComparisonRecord& record,
         const std::vector<RecordFile>& files) {
  if (!arguments.run.quiet) {
    std::fputs(record.text.c_str(), stdout);
    std::printf("\nwritten to %s: %s\n", arguments.run.output.c_str(), names_of(files).c_str());
  }
  say_warnings(record.warnings);
  if (record.interrupted)
    std::fputs("wavebalance: interrupted; the results so far are written\n", stderr);
  else if (!record.converged)
    std::fprintf(stderr, "wavebalance: no reference to compare with (%s)\n", record.status.c_str());
}

}  // namespace

int compare_scene(const CompareArguments& arguments) {
  require_output(arguments.run.output);
  const ComparisonOptions options = options_of(arguments);
  const Scene scene = given_scene(arguments.run);
  check_comparison(scene, options);
  const InputFiles inputs = inputs_of(arguments.run.scene, scene, arguments.run.start_from);
  require_replaceable(
      arguments.run.output, [&](const std::string& name) { return may_write(arguments.run, name); }, inputs);
  OutputFiles output(arguments.run.output);
  InterruptGuard guard(true);
  const ComparisonRecord record = until_signal(guard, arguments.run.quiet, [&](const Observer& observer) {
    return compare_bases(scene, options, observer);
  });
  if (record.interrupted && record.table.empty()) guard.end_program();
  std::vector<RecordFile> files = files_of(arguments.run, scene, record);
  const Summary summary = whole_summary(arguments, record, files);
  if (arguments.run.report)
    files.front().contents = comparison_report(arguments, scene, record, summary, files);
  guard.defer();
  write_run_files(output, {files, json_text(summary), ""}, inputs);
  say(arguments, record, files);
  if (record.interrupted) return interrupted + guard.signal();
  return record.converged ? solved : not_converged;
}

}  // namespace wavebalance::app

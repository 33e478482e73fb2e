#include "command/study_command.hpp"

#include <fmt/format.h>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <utility>

#include "command/commands.hpp"
#include "command/interrupt_guard.hpp"
#include "command/progress_bar.hpp"
#include "report/run_record.hpp"
#include "report/study_report.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/study/journal.hpp"

namespace wavebalance::app {
namespace {

void say_outcome(const StudyArguments& arguments, const StudyRecord& record, const StudyOutcome& outcome,
                 const std::vector<ResultFile>& files) {
  if (!arguments.quiet) {
    std::fputs(study_outcome(record).c_str(), stdout);
    std::string list = "summary.json";
    for (const ResultFile& file : files) list += ", " + file.name;
    std::printf("written to %s: %s\n", arguments.output.c_str(), list.c_str());
  }
  for (const std::string& warning : record.warnings)
    std::fprintf(stderr, "wavebalance: warning: %s\n", warning.c_str());
  if (outcome.lost > 0)
    std::fprintf(stderr, "wavebalance: warning: %d of the processes fell silent; others solved their runs\n",
                 outcome.lost);
  if (outcome.stopped) std::fputs("wavebalance: interrupted; the same command goes on from here\n", stderr);
}

std::string unreadable_text(std::int64_t lines) {
  return fmt::format("{} line{} of {} cannot be read; runs without a row are solved again", lines,
                     lines == 1 ? "" : "s", StudyJournal::file_name);
}

/// Each run frees what the next one allocates again. By default the memory goes back to the system in
/// between, whose pages are then cleared anew: a tenth of the time of two threads.
void keep_freed_memory() {
#ifdef M_TRIM_THRESHOLD
  ::mallopt(M_TRIM_THRESHOLD, 1 << 30);
  ::mallopt(M_TOP_PAD, 1 << 24);
#endif
}

/// The part of the process that writes.
int lead_study(const StudyArguments& arguments, const Study& study, const StudyRuns& runs,
               Messenger* messenger) {
  const InputFiles inputs = inputs_of(arguments, study, runs);
  check_study_output(arguments, inputs);
  OutputFiles output(arguments.output);
  StudyJournal journal(arguments.output, study, runs);
  std::vector<StudyRow> rows = journal.take_rows();
  const std::vector<std::int64_t> todo = missing_runs(rows, runs.size());
  if (!rows.empty() && !arguments.quiet)
    std::fprintf(stderr, "wavebalance: %zu of %lld runs are there already\n", rows.size(),
                 static_cast<long long>(runs.size()));
  if (journal.unreadable_lines() > 0)
    std::fprintf(stderr, "wavebalance: warning: %s\n", unreadable_text(journal.unreadable_lines()).c_str());
  InterruptGuard guard(true);
  ProgressBar bar;
  StudyOptions options;
  options.threads = arguments.threads;
  options.messenger = messenger;
  const StudyOutcome outcome = run_study(
      study, runs, todo, options,
      [&](const StudyRow& row) {
        journal.append(row);
        rows.push_back(row);
      },
      [&](const solvers::Progress& progress) {
        if (!arguments.quiet) bar.show(progress);
        return guard.signal() == 0;
      });
  bar.finish();
  const StudyRecord record = study_record(study, runs, std::move(rows), outcome, journal.unreadable_lines());
  guard.defer();
  const RunFiles files = study_files(arguments, study, record);
  if (!files.no_picture.empty())
    std::fprintf(stderr, "wavebalance: no picture: %s\n", files.no_picture.c_str());
  write_run_files(output, files, inputs);
  say_outcome(arguments, record, outcome, files.files);
  if (outcome.stopped) return interrupted + guard.signal();
  return record.converged ? solved : not_converged;
}

}  // namespace

int solve_study(const StudyArguments& arguments) {
  if (arguments.output.empty())
    throw std::invalid_argument(
        "--output is \"\"; expected the name of a folder, which is made if it is missing");
  keep_freed_memory();
  const Study study = load_study(arguments.study);
  const StudyRuns runs(study);
  check_study(study, runs);
  const std::unique_ptr<Messenger> messenger = launched_messenger();
  if (!messenger || messenger->rank() == 0) return lead_study(arguments, study, runs, messenger.get());
  StudyOptions options;
  options.threads = arguments.threads;
  serve_study(study, runs, *messenger, options);
  return solved;
}

}  // namespace wavebalance::app

#include "command/commands.hpp"

#include <fmt/format.h>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include <cstdio>

#include "report/reports.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/scene/scene_error.hpp"
#include "wavebalance/app/study/study.hpp"

namespace wavebalance::app {
namespace {

void say_outcome(const StudyArguments& arguments, const StudyRecord& record, const StudyOutcome& outcome,
                 const std::vector<RecordFile>& files) {
  if (!arguments.quiet) {
    std::fputs(study_outcome(record).c_str(), stdout);
    std::printf("written to %s: %s\n", arguments.output.c_str(), names_of(files).c_str());
  }
  say_warnings(record.warnings);
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
  StudyOptions options;
  options.threads = arguments.threads;
  options.messenger = messenger;
  const RowSink keep = [&](const StudyRow& row) {
    journal.append(row);
    rows.push_back(row);
  };
  const StudyOutcome outcome = until_signal(guard, arguments.quiet, [&](const solvers::Observer& observer) {
    return run_study(study, runs, todo, options, keep, observer);
  });
  const StudyRecord record = study_record(study, runs, std::move(rows), outcome, journal.unreadable_lines());
  guard.defer();
  const RunFiles files = study_files(arguments, study, record);
  say_no_picture(files.no_picture);
  write_run_files(output, files, inputs);
  say_outcome(arguments, record, outcome, files.files);
  if (outcome.stopped) return interrupted + guard.signal();
  return record.converged ? solved : not_converged;
}

}  // namespace

int solve_study(const StudyArguments& arguments) {
  require_output(arguments.output);
  keep_freed_memory();
  const Study study = load_study(arguments.study);
  const StudyRuns runs(study);
  check_study(study, runs);
  const std::unique_ptr<Messenger> messenger = launched_messenger();
  if (messenger && study.follow)
    throw SceneError(
        {study.name, 0, "", "follow", "true", "the runs follow one another; expected one process"});
  if (!messenger || messenger->rank() == 0) return lead_study(arguments, study, runs, messenger.get());
  StudyOptions options;
  options.threads = arguments.threads;
  serve_study(study, runs, *messenger, options);
  return solved;
}

}  // namespace wavebalance::app

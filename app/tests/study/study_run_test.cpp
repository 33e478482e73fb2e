#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <fstream>
#include <memory>
#include <mutex>
#include <thread>

#include "support/scene_texts.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/study/journal.hpp"
#include "wavebalance/app/study/study_record.hpp"
#include "wavebalance/app/study/study_runner.hpp"

namespace {

using namespace wavebalance::app;
using namespace std::chrono_literals;

/// The bar at `count` frequencies, with few functions.
struct BarStudy {
  explicit BarStudy(int count)
      : study(parse_study("set = [\"time.functions=15\", \"time.quadrature_points=64\"]\n"
                          "[[parameters]]\nkey = \"forcing.frequency\"\nfrom = 120\nto = 160\ncount = " +
                              std::to_string(count) + "\n",
                          "study.toml", bar_scene)),
        runs(study) {}
  Study study;
  StudyRuns runs;
  std::vector<std::int64_t> all() const { return missing_runs({}, runs.size()); }
};

/// All rows without their seconds, in the order of their runs.
std::vector<std::string> texts_of(std::vector<StudyRow> rows) {
  std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.run < b.run; });
  std::vector<std::string> texts;
  for (StudyRow& row : rows) {
    row.seconds = 0.0;
    texts.push_back(json_line(row));
  }
  return texts;
}

std::vector<StudyRow> solved_with(const BarStudy& bar, int threads) {
  std::vector<StudyRow> rows;
  StudyOptions options;
  options.threads = threads;
  const StudyOutcome outcome =
      run_study(bar.study, bar.runs, bar.all(), options, [&](const StudyRow& row) { rows.push_back(row); });
  EXPECT_EQ(outcome.workers, threads);
  EXPECT_EQ(outcome.solved, bar.runs.size());
  return rows;
}

/// A strip of matrices, over what its structure depends on and what not.
std::filesystem::path strip_study() {
  static const TemporaryFolder folder;
  return folder.write("study.toml",
                      std::string("scene = \"") + WAVEBALANCE_SCENES +
                          "/matrices/strip_forced.toml\"\nset = [\"time.functions=15\"]\n"
                          "[[parameters]]\nkey = \"structure.modal_damping\"\nvalues = [0.01, 0.02]\n"
                          "[[parameters]]\nkey = \"contact.stiffness\"\nvalues = [1e4, 2e4]\n"
                          "[[parameters]]\nkey = \"forcing.frequency\"\nvalues = [70.0, 75.0]\n");
}

TEST(StudyRun, RowsAreThoseOfTheRecordWithAnyNumberOfThreads) {
  const BarStudy bar(12);
  const auto one = texts_of(solved_with(bar, 1));
  ASSERT_EQ(one.size(), 12u);
  EXPECT_EQ(one, texts_of(solved_with(bar, 3)));
  const Record record = analyse(scene_of_run(bar.study, bar.runs, 5));
  const StudyRow row = parse_row(one[5]);
  EXPECT_EQ(row.status, "converged");
  const auto displacement = [](const Summary& summary) { return number_in(summary, {"max_displacement_m"}); };
  EXPECT_GT(displacement(row.values), 1e-4);
  EXPECT_EQ(displacement(row.values), displacement(record.summary));
}

TEST(StudyRun, AStructureIsReducedOnceWhereItIsTheSameAndGivesTheSameDigits) {
  const Study study = load_study(strip_study());
  const StudyRuns runs(study);
  ASSERT_EQ(runs.size(), 8);
  LastStructure last;
  for (std::int64_t run = 0; run < runs.size(); ++run) {
    const StudyRow row = solve_run(study, runs, run, last);
    EXPECT_TRUE(row.converged) << row.message;
    EXPECT_EQ(texts_of({row}), texts_of({solve_run(study, runs, run)}));
  }
  // Gaps, stiffnesses and frequencies are not the structure's; the damping, which varies slowest, is.
  EXPECT_EQ(last.made(), 2);
}

TEST(StudyRun, ARunThatIsRefusedIsARowAndTheOthersGoOn) {
  const Study study =
      parse_study("[[parameters]]\nkey = \"time.functions\"\nvalues = [15, -3, 31]\n", "s.toml", bar_scene);
  const StudyRuns runs(study);
  std::vector<StudyRow> rows;
  run_study(study, runs, missing_runs({}, 3), {}, [&](const StudyRow& row) { rows.push_back(row); });
  ASSERT_EQ(rows.size(), 3u);
  const StudyRecord record = study_record(study, runs, rows, {});
  EXPECT_EQ(record.status, "not_converged");
  EXPECT_EQ(std::get<std::string>(record.table.at(1, "status")), "refused");
  EXPECT_NE(std::get<std::string>(record.table.at(1, "message")).find("time.functions = -3"),
            std::string::npos);
  EXPECT_TRUE(std::get<bool>(record.table.at(2, "converged")));
}

TEST(StudyRun, ARunThatDoesNotConvergeHasNoResultsAndIsNotDrawn) {
  const Study study = parse_study(
      "set = [\"analysis.type=time_stepping\"]\nquantity = \"max_contact_force_N\"\n"
      "[[parameters]]\nkey = \"analysis.max_periods\"\nvalues = [1, 2]\n",
      "s.toml", bar_scene);
  const StudyRuns runs(study);
  std::vector<StudyRow> rows;
  run_study(study, runs, missing_runs({}, 2), {}, [&](const StudyRow& row) { rows.push_back(row); });
  const StudyRecord record = study_record(study, runs, rows, {});
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(cell_text(record.table.at(i, "status")), "iteration_limit");
    for (const char* name : {"max_displacement_m", "min_displacement_m", "rms_displacement_m",
                             "max_contact_force_N", "contact_fraction"})
      EXPECT_TRUE(std::isnan(std::get<double>(record.table.at(i, name)))) << name;
    EXPECT_TRUE(std::isfinite(record.table.numbers("iterations")[i]));
    EXPECT_TRUE(std::isfinite(record.table.numbers("frequency_Hz")[i]));
  }
  EXPECT_TRUE(record.pictures.empty());
  EXPECT_EQ(quantiles_table(study, record.table).rows(), 0u);
}

TEST(StudyRun, RowsSurviveTheirJournal) {
  StudyRow row{7, "stalled", false, 0.25, "a \"message\"\nof two lines", {}};
  row.values = {{"number", 0.1},
                {"whole", 1.0},
                {"count", std::int64_t{3}},
                {"truth", true},
                {"text", std::string("newton")},
                {"missing", std::numeric_limits<double>::quiet_NaN()}};
  const std::string line = json_line(row);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const StudyRow read = parse_row(line);
  EXPECT_EQ(json_line(read), line);
  EXPECT_EQ(read.run, 7);
  EXPECT_EQ(std::get<double>(read.values[1].value), 1.0);
  EXPECT_THROW(parse_row("{\"run\": 1}"), std::invalid_argument);
}

TEST(StudyRun, GoesOnWhereItWasKilledWithNothingLostAndNothingTwice) {
  const TemporaryFolder folder;
  const BarStudy bar(10);
  {
    StudyJournal journal(folder.path(), bar.study, bar.runs);
    EXPECT_TRUE(journal.take_rows().empty());
    for (const std::int64_t run : {3, 0, 8}) journal.append(solve_run(bar.study, bar.runs, run));
  }
  // Killed as it wrote a row, which is cut off.
  std::ofstream(folder / StudyJournal::file_name, std::ios::app) << "{\"run\":5,\"status\":\"conv";
  std::vector<StudyRow> rows;
  {
    StudyJournal journal(folder.path(), bar.study, bar.runs);
    rows = journal.take_rows();
    ASSERT_EQ(rows.size(), 3u);
    const auto missing = missing_runs(rows, bar.runs.size());
    EXPECT_EQ(missing, (std::vector<std::int64_t>{1, 2, 4, 5, 6, 7, 9}));
    run_study(bar.study, bar.runs, missing, {}, [&](const StudyRow& row) {
      journal.append(row);
      rows.push_back(row);
    });
  }
  EXPECT_EQ(texts_of(rows), texts_of(solved_with(bar, 1)));
  StudyJournal journal(folder.path(), bar.study, bar.runs);
  EXPECT_EQ(texts_of(journal.take_rows()), texts_of(rows));
}

TEST(StudyRun, LinesOfTheJournalThatCannotBeReadAreCountedAndTheirRunsSolvedAgain) {
  const TemporaryFolder folder;
  const BarStudy bar(6);
  {
    StudyJournal journal(folder.path(), bar.study, bar.runs);
    for (const std::int64_t run : {0, 1, 2, 3}) journal.append(solve_run(bar.study, bar.runs, run));
  }
  std::string text = read_file(folder / StudyJournal::file_name);
  const auto line_of = [&](const std::string& run) { return text.find("{\"run\":" + run); };
  text[line_of("2") + 3] = '\xff';
  text.replace(line_of("4"), 4, 4, '\0');
  folder.write(StudyJournal::file_name, text + "{\"run\":99,\"status\":\"converged\"}\n");
  std::vector<StudyRow> rows;
  {
    StudyJournal journal(folder.path(), bar.study, bar.runs);
    EXPECT_EQ(journal.unreadable_lines(), 3);
    rows = journal.take_rows();
    const auto missing = missing_runs(rows, bar.runs.size());
    EXPECT_EQ(missing, (std::vector<std::int64_t>{1, 3, 4, 5}));
    run_study(bar.study, bar.runs, missing, {}, [&](const StudyRow& row) {
      journal.append(row);
      rows.push_back(row);
    });
    const StudyRecord record = study_record(bar.study, bar.runs, rows, {}, journal.unreadable_lines());
    EXPECT_EQ(number_in(record.summary, {"journal_lines_unreadable"}), 3.0);
  }
  EXPECT_EQ(texts_of(rows), texts_of(solved_with(bar, 1)));
  StudyJournal journal(folder.path(), bar.study, bar.runs);
  EXPECT_EQ(texts_of(journal.take_rows()), texts_of(rows));
}

TEST(StudyRun, TheJournalOfAnotherStudyOrOneInUseIsRefused) {
  const TemporaryFolder folder;
  const BarStudy bar(10), other(11);
  {
    StudyJournal journal(folder.path(), bar.study, bar.runs);
    EXPECT_THROW(StudyJournal(folder.path(), bar.study, bar.runs), IoError);
  }
  EXPECT_THROW(StudyJournal(folder.path(), other.study, other.runs), IoError);
  folder.write(StudyJournal::file_name, "something else\n");
  EXPECT_THROW(StudyJournal(folder.path(), bar.study, bar.runs), IoError);
}

TEST(StudyRun, AnObserverStopsItAndRowsSoFarStay) {
  const BarStudy bar(400);
  std::vector<StudyRow> rows;
  const StudyOutcome outcome = run_study(
      bar.study, bar.runs, bar.all(), {}, [&](const StudyRow& row) { rows.push_back(row); },
      [&](const wavebalance::solvers::Progress&) { return rows.size() < 5; });
  EXPECT_TRUE(outcome.stopped);
  EXPECT_GE(rows.size(), 5u);
  EXPECT_LT(rows.size(), 400u);
  EXPECT_EQ(study_record(bar.study, bar.runs, rows, outcome).status, "interrupted");
}

TEST(StudyRun, WhatTheSinkThrowsEndsTheStudy) {
  const BarStudy bar(50);
  EXPECT_THROW(run_study(bar.study, bar.runs, bar.all(), {},
                         [](const StudyRow&) { throw IoError("study.journal", "cannot be written"); }),
               IoError);
  StudyOptions wrong;
  wrong.threads = -1;
  EXPECT_THROW(run_study(bar.study, bar.runs, bar.all(), wrong, [](const StudyRow&) {}),
               std::invalid_argument);
}

/// Messages between threads in place of processes.
class MailBoxes {
 public:
  explicit MailBoxes(int size) : boxes_(static_cast<std::size_t>(size)) {}
  int size() const { return static_cast<int>(boxes_.size()); }
  void put(int to, Message message) {
    const std::lock_guard lock(mutex_);
    boxes_[static_cast<std::size_t>(to)].push_back(std::move(message));
  }
  std::optional<Message> take(int of) {
    const std::lock_guard lock(mutex_);
    auto& box = boxes_[static_cast<std::size_t>(of)];
    if (box.empty()) return std::nullopt;
    Message message = std::move(box.front());
    box.pop_front();
    return message;
  }

 private:
  std::mutex mutex_;
  std::vector<std::deque<Message>> boxes_;
};

class ThreadMessenger : public Messenger {
 public:
  ThreadMessenger(MailBoxes& boxes, int rank) : boxes_(boxes), rank_(rank) {}
  int rank() const override { return rank_; }
  int size() const override { return boxes_.size(); }
  void send(int to, std::string_view text) override { boxes_.put(to, {rank_, std::string(text)}); }
  std::optional<Message> receive() override { return boxes_.take(rank_); }
  void give_up(int) override {}

 private:
  MailBoxes& boxes_;
  int rank_;
};

TEST(StudyRun, ProcessesShareTheRunsAndGiveTheRowsOfOne) {
  const BarStudy bar(60);
  MailBoxes boxes(3);
  std::vector<std::jthread> others;
  for (int rank = 1; rank < 3; ++rank)
    others.emplace_back([&, rank] {
      ThreadMessenger messenger(boxes, rank);
      serve_study(bar.study, bar.runs, messenger, {});
    });
  ThreadMessenger messenger(boxes, 0);
  StudyOptions options;
  options.messenger = &messenger;
  std::vector<StudyRow> rows;
  const StudyOutcome outcome =
      run_study(bar.study, bar.runs, bar.all(), options, [&](const StudyRow& row) { rows.push_back(row); });
  EXPECT_EQ(outcome.lost, 0);
  EXPECT_EQ(texts_of(rows), texts_of(solved_with(bar, 1)));
}

TEST(StudyRun, AProcessThatDiesLosesOnlyItsRunsWhichOthersSolve) {
  const BarStudy bar(20);
  MailBoxes boxes(2);
  ThreadMessenger dying(boxes, 1);
  dying.send(0, "h2");  // it has two threads, takes runs and never answers
  ThreadMessenger messenger(boxes, 0);
  StudyOptions options;
  options.messenger = &messenger;
  options.longest_silence = 1500ms;
  std::vector<StudyRow> rows;
  const StudyOutcome outcome =
      run_study(bar.study, bar.runs, bar.all(), options, [&](const StudyRow& row) { rows.push_back(row); });
  EXPECT_EQ(outcome.lost, 1);
  EXPECT_EQ(dying.receive()->text.front(), 's');  // it was given work
  EXPECT_EQ(texts_of(rows), texts_of(solved_with(bar, 1)));
}

TEST(StudyRun, QuantilesAreThoseOfTheConvergedRuns) {
  const Study study = parse_study("[[parameters]]\nkey = \"contact.gap\"\nvalues = [1, 2, 3, 4, 5, 6]\n",
                                  "s.toml", bar_scene);
  const StudyRuns runs(study);
  std::vector<StudyRow> rows;
  for (int i = 0; i < 6; ++i) {
    StudyRow row{i, i < 5 ? "converged" : "stalled", i < 5, 0.1, "", {}};
    row.values = {{"max_displacement_m", i < 5 ? 10.0 * i : 1e9}, {"same", 1.0}};
    rows.push_back(row);
  }
  std::swap(rows[0], rows[4]);
  const StudyRecord record = study_record(study, runs, rows, {});
  EXPECT_EQ(record.status, "not_converged");
  EXPECT_EQ(record.table.numbers("run"), (std::vector<double>{1, 2, 3, 4, 5, 6}));
  const Table quantiles = quantiles_table(study, record.table);
  ASSERT_EQ(quantiles.rows(), 1u);
  const std::vector<std::pair<const char*, double>> expected{{"mean", 20.0}, {"min", 0.0},     {"q05", 2.0},
                                                             {"q25", 10.0},  {"median", 20.0}, {"q95", 38.0},
                                                             {"max", 40.0}};
  for (const auto& [name, value] : expected)
    EXPECT_NEAR(std::get<double>(quantiles.at(0, name)), value, 1e-13 * 40.0) << name;
  EXPECT_EQ(record.pictures.size(), 1u);
}

// A gap over decades, and a load of 100 kN.
TEST(StudyFigure, NumbersTheAxesOfAMapByWhatTheParametersAreInReadableUnits) {
  const Study study = parse_study(
      "[[parameters]]\nkey = \"contact.gap\"\nfrom = 1e-4\nto = 1e-2\ncount = 5\nspacing = \"logarithmic\"\n"
      "[[parameters]]\nkey = \"forcing.amplitude\"\nfrom = 5e4\nto = 1e5\ncount = 3\n",
      "study.toml", bar_scene);
  const StudyRuns runs(study);
  std::vector<StudyRow> rows;
  for (std::int64_t run = 0; run < runs.size(); ++run)
    rows.push_back({.run = run,
                    .status = "converged",
                    .converged = true,
                    .seconds = 0.0,
                    .message = "",
                    .values = {Entry("max_displacement_m", 1e-3 * double(run))}});
  const Figure figure = study_figure(study, runs, study_table(study, runs, rows), "max_displacement_m");
  ASSERT_EQ(figure.panels.size(), 1u);
  const Panel& map = figure.panels.front();
  EXPECT_EQ(map.x.label, "contact.gap (mm)");
  EXPECT_EQ(map.x.tick_texts, (std::vector<std::string>{"0.1", "1", "10"}));
  ASSERT_EQ(map.x.ticks.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(map.x.ticks[std::size_t(i)], i - 1.0, 1e-12);
  EXPECT_EQ(map.y.label, "forcing.amplitude (kN)");
  EXPECT_NEAR(map.heat_map->y.back(), 100.0, 1e-9);
  EXPECT_NE(gnuplot_script(figure).find("set xtics ('0.1' -1"), std::string::npos) << gnuplot_script(figure);
}

}  // namespace

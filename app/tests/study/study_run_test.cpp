#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>

#include "support/scene_texts.hpp"
#include "temporary_folder.hpp"
#include "wavebalance/app/study/study.hpp"

namespace {

using namespace wavebalance::app;
using namespace std::chrono_literals;

/// The bar at `count` frequencies, with few elements and functions.
struct BarStudy {
  explicit BarStudy(int count)
      : study(parse_study(
            "set = [\"structure.elements=4\", \"time.functions=15\", \"time.quadrature_points=64\", \"analysis.phases=false\"]\n"
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

TEST(StudyRun, AStructureIsReducedOnceWhereItIsTheSame) {
  const Study study = load_study(strip_study());
  const StudyRuns runs(study);
  ASSERT_EQ(runs.size(), 8);
  LastStructure last;
  for (std::int64_t run = 0; run < runs.size(); ++run) {
    const StudyRow row = solve_run(study, runs, run, last);
    EXPECT_TRUE(row.converged) << row.message;
  }
  // Gaps, stiffnesses and frequencies are not the structure's; the damping, which varies slowest, is.
  EXPECT_EQ(last.made(), 2);
}

TEST(StudyRun, ARowIsOneLineOfItsJournal) {
  const std::string line = json_line(StudyRow{7, "stalled", false, 0.25, "a \"message\"\nof two lines", {}});
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_EQ(json_line(parse_row(line)), line);
}

/// Messages between threads instead of processes.
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
  const BarStudy bar(24);
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
  dying.send(0, "h2");  // it has two threads, accepts runs and never answers
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

}  // namespace

#include "wavebalance/app/study/study.hpp"

#include <fmt/format.h>

#include <set>

#include "study/study_workers.hpp"
#include "wavebalance/solvers/linalg/parallel_for.hpp"

namespace wavebalance::app {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

// Messages begin with a letter. A process sends h and its threads as it starts, r and a row, and a each
// second to be known as alive. Process 0 sends s and the number of a run to solve, a each second, and e to
// end.
constexpr char row_letter = 'r', hello_letter = 'h', alive_letter = 'a', solve_letter = 's', end_letter = 'e';

/// Data of process 0 about another one.
struct Remote {
  int threads = 0;  // 0 until it has said so
  std::set<std::int64_t> runs;
  Clock::time_point heard = Clock::now();
  bool lost = false;
};

/// Hands runs to the threads of this process and to other processes, and receives their rows.
class Distribution {
 public:
  Distribution(const Study& study, const StudyRuns& runs, const std::vector<std::int64_t>& todo,
               const StudyOptions& options, const RowSink& sink)
      : todo_(todo.begin(), todo.end()),
        open_(todo.begin(), todo.end()),
        total_(todo.size()),
        options_(options),
        sink_(sink),
        local_(study, runs, study.follow ? 1 : local_threads(options)) {
    if (options.messenger != nullptr)
      for (int rank = 1; rank < options.messenger->size(); ++rank) remotes_.try_emplace(rank);
  }

  StudyOutcome run(const solvers::Observer& observer) {
    const auto start = Clock::now();
    StudyOutcome outcome;
    while (!open_.empty()) {
      if (!goes_on(observer)) {
        outcome.stopped = true;
        break;
      }
      hand_out();
      take_messages();
      drop_silent();
      say_alive();
      for (const StudyRow& row : local_.finished(remotes_.empty() ? 50ms : look_interval(mean_seconds())))
        take(row);
    }
    end_others();
    outcome.workers = local_.threads();
    outcome.solved = std::int64_t(total_ - open_.size());
    for (const auto& [rank, remote] : remotes_) {
      outcome.workers += remote.threads;
      outcome.lost += remote.lost ? 1 : 0;
    }
    outcome.wall_seconds = std::chrono::duration<double>(Clock::now() - start).count();
    return outcome;
  }

 private:
  static int local_threads(const StudyOptions& options) {
    const bool one = options.messenger != nullptr && options.threads == 0;
    return one ? 1 : solvers::thread_count(options.threads);
  }

  bool goes_on(const solvers::Observer& observer) const {
    const std::size_t ended = total_ - open_.size();
    const std::string phase = fmt::format("study: {} of {} runs, {} not converged", ended, total_, failed_);
    return solvers::goes_on(
        observer, {phase, 0, std::numeric_limits<double>::quiet_NaN(), {}, double(ended) / double(total_)});
  }

  double mean_seconds() const { return ended_ == 0 ? 1.0 : seconds_ / static_cast<double>(ended_); }

  int ahead() const { return runs_ahead(mean_seconds(), todo_.size() < 2 * (remotes_.size() + 1)); }

  /// The next run that has no row yet; -1 if there is none.
  std::int64_t next_run() {
    while (!todo_.empty()) {
      const std::int64_t run = todo_.front();
      todo_.pop_front();
      if (open_.contains(run)) return run;
    }
    return -1;
  }

  void hand_out() {
    const auto most = [&](int threads) { return static_cast<std::size_t>(threads * ahead()); };
    for (auto& [rank, remote] : remotes_)
      while (!remote.lost && remote.runs.size() < most(remote.threads)) {
        const std::int64_t run = next_run();
        if (run < 0) return;
        remote.runs.insert(run);
        options_.messenger->send(rank, solve_letter + std::to_string(run));
      }
    while (local_.pending() < most(local_.threads())) {
      const std::int64_t run = next_run();
      if (run < 0) return;
      local_.add(run);
    }
  }

  void take(const StudyRow& row) {
    ++ended_;
    seconds_ += row.seconds;
    if (open_.erase(row.run) == 0) return;  // of a process that was thought dead
    failed_ += row.converged ? 0 : 1;
    sink_(row);
  }

  void take_messages() {
    if (options_.messenger == nullptr) return;
    while (const auto message = options_.messenger->receive()) {
      Remote& remote = remotes_.at(message->from);
      remote.heard = Clock::now();
      const char letter = message->text.empty() ? alive_letter : message->text.front();
      if (letter == hello_letter) remote.threads = std::stoi(message->text.substr(1));
      if (letter != row_letter) continue;
      const StudyRow row = parse_row(std::string_view(message->text).substr(1));
      remote.runs.erase(row.run);
      take(row);
    }
  }

  /// Gives the runs of processes that do not answer any more to others.
  void drop_silent() {
    for (auto& [rank, remote] : remotes_) {
      if (remote.lost || Clock::now() - remote.heard < options_.longest_silence) continue;
      remote.lost = true;
      options_.messenger->give_up(rank);
      todo_.insert(todo_.begin(), remote.runs.begin(), remote.runs.end());
      remote.runs.clear();
    }
  }

  void say_alive() {
    if (Clock::now() - told_ < 1s) return;
    told_ = Clock::now();
    for (const auto& [rank, remote] : remotes_)
      if (!remote.lost) options_.messenger->send(rank, std::string(1, alive_letter));
  }

  void end_others() {
    for (const auto& [rank, remote] : remotes_)
      if (!remote.lost) options_.messenger->send(rank, std::string(1, end_letter));
  }

  std::deque<std::int64_t> todo_;
  std::set<std::int64_t> open_;  // without a row
  std::size_t total_, failed_ = 0, ended_ = 0;
  double seconds_ = 0.0;
  Clock::time_point told_ = Clock::now();
  const StudyOptions& options_;
  const RowSink& sink_;
  std::map<int, Remote> remotes_;
  StudyWorkers local_;
};

}  // namespace

void StudyOptions::validate() const {
  solvers::thread_count(threads);
  if (longest_silence <= 1s)
    throw std::invalid_argument("StudyOptions: longest_silence must be more than a second");
}

StudyOutcome run_study(const Study& study, const StudyRuns& runs, const std::vector<std::int64_t>& todo,
                       const StudyOptions& options, const RowSink& sink, const solvers::Observer& observer) {
  options.validate();
  return Distribution(study, runs, todo, options, sink).run(observer);
}

void serve_study(const Study& study, const StudyRuns& runs, Messenger& messenger,
                 const StudyOptions& options) {
  options.validate();
  StudyWorkers workers(study, runs, std::max(1, options.threads));
  messenger.send(0, hello_letter + std::to_string(workers.threads()));
  auto told = Clock::now(), heard = told;
  double last_seconds = 0.0;
  while (Clock::now() - heard < options.longest_silence) {
    while (const auto message = messenger.receive()) {
      heard = Clock::now();
      if (message->text.front() == end_letter) return;
      if (message->text.front() == solve_letter) workers.add(std::stoll(message->text.substr(1)));
    }
    for (const StudyRow& row : workers.finished(look_interval(last_seconds))) {
      last_seconds = row.seconds;
      messenger.send(0, row_letter + json_line(row));
    }
    if (Clock::now() - told < 1s) continue;
    told = Clock::now();
    messenger.send(0, std::string(1, alive_letter));
  }
}

}  // namespace wavebalance::app

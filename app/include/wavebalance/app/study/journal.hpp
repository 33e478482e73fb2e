#pragma once
#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "wavebalance/app/study/study_row.hpp"

namespace wavebalance::app {

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

}  // namespace wavebalance::app

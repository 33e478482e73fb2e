#pragma once
#include <cstdint>
#include <string>
#include <string_view>

#include "wavebalance/app/files/summary.hpp"
#include "wavebalance/app/study/last_structure.hpp"
#include "wavebalance/app/study/study.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"

namespace wavebalance::app {

/// Result of one run of a study.
struct StudyRow {
  std::int64_t run = 0;  ///< from 0
  std::string status;    ///< of the record; "refused" or "failed" if there is none
  bool converged = false;
  double seconds = 0.0;  ///< wall time, with the scene's reading
  std::string message;   ///< why it was refused or failed; else the first warning of the record
  Summary values;        ///< numbers, truth values and texts of the record's summary
};

/// Solves a run. An error is a row, too: "refused" for a scene that is wrong or needs more memory than the
/// machine has, "failed" for any other. After an observer has returned false the row has no meaning.
StudyRow solve_run(const Study& study, const StudyRuns& runs, std::int64_t run,
                   const solvers::Observer& observer = {});
/// The same, reusing the reduced structure of the last run if it is equal. Equal digits.
StudyRow solve_run(const Study& study, const StudyRuns& runs, std::int64_t run, LastStructure& last,
                   const solvers::Observer& observer = {});

/// A row as JSON on one line without its end, with its run counted from 1.
std::string json_line(const StudyRow& row);
/// Reads json_line(). Throws std::invalid_argument if it is no such line.
StudyRow parse_row(std::string_view line);

}  // namespace wavebalance::app

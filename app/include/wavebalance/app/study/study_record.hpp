#pragma once
#include <string>
#include <vector>

#include "wavebalance/app/files/summary.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/app/study/study_runner.hpp"

namespace wavebalance::app {

/// The results of a study, ready to be written and shown.
struct StudyRecord {
  bool converged = false;  ///< all runs have ended and converged
  bool complete = false;   ///< all runs have ended
  std::vector<std::string> warnings;
  std::vector<std::string> changes;  ///< where limit cycles that follow one another appear, end, or change
  std::string status;  ///< "converged", "not_converged" if a run did not, "interrupted" if runs are left
  Summary summary;
  Table table;  ///< study.csv and study.npz, see study_table()
  std::vector<RecordPicture> pictures;
};

/// run from 1, the parameters by their keys, status, converged, seconds, the values of the summaries, and
/// message; a row per run, in their order. Missing values are NaN, or "" in a column of texts.
Table study_table(const Study& study, const StudyRuns& runs, const std::vector<StudyRow>& rows);

/// quantity, runs, mean, min, q05, q25, median, q75, q95, max of the converged rows of all columns of numbers
/// that are not the same in all of them. Quantiles interpolate linearly between ordered values (type 7 of
/// R. J. Hyndman and Y. Fan, The American Statistician 50 (1996) 361-365).
Table quantiles_table(const Study& study, const Table& table);

/// status, runs: how often each occurred, the most frequent first.
Table statuses_table(const Table& table);

/// The name of the column that pictures show: study.quantity if there is such a column, max_displacement_m,
/// or the first column of numbers of the summaries; empty without any.
std::string drawn_quantity(const Study& study, const Table& table);

/// A response map of a grid over its two parameters of numbers, curves over one, and of samples the
/// distribution and the values over each parameter; without panels if nothing can be drawn.
Figure study_figure(const Study& study, const StudyRuns& runs, const Table& table,
                    const std::string& quantity);

/// All results of a study whose `rows` have ended, in any order; `unreadable_lines` counts lines of its
/// journal.
StudyRecord study_record(const Study& study, const StudyRuns& runs, std::vector<StudyRow> rows,
                         const StudyOutcome& outcome, std::int64_t unreadable_lines = 0);

}  // namespace wavebalance::app

#pragma once
#include <string>

#include "report/arguments.hpp"
#include "report/run_record.hpp"
#include "report/run_report.hpp"
#include "wavebalance/app/study/study_record.hpp"

namespace wavebalance::app {

/// The files of a study. Its page has the numbers of runs by status, quantiles of all quantities, and the
/// runs that did not converge with the command that repeats one. Without gnuplot there is no picture.
RunFiles study_files(const StudyArguments& arguments, const Study& study, const StudyRecord& record);

/// The files that a study reads: its own, the scene, and those that the first run names.
InputFiles inputs_of(const StudyArguments& arguments, const Study& study, const StudyRuns& runs);

/// require_replaceable() for the files of a study, before anything is solved.
void check_study_output(const StudyArguments& arguments, const InputFiles& inputs);

/// The same outcome in a few lines for a terminal.
std::string study_outcome(const StudyRecord& record);

}  // namespace wavebalance::app

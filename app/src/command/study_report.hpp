#pragma once
#include <string>
#include <vector>

#include "command/run_report.hpp"
#include "command/study_command.hpp"
#include "wavebalance/app/study/study_record.hpp"

namespace wavebalance::app {

/// report.html of a study: how many runs ended how, the picture, quantiles of all quantities, runs that did
/// not converge with the command that repeats one, what was asked, and all values and files.
std::string study_report(const StudyArguments& arguments, const Study& study, const StudyRecord& record,
                         const Summary& summary, const std::vector<ResultFile>& files);

/// The same outcome in a few lines for a terminal.
std::string study_outcome(const StudyRecord& record);

}  // namespace wavebalance::app

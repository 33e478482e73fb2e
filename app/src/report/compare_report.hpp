#pragma once
#include <string>
#include <vector>

#include "report/arguments.hpp"
#include "report/run_report.hpp"
#include "wavebalance/app/compare/comparison_record.hpp"

namespace wavebalance::app {

/// report.html of a comparison: what to take with the [time] tables to paste, the pictures with curves that
/// zoom, how each pair did and what failed, the reference with its stability, warnings, the command, and all
/// values and files. Like that of a run it holds all that it shows.
std::string comparison_report(const CompareArguments& arguments, const Scene& scene,
                              const ComparisonRecord& record, const Summary& summary,
                              const std::vector<RecordFile>& files);

}  // namespace wavebalance::app

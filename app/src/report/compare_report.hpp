#pragma once
#include <string>
#include <vector>

#include "report/arguments.hpp"
#include "report/run_report.hpp"
#include "wavebalance/app/compare/comparison_record.hpp"

namespace wavebalance::app {

/// report.html of a comparison: recommendation with [time] tables to paste, pictures with curves that zoom,
/// results and failures of each pair, reference with its stability, warnings, command, all values and
/// files. The page is self-contained.
std::string comparison_report(const CompareArguments& arguments, const Scene& scene,
                              const ComparisonRecord& record, const Summary& summary,
                              const std::vector<RecordFile>& files);

}  // namespace wavebalance::app

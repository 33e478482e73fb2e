#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "wavebalance/app/files/table.hpp"

namespace wavebalance::app {

/// A Table is written as an array of objects, one per row.
using SummaryValue = std::variant<double, std::int64_t, bool, std::string, std::vector<double>,
                                  std::vector<std::string>, Table>;
using Summary = std::vector<std::pair<std::string, SummaryValue>>;

/// `summary` as a JSON object in its order; numbers that are not finite become null.
std::string json_text(const Summary& summary);

/// The numbers, truth values and texts of a summary.json, in its order; null as NaN, lists and tables left
/// out. Empty if there is no such file. Throws IoError if it is no JSON object.
Summary read_summary(const std::filesystem::path& file);

/// The names in `files` of a summary.json that an earlier run wrote, and "summary.json" itself; names that
/// are no plain file names are left out. Empty if there is no such file or it is no record of this program.
std::vector<std::string> files_of_record(const std::filesystem::path& summary);

}  // namespace wavebalance::app

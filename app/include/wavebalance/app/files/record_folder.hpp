#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace wavebalance::app {

/// Throws IoError if writing a record into `folder` would replace a file that is not this program's to
/// replace: one that `writes` accepts by its name and that no summary.json of this program in the folder
/// lists, or one of `inputs`, which the same command reads. Links are followed. O(files in the folder x
/// inputs).
void require_replaceable(const std::filesystem::path& folder,
                         const std::function<bool(const std::string&)>& writes,
                         const std::vector<std::filesystem::path>& inputs);

}  // namespace wavebalance::app

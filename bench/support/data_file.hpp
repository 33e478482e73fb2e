#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "wavebalance/app/files/table.hpp"

namespace wavebalance::bench {

/// What a table holds, for a reader of the file alone.
struct DataNotes {
  std::string title;               ///< one sentence
  std::string units;               ///< "SI; a column's name ends in its unit"
  std::string scenes;              ///< where the scenes are, or empty
  std::vector<std::string> notes;  ///< further sentences
};

/// Writes folder/stem.csv, and folder/stem.json with `notes`, the project's version beside them. Throws
/// app::IoError.
void write_data(const std::filesystem::path& folder, const std::string& stem, const app::Table& table,
                const DataNotes& notes);

}  // namespace wavebalance::bench

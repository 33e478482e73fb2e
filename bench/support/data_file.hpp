#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "wavebalance/app/files/table.hpp"

namespace wavebalance::bench {

/// Content of a table, for readers of the file.
struct DataNotes {
  std::string title;               ///< one sentence
  std::string units;               ///< "SI; a column's name ends in its unit"
  std::string scenes;              ///< where the scenes are, or empty
  std::vector<std::string> notes;  ///< further sentences
};

/// Writes folder/stem.csv, and folder/stem.json with `notes` and the project's version. Throws
/// app::IoError.
void write_data(const std::filesystem::path& folder, const std::string& stem, const app::Table& table,
                const DataNotes& notes);

}  // namespace wavebalance::bench

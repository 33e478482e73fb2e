#pragma once
#include <pybind11/pybind11.h>

#include "wavebalance/app/files/summary.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::python {

/// Where a scene comes from, and its changes.
struct SceneSource {
  std::string text;  ///< TOML; empty: read from the file `name`
  std::string name;  ///< of the file, in messages too; its paths are relative to that folder
  std::vector<std::string> overrides;  ///< "section.key=value"
  std::vector<std::string> removed;    ///< "section.key"
  bool temporary = false;              ///< it names files that are gone once it has been used
};

/// The scene, complete and within range. Throws app::SceneError.
app::Scene scene_of(const SceneSource& source);

/// A dictionary of the columns in their order: arrays of numbers (float64) if a column has only numbers and
/// truth values, else lists of text. O(cells).
pybind11::dict columns_of(const app::Table& table);

/// A dictionary of the values in their order; a table is a dictionary of its columns.
pybind11::dict dictionary_of(const app::Summary& summary);

}  // namespace wavebalance::python

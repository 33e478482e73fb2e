#pragma once
#include <pybind11/pybind11.h>

#include "wavebalance/app/files/summary.hpp"
#include "wavebalance/app/files/table.hpp"

namespace wavebalance::python {

/// A dictionary of the columns in their order: arrays of numbers (float64) if a column has only numbers and
/// truth values, else lists of text. O(cells).
pybind11::dict columns_of(const app::Table& table);

/// A dictionary of the values in their order; a table is a dictionary of its columns.
pybind11::dict dictionary_of(const app::Summary& summary);

}  // namespace wavebalance::python

#pragma once
#include <string>

#include "wavebalance/app/files/table.hpp"

namespace wavebalance::app {

/// The columns of a table as the arrays of an .npz file, which numpy.load() reads: bool, int64, float64 with
/// NaN for what is missing, or text of fixed width. It is a ZIP archive without compression (PKWARE
/// APPNOTE 6.3) of files in the NPY format 1.0 (NEP 1); equal tables give equal bytes. Throws
/// std::length_error if an array or the archive would exceed 4 GB.
std::string npz_text(const Table& table);

}  // namespace wavebalance::app

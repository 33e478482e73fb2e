#pragma once

#include "wavebalance/app/files/table.hpp"

namespace wavebalance::app {

inline constexpr std::size_t max_table_bytes = std::size_t{1} << 28;

/// A CSV file with the column frequency_Hz, in Hz and ascending, a `column` of numbers and perhaps others.
/// Throws std::runtime_error that names the file where it cannot be read, has no such columns, fewer than two
/// rows or an entry that is no finite number.
Table read_frequency_table(const std::string& file, std::string_view column, std::string_view optional = {});

/// Throws std::runtime_error where frequencies, ascending, do not hold all of an interval (Hz, either way).
void require_frequencies(const std::string& file, const std::vector<double>& frequencies, double from,
                         double to);

}  // namespace wavebalance::app

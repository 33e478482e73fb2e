#include "files/frequency_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace wavebalance::app {

Table read_frequency_table(const std::string& file, std::string_view column, std::string_view optional) {
  Table table = read_csv(file, max_table_bytes);
  const std::string more = optional.empty() ? "" : fmt::format(" and, if wanted, {}", optional);
  const bool has_both = table.has_column("frequency_Hz") && table.has_column(column);
  if (!has_both)
    throw std::runtime_error(
        fmt::format("{}: expected the columns frequency_Hz{} {}{}, of which one is not there", file,
                    more.empty() ? " and" : ",", column, more));
  if (table.rows() < 2)
    throw std::runtime_error(fmt::format("{}: there are {} rows; expected at least 2", file, table.rows()));
  const std::vector<double> frequencies = table.numbers("frequency_Hz");
  for (const std::string_view name : {std::string_view("frequency_Hz"), column, optional}) {
    if (name.empty() || !table.has_column(name)) continue;
    const std::vector<double> values = table.numbers(name);
    for (std::size_t i = 0; i < values.size(); ++i)
      if (!std::isfinite(values[i]))
        throw std::runtime_error(fmt::format("{}: {} of row {} is no finite number", file, name, i + 1));
  }
  for (std::size_t i = 1; i < frequencies.size(); ++i)
    if (!(frequencies[i] > frequencies[i - 1]))
      throw std::runtime_error(fmt::format("{}: frequency_Hz = {} of row {} is not above the row before",
                                           file, frequencies[i], i + 1));
  return table;
}

void require_frequencies(const std::string& file, const std::vector<double>& frequencies, double from,
                         double to) {
  if (std::min(from, to) >= frequencies.front() && std::max(from, to) <= frequencies.back()) return;
  throw std::runtime_error(
      fmt::format("{} has rows from {} to {} Hz; expected all frequencies of the scene, {} to {} Hz", file,
                  frequencies.front(), frequencies.back(), std::min(from, to), std::max(from, to)));
}

}  // namespace wavebalance::app

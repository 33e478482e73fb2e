#include "wavebalance/app/files/summary.hpp"

#include <algorithm>

#include "files/missing.hpp"

namespace wavebalance::app {

const Entry* find_entry(const Summary& summary, std::string_view name) {
  const auto found = std::ranges::find(summary, name, &Entry::name);
  return found == summary.end() ? nullptr : &*found;
}

Entry* find_entry(Summary& summary, std::string_view name) {
  return const_cast<Entry*>(find_entry(std::as_const(summary), name));
}

double number_in(const Summary& summary, const Quantity& quantity) {
  if (const auto* number = value_in<double>(summary, quantity.name)) return *number;
  if (const auto* count = value_in<std::int64_t>(summary, quantity.name)) return static_cast<double>(*count);
  return missing;
}

std::string text_in(const Summary& summary, const Quantity& quantity) {
  const auto* text = value_in<std::string>(summary, quantity.name);
  return text == nullptr ? "" : *text;
}

std::vector<std::string> columns_of(const Summary& row) {
  std::vector<std::string> columns;
  for (const Entry& one : row) columns.push_back(one.name);
  return columns;
}

std::vector<Cell> cells_of(const Summary& row) {
  std::vector<Cell> cells;
  for (const Entry& one : row) cells.push_back(cell_of(one.value));
  return cells;
}

Table table_of(const std::vector<Summary>& rows) {
  if (rows.empty()) return {};
  Table table(columns_of(rows.front()));
  for (const Summary& row : rows) table.append_row(cells_of(row));
  return table;
}

Cell cell_of(const SummaryValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* count = std::get_if<std::int64_t>(&value)) return *count;
  if (const auto* truth = std::get_if<bool>(&value)) return *truth;
  return std::get<std::string>(value);
}

}  // namespace wavebalance::app

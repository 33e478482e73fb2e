#include "wavebalance/app/files/table.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "files/contains.hpp"
#include "files/number_text.hpp"

namespace wavebalance::app {
namespace {

double cell_number(const Cell& cell, std::string_view column) {
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*integer);
  if (const auto* truth = std::get_if<bool>(&cell)) return *truth ? 1.0 : 0.0;
  throw std::invalid_argument("Table::numbers: column " + std::string(column) + " holds the text \"" +
                              std::get<std::string>(cell) + "\"; it must hold numbers");
}

}  // namespace

std::string cell_text(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return number_text(*number);
  if (const auto* integer = std::get_if<std::int64_t>(&cell)) return std::to_string(*integer);
  if (const auto* truth = std::get_if<bool>(&cell)) return *truth ? "true" : "false";
  return std::get<std::string>(cell);
}

Table::Table(std::vector<std::string> columns) : names_(std::move(columns)) {}

Table& Table::add_column(std::string name, std::span<const double> values) {
  if (has_column(name))
    throw std::invalid_argument("Table::add_column: there is a column " + name + " already");
  if (!names_.empty() && values.size() != rows_.size())
    throw std::invalid_argument(
        fmt::format("Table::add_column: column {} has {} values; it must have {} like the others", name,
                    values.size(), rows_.size()));
  if (names_.empty()) rows_.resize(values.size());
  names_.push_back(std::move(name));
  for (std::size_t i = 0; i < values.size(); ++i) rows_[i].emplace_back(values[i]);
  return *this;
}

void Table::append_row(std::vector<Cell> row) {
  if (row.size() != names_.size())
    throw std::invalid_argument(
        fmt::format("Table::append_row: the row has {} cells; it must have {}", row.size(), names_.size()));
  rows_.push_back(std::move(row));
}

bool Table::has_column(std::string_view name) const { return contains(names_, name); }

std::size_t Table::index_of(std::string_view column) const {
  const auto found = std::ranges::find(names_, column);
  if (found == names_.end()) throw std::out_of_range("Table: no column " + std::string(column));
  return static_cast<std::size_t>(found - names_.begin());
}

const Cell& Table::at(std::size_t row, std::string_view column) const {
  const std::size_t index = index_of(column);
  if (row >= rows_.size()) throw std::out_of_range(fmt::format("Table: row {} of {}", row, rows_.size()));
  return rows_[row][index];
}

std::vector<double> Table::numbers(std::string_view column) const {
  const std::size_t index = index_of(column);
  std::vector<double> result;
  result.reserve(rows_.size());
  for (const auto& row : rows_) result.push_back(cell_number(row[index], column));
  return result;
}

std::vector<std::string> Table::texts(std::string_view column) const {
  const std::size_t index = index_of(column);
  std::vector<std::string> result;
  result.reserve(rows_.size());
  for (const auto& row : rows_) result.push_back(cell_text(row[index]));
  return result;
}

Table Table::where(std::string_view column, std::string_view value) const {
  const std::size_t index = index_of(column);
  Table result(names_);
  for (const auto& row : rows_)
    if (cell_text(row[index]) == value) result.append_row(row);
  return result;
}

}  // namespace wavebalance::app

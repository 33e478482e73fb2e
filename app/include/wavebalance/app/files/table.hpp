#pragma once
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace wavebalance::app {

/// One value of a table or of a summary.
using Cell = std::variant<double, std::int64_t, bool, std::string>;

/// A value as tables and summaries hold it: whole numbers of any width as std::int64_t, texts as std::string.
template <class Value>
auto stored_value(Value&& value) {
  using Plain = std::remove_cvref_t<Value>;
  if constexpr (std::is_integral_v<Plain> && !std::is_same_v<Plain, bool>)
    return static_cast<std::int64_t>(value);
  else if constexpr (std::is_convertible_v<Value, std::string_view>)
    return std::string(std::string_view(value));
  else
    return Plain(std::forward<Value>(value));
}

/// The cells of a row.
template <class... Values>
std::vector<Cell> row_of(Values&&... values) {
  return {Cell(stored_value(std::forward<Values>(values)))...};
}

/// Anything that holds doubles together: std::vector<double>, Eigen::VectorXd, std::span<const double>.
template <class Range>
concept DoubleArray = requires(const Range& range) {
  { range.data() } -> std::convertible_to<const double*>;
  { range.size() } -> std::convertible_to<std::ptrdiff_t>;
};

template <DoubleArray Range>
std::span<const double> as_span(const Range& range) {
  return {range.data(), static_cast<std::size_t>(range.size())};
}

/// Named columns of one length, filled by columns or by rows. Missing numbers are NaN.
///
///     Table table;
///     table.add_column("time_fraction", t).add_column("displacement_m", u);
///
///     Table errors({"case", "trial", "functions", "rms_relative_error", "converged"});
///     errors.append_row({1, "haar", 64, 0.0123, true});
class Table {
 public:
  Table() = default;
  /// An empty table with these columns.
  explicit Table(std::vector<std::string> columns);

  /// Throws std::invalid_argument if the length differs from other columns or the name exists.
  Table& add_column(std::string name, std::span<const double> values);
  template <DoubleArray Range>
  Table& add_column(std::string name, const Range& values) {
    return add_column(std::move(name), as_span(values));
  }
  /// Throws std::invalid_argument if the number of cells differs from the number of columns.
  void append_row(std::vector<Cell> row);

  const std::vector<std::string>& columns() const { return names_; }
  std::size_t rows() const { return rows_.size(); }
  bool empty() const { return rows_.empty(); }
  bool has_column(std::string_view name) const;
  /// Throws std::out_of_range naming the column or the row.
  const Cell& at(std::size_t row, std::string_view column) const;
  const std::vector<Cell>& row(std::size_t index) const { return rows_.at(index); }
  /// A column as numbers, true as 1 and false as 0. Throws std::invalid_argument if it holds text.
  std::vector<double> numbers(std::string_view column) const;
  /// A column as text; numbers as the shortest text that reads back equal.
  std::vector<std::string> texts(std::string_view column) const;
  /// The rows whose `column` reads `value`.
  Table where(std::string_view column, std::string_view value) const;

 private:
  std::size_t index_of(std::string_view column) const;

  std::vector<std::string> names_;
  std::vector<std::vector<Cell>> rows_;
};

/// A cell as a CSV file and a table of a report show it.
std::string cell_text(const Cell& cell);

/// CSV (RFC 4180): the first line names the columns, a line per row follows. Numbers are the shortest that
/// read back equal; missing ones are "nan".
std::string csv_text(const Table& table);
/// Writes csv_text(table) atomically. Throws IoError.
void write_csv(const std::filesystem::path& file, const Table& table);

/// Reads what write_csv() wrote: cells that read as numbers are numbers, "true" and "false" truth values.
/// Throws IoError with the line of a malformed row, and for a file of more than `max_bytes`.
Table read_csv(const std::filesystem::path& file,
               std::size_t max_bytes = std::numeric_limits<std::size_t>::max());

}  // namespace wavebalance::app

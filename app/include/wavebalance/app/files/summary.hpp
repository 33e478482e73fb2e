#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "wavebalance/app/files/table.hpp"

namespace wavebalance::app {

/// A Table is written as an array of objects, one per row.
using SummaryValue = std::variant<double, std::int64_t, bool, std::string, std::vector<double>,
                                  std::vector<std::string>, Table>;

/// The subject of a value of a summary.
enum class EntryKind {
  heading,     ///< which analysis it is, how it ended and how long it took
  setting,     ///< the scene: its bases, sizes and frequency
  diagnostic,  ///< the solution: its residual, its effort, its stability in a word
  result,      ///< the motion or the curve; without a meaning where the solution did not converge
};

/// Properties of a value, by its name. Texts are literals.
struct Quantity {
  std::string_view name;  ///< of its entry in summary.json and of its columns: "max_displacement_m"
  EntryKind kind = EntryKind::diagnostic;
  std::string_view unit = "";   ///< "m"; empty for words, counts and ratios
  std::string_view words = "";  ///< "max displacement", as pictures call it; empty where they show the name

  std::string column() const { return std::string(name); }
};

/// A named value with what is known of it.
struct Entry {
  template <class Value>
  Entry(std::string its_name, Value&& its_value)
      : name(std::move(its_name)), value(stored_value(std::forward<Value>(its_value))) {}
  template <class Value>
  Entry(const Quantity& quantity, Value&& its_value)
      : name(quantity.name),
        value(stored_value(std::forward<Value>(its_value))),
        kind(quantity.kind),
        unit(quantity.unit),
        words(quantity.words) {}

  /// Whether it is one number, truth value or text.
  bool scalar() const { return value.index() < 4; }

  std::string name;
  SummaryValue value;
  EntryKind kind = EntryKind::diagnostic;
  std::string_view unit, words;  ///< of its Quantity
};

using Summary = std::vector<Entry>;

/// The entry of a name; null if there is none.
const Entry* find_entry(const Summary& summary, std::string_view name);
Entry* find_entry(Summary& summary, std::string_view name);

/// The value of a name, if it is of this type; else null.
template <class Value>
const Value* value_in(const Summary& summary, std::string_view name) {
  const Entry* entry = find_entry(summary, name);
  return entry == nullptr ? nullptr : std::get_if<Value>(&entry->value);
}

/// A number or a count; NaN if there is none.
double number_in(const Summary& summary, const Quantity& quantity);
/// A text; empty if there is none.
std::string text_in(const Summary& summary, const Quantity& quantity);

/// A row of a table of named scalars: its columns, and its cells.
std::vector<std::string> columns_of(const Summary& row);
std::vector<Cell> cells_of(const Summary& row);
/// Rows with the same names; without columns if there are none.
Table table_of(const std::vector<Summary>& rows);
/// The rows of items, one for each; without items the columns of an item without values.
template <class Items, class RowOf>
Table tabulated(const Items& items, RowOf row_of) {
  std::vector<Summary> rows;
  for (const auto& item : items) rows.push_back(row_of(item));
  return rows.empty() ? Table(columns_of(row_of(typename Items::value_type{}))) : table_of(rows);
}
/// A scalar as a cell.
Cell cell_of(const SummaryValue& value);

/// `summary` as a JSON object in its order; numbers that are not finite become null.
std::string json_text(const Summary& summary);

/// The numbers, truth values and texts of a summary.json, in its order; null as NaN, lists and tables left
/// out. Empty if there is no such file. Throws IoError if it is no JSON object.
Summary read_summary(const std::filesystem::path& file);

/// The names in `files` of a summary.json that an earlier run wrote, and "summary.json" itself; names that
/// are no plain file names are left out. Empty if there is no such file or it is no record of this program.
std::vector<std::string> files_of_record(const std::filesystem::path& summary);

}  // namespace wavebalance::app

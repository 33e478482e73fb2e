#include <charconv>
#include <sstream>

#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/table.hpp"

namespace wavebalance::app {
namespace {

std::string quoted_if_needed(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

using Fields = std::vector<std::pair<std::string, bool>>;  // text, and whether it stood in quotes

/// The fields of one line; quotes may enclose commas, not line ends. False if a quote is left open.
bool split(const std::string& line, Fields& fields) {
  fields.assign(1, {"", false});
  bool inside = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && inside && i + 1 < line.size() && line[i + 1] == '"') {
      fields.back().first += line[++i];
    } else if (c == '"') {
      inside = !inside;
      fields.back().second = true;
    } else if (c == ',' && !inside) {
      fields.emplace_back("", false);
    } else {
      fields.back().first += c;
    }
  }
  return !inside;
}

Cell parsed_cell(const std::string& text, bool was_quoted) {
  if (was_quoted) return text;
  if (text == "true" || text == "false") return text == "true";
  const char* end = text.data() + text.size();
  std::int64_t integer = 0;
  if (const auto result = std::from_chars(text.data(), end, integer);
      result.ec == std::errc{} && result.ptr == end)
    return integer;
  double number = 0.0;
  if (const auto result = std::from_chars(text.data(), end, number);
      result.ec == std::errc{} && result.ptr == end)
    return number;
  return text;
}

class CsvReader {
 public:
  CsvReader(const std::filesystem::path& file, std::size_t max_bytes)
      : file_(file), stream_(read_file(file, max_bytes)) {}

  Table read() {
    Fields fields;
    if (!next(fields)) throw IoError(file_, "holds no line of column names");
    std::vector<std::string> names;
    for (const auto& field : fields) names.push_back(field.first);
    Table table(names);
    while (next(fields)) {
      if (fields.size() != names.size())
        fail(std::to_string(fields.size()) + " cells; expected " + std::to_string(names.size()) +
             ", as in the first line (a comma separates cells; decimals take a point)");
      std::vector<Cell> row;
      for (const auto& [text, was_quoted] : fields) row.push_back(parsed_cell(text, was_quoted));
      table.append_row(std::move(row));
    }
    return table;
  }

 private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw IoError(file_, "line " + std::to_string(number_) + ": " + reason);
  }

  /// The next line that is not empty.
  bool next(Fields& fields) {
    for (std::string line; std::getline(stream_, line);) {
      ++number_;
      if (line.empty()) continue;
      if (!split(line, fields)) fail("a quote is not closed");
      return true;
    }
    return false;
  }

  std::filesystem::path file_;
  std::istringstream stream_;
  int number_ = 0;
};

void append_line(std::string& text, const std::vector<std::string>& cells) {
  for (std::size_t j = 0; j < cells.size(); ++j) {
    if (j > 0) text += ',';
    text += cells[j];
  }
  text += '\n';
}

std::string csv_cell(const Cell& cell) {
  const auto* text = std::get_if<std::string>(&cell);
  return text != nullptr ? quoted_if_needed(*text) : cell_text(cell);
}

}  // namespace

std::string csv_text(const Table& table) {
  std::string text;
  std::vector<std::string> cells;
  for (const auto& name : table.columns()) cells.push_back(quoted_if_needed(name));
  append_line(text, cells);
  for (std::size_t i = 0; i < table.rows(); ++i) {
    cells.clear();
    for (const Cell& cell : table.row(i)) cells.push_back(csv_cell(cell));
    append_line(text, cells);
  }
  return text;
}

void write_csv(const std::filesystem::path& file, const Table& table) { write_file(file, csv_text(table)); }

Table read_csv(const std::filesystem::path& file, std::size_t max_bytes) {
  return CsvReader(file, max_bytes).read();
}

}  // namespace wavebalance::app

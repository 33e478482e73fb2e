#include "output4.hpp"

#include "entries.hpp"

namespace wavebalance::fem {
namespace detail {
namespace {

/// Reads the matrices of a source one after the other.
class Output4Reader {
 public:
  Output4Reader(Output4Source& source, const std::string& file, std::string_view wanted)
      : source_(source), file_(file), wanted_(lower(wanted)) {}

  std::vector<NamedMatrix> read() {
    std::vector<NamedMatrix> found;
    while (const auto header = source_.header()) {
      header_ = *header;
      wants_ = wanted_.empty() || lower(header_.name) == wanted_;
      check_header();
      entries_.clear();
      read_columns();
      if (wants_)
        found.push_back(matrix());
      else
        found.push_back({header_.name, {}, {}, false});
    }
    if (found.empty()) source_.fail("there is no matrix");
    return found;
  }

 private:
  [[noreturn]] void fail(const std::string& what, long long found, const std::string& allowed) const {
    source_.fail(what, " of ", header_.name, " is ", found, "; it must be ", allowed);
  }

  void check_header() const {
    const auto side = [&](long long size, const char* what) {
      if (size < 1 || size > largest_side) fail(what, size, "in 1.." + std::to_string(largest_side));
    };
    side(header_.columns, "the number of columns");
    side(header_.rows, "the number of rows");
    if (header_.type < 1 || header_.type > 4) fail("the type", header_.type, "1 or 2, real");
    if (!wants_) return;
    if (header_.is_complex())
      source_.fail("the type of ", header_.name, " is ", header_.type, ", complex; it must be 1 or 2, real");
    const long long form = header_.form;
    if (form != 1 && form != 2 && form != 6 && form != 9)
      fail("the form", form, "1 (square), 6 (symmetric), 2 or 9 (rectangular)");
    if ((form == 1 || form == 6) && header_.rows != header_.columns)
      source_.fail(header_.name, " is ", header_.rows, " x ", header_.columns, "; the form ", form,
                   " must be square");
  }

  void read_columns() {
    for (long long last = 0;;) {
      const Output4Column column = source_.column();
      if (column.number == header_.columns + 1) return source_.end_matrix();
      if (column.number <= last || column.number > header_.columns)
        fail("a column", column.number,
             "in " + std::to_string(last + 1) + ".." + std::to_string(header_.columns + 1));
      last = column.number;
      if (column.row > 0)
        read_values(column.number, column.row, column.words, true);
      else
        read_strings(column);
    }
  }

  void read_strings(const Output4Column& column) {
    const int opening = header_.big ? 2 : 1;  // words
    for (long long left = column.words; left > 0;) {
      const Output4String string = source_.string(header_.big);
      if (string.words < 1 || string.words + opening > left)
        fail("the number of words of a string", string.words,
             "in 1.." + std::to_string(left - opening) + ", what its column has left");
      read_values(column.number, string.row, string.words, false);
      left -= string.words + opening;
    }
  }

  void read_values(long long column, long long row, long long words, bool dense) {
    const int each = source_.words(header_.type, dense);
    const long long count = words / each;
    if (words < 1 || words % each != 0)
      fail("the number of words in column " + std::to_string(column), words,
           "a multiple of " + std::to_string(each));
    if (row < 1 || row + count - 1 > header_.rows)
      fail("the last row in column " + std::to_string(column), row + count - 1,
           "in 1.." + std::to_string(header_.rows));
    for (long long i = 0; i < count; ++i) {
      const double value = source_.value();
      if (header_.is_complex()) source_.value();
      if (!wants_ || value == 0.0) continue;
      if (!std::isfinite(value)) source_.fail("a value of ", header_.name, " is not finite");
      entries_.emplace_back(static_cast<int>(row + i - 1), static_cast<int>(column - 1), value);
    }
  }

  NamedMatrix matrix() {
    const auto name = [this](int row, int column) { return place_text(row, column) + " of " + header_.name; };
    const bool square = header_.rows == header_.columns;
    return {header_.name,
            matrix_of(std::move(entries_), static_cast<int>(header_.rows), static_cast<int>(header_.columns),
                      header_.form == 6, file_, name),
            {},
            !square};
  }

  Output4Source& source_;
  const std::string& file_;
  std::string wanted_;
  Output4Header header_;
  bool wants_ = true;
  MatrixEntries entries_;
};

}  // namespace

std::vector<NamedMatrix> read_output4(Output4Source& source, const std::string& file,
                                      std::string_view wanted) {
  return Output4Reader(source, file, wanted).read();
}

}  // namespace detail

std::vector<NamedMatrix> read_output4(std::istream& input, const std::string& name, std::string_view wanted) {
  return detail::is_output4_binary(input) ? detail::read_output4_binary(input, name, wanted)
                                          : detail::read_output4_text(input, name, wanted);
}

}  // namespace wavebalance::fem

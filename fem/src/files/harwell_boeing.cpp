#include "formats.hpp"

#include "entries.hpp"
#include "text_parts.hpp"
#include "wavebalance/fem/matrix_file.hpp"

namespace wavebalance::fem {
namespace {

using detail::FortranFormat;
using detail::Lines;

struct HarwellBoeingHeader {
  std::string title;
  bool symmetric = false;
  int rows = 0;
  int entries = 0;
  FortranFormat pointers, indices, values;
  std::string load_type;  ///< F for a full vector; empty without right-hand sides
  int loads = 0;
  std::optional<FortranFormat> load_values;
};

int counted(const Lines& lines, std::size_t word, const char* what, int most) {
  if (lines.words().size() <= word) lines.fail(what, " is missing");
  const int count = lines.number<int>(word, what);
  if (count < 1 || count > most) lines.fail(what, " is ", count, "; it must be in 1..", most);
  return count;
}

void next_line(Lines& lines, const char* what) {
  if (!lines.next()) lines.fail("the file ends before ", what);
}

void read_type(Lines& lines, HarwellBoeingHeader& header) {
  next_line(lines, "the line of the matrix type");
  const std::string type = lines.words().empty() ? "" : detail::lower(lines.words()[0]);
  if (type != "rsa" && type != "rua")
    lines.fail("the type of the matrix is \"", type,
               "\"; it must be RSA (real, symmetric, assembled) or RUA (real, unsymmetric, assembled)");
  header.symmetric = type == "rsa";
  header.rows = counted(lines, 1, "the number of rows", detail::largest_side);
  const int columns = counted(lines, 2, "the number of columns", detail::largest_side);
  if (columns != header.rows)
    lines.fail("the matrix is ", header.rows, " x ", columns, "; it must be square");
  header.entries = counted(lines, 3, "the number of entries", std::numeric_limits<int>::max() - 1);
}

FortranFormat read_format(const Lines& lines, std::string_view& rest, const char* what, bool real) {
  const std::string_view text = detail::next_parentheses(rest);
  const auto format = detail::fortran_format(text);
  if (!format || format->real() != real)
    lines.fail("the format of the ", what, " is \"", text, "\"; it must be a Fortran format such as ",
               (real ? "(4D20.12), (3E26.18), (1P,5E16.8) or (4F20.8)" : "(10I8) or (1I14)"));
  return *format;
}

HarwellBoeingHeader read_header_of_harwell_boeing(Lines& lines) {
  HarwellBoeingHeader header;
  constexpr std::size_t title_width = 72;  // a key follows
  next_line(lines, "its title");
  header.title = detail::trimmed(std::string_view(lines.text()).substr(0, title_width));
  next_line(lines, "the line of counts");
  constexpr std::size_t right_hand_sides = 4;
  const bool loaded = lines.words().size() > right_hand_sides &&
                      lines.number<int>(right_hand_sides, "the count of lines of right-hand sides") > 0;
  read_type(lines, header);
  next_line(lines, "the line of formats");
  std::string_view rest = lines.text();
  header.pointers = read_format(lines, rest, "pointers", false);
  header.indices = read_format(lines, rest, "row indices", false);
  header.values = read_format(lines, rest, "values", true);
  if (loaded) {
    header.load_values = detail::fortran_format(detail::next_parentheses(rest));
    next_line(lines, "the line of right-hand sides");
    header.load_type = lines.words().empty() ? "" : detail::lower(lines.words()[0]);
    header.loads = counted(lines, 1, "the number of right-hand sides", std::numeric_limits<int>::max());
  }
  return header;
}

/// Calls use(field) for `count` fields of a format. The first one opens a line.
template <class Use>
void for_each_field(Lines& lines, const FortranFormat& format, int count, const char* what, Use use) {
  const auto width = static_cast<std::size_t>(format.width);
  for (int found = 0; found < count;) {
    if (!lines.next()) lines.fail("the file ends after ", found, " of ", count, " ", what);
    const std::string_view text = lines.text();
    for (int i = 0; i < format.repeat && found < count; ++i, ++found) {
      const std::size_t start = static_cast<std::size_t>(i) * width;
      use(start < text.size() ? text.substr(start, width) : std::string_view());
    }
  }
}

int integer_in(const Lines& lines, std::string_view field, const char* what) {
  field = detail::trimmed(field);
  if (field.empty()) lines.fail("the field of ", what, " is blank; the line must hold a whole number there");
  return lines.number<int>(field, what);
}

/// The place of the first entry of each column, from 0, and the number of entries.
std::vector<int> read_pointers(Lines& lines, const HarwellBoeingHeader& header) {
  std::vector<int> pointers;
  for_each_field(lines, header.pointers, header.rows + 1, "column pointers", [&](std::string_view field) {
    const int pointer = integer_in(lines, field, "a column pointer") - 1;
    const int least = pointers.empty() ? 0 : pointers.back();
    if (pointer < least || pointer > header.entries || (pointers.empty() && pointer != 0))
      lines.fail("a column pointer is ", pointer + 1, "; pointers must increase from 1 to ",
                 header.entries + 1, ", the number of entries and 1");
    pointers.push_back(pointer);
  });
  if (pointers.back() != header.entries)
    lines.fail("the last column pointer is ", pointers.back() + 1, "; it must be ", header.entries + 1,
               ", the number of entries and 1");
  return pointers;
}

double real_in(const Lines& lines, std::string_view field, const FortranFormat& format) {
  const auto value = detail::fortran_real(field, format);
  if (!value)
    lines.fail("a value is \"", field, "\"; it must be a finite number in a field of ", format.width,
               " characters");
  return *value;
}

detail::MatrixEntries read_entries(Lines& lines, const HarwellBoeingHeader& header) {
  const std::vector<int> pointers = read_pointers(lines, header);
  std::vector<int> rows;
  for_each_field(lines, header.indices, header.entries, "row indices", [&](std::string_view field) {
    const int row = integer_in(lines, field, "a row index");
    if (row < 1 || row > header.rows) lines.fail("a row index is ", row, "; it must be in 1..", header.rows);
    rows.push_back(row - 1);
  });
  detail::MatrixEntries entries;
  std::size_t entry = 0, column = 0;
  for_each_field(lines, header.values, header.entries, "values", [&](std::string_view field) {
    const double value = real_in(lines, field, header.values);
    while (static_cast<std::size_t>(pointers[column + 1]) <= entry) ++column;
    if (value != 0.0) entries.emplace_back(rows[entry], static_cast<int>(column), value);
    ++entry;
  });
  return entries;
}

/// The one full vector that the header must announce.
void require_one_load(const Lines& lines, const HarwellBoeingHeader& header) {
  if (header.loads == 0) lines.fail("the file has no right-hand side; expected one, the load");
  if (header.loads != 1 || header.load_type.empty() || header.load_type[0] != 'f')
    lines.fail("the file has ", header.loads, " right-hand sides of the type \"", header.load_type,
               "\"; expected one of the type F, a full vector");
  if (!header.load_values || !header.load_values->real())
    lines.fail(
        "the format of the right-hand side is missing or no Fortran format; expected one such as "
        "(4D20.12) as the fourth in the line of formats");
}

Eigen::VectorXd load_of(Lines& lines, const HarwellBoeingHeader& header) {
  Eigen::VectorXd load(header.rows);
  Eigen::Index row = 0;
  for_each_field(lines, *header.load_values, header.rows, "values of the right-hand side",
                 [&](std::string_view field) { load[row++] = real_in(lines, field, *header.load_values); });
  return load;
}

}  // namespace

Eigen::SparseMatrix<double> read_harwell_boeing(std::istream& input, const std::string& name) {
  return detail::read_harwell_boeing_parts(input, name, detail::MatrixPart::matrix).front().matrix;
}

std::vector<NamedMatrix> detail::read_harwell_boeing_parts(std::istream& input, const std::string& name,
                                                           MatrixPart part) {
  Lines lines(input, name);
  const HarwellBoeingHeader header = read_header_of_harwell_boeing(lines);
  const bool loaded = part == MatrixPart::load || (part == MatrixPart::all && header.loads > 0);
  if (loaded) require_one_load(lines, header);
  MatrixEntries entries = read_entries(lines, header);
  std::vector<NamedMatrix> found;
  if (part != MatrixPart::load)
    found.push_back({header.title,
                     matrix_of(std::move(entries), header.rows, header.rows, header.symmetric, name),
                     {},
                     false});
  if (loaded) found.push_back({"right-hand side", load_of(lines, header).sparseView(), {}, true});
  return found;
}

Eigen::VectorXd read_right_hand_side(std::istream& input, const std::string& name) {
  return Eigen::VectorXd(
      detail::read_harwell_boeing_parts(input, name, detail::MatrixPart::load).front().matrix.col(0));
}

}  // namespace wavebalance::fem

#include "wavebalance/fem/matrix_market.hpp"

#include <algorithm>
#include <istream>
#include <limits>

#include "entries.hpp"
#include "text_parts.hpp"

namespace wavebalance::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using detail::Lines;
using detail::lower;
using detail::MatrixEntries;

enum class Symmetry { general, symmetric, skew };

struct Header {
  bool array;
  Symmetry symmetry;
  bool one_triangle() const { return symmetry != Symmetry::general; }
};

Symmetry symmetry_of(const Lines& lines, const std::string& word) {
  if (word == "general") return Symmetry::general;
  if (word == "symmetric") return Symmetry::symmetric;
  if (word == "skew-symmetric") return Symmetry::skew;
  lines.fail("the symmetry is \"", word, "\"; it must be general, symmetric or skew-symmetric");
}

Header read_header(Lines& lines) {
  if (!lines.next()) lines.fail("the file is empty");
  const auto& words = lines.words();
  if (words.size() != 5 || lower(words[0]) != "%%matrixmarket" || lower(words[1]) != "matrix")
    lines.fail("the header must be \"%%MatrixMarket matrix coordinate real general\" or a variant of it");
  const auto choice = [&](std::size_t word, const char* what, const char* first, const char* second) {
    const std::string found = lower(words[word]);
    if (found != first && found != second)
      lines.fail("the ", what, " is \"", found, "\"; it must be ", first, " or ", second);
    return found == second;
  };
  const bool array = choice(2, "format", "coordinate", "array");
  choice(3, "field", "real", "integer");
  return {array, symmetry_of(lines, lower(words[4]))};
}

int read_size(const Lines& lines, std::size_t word, const char* what) {
  const int size = lines.number<int>(word, what);
  if (size < 0) lines.fail(what, " is ", size, "; it must not be negative");
  return size;
}

int read_side(const Lines& lines, std::size_t word, const char* what) {
  const int size = read_size(lines, word, what);
  if (size > detail::largest_side)
    lines.fail(what, " is ", size, "; it must be at most ", detail::largest_side);
  return size;
}

void require_data(Lines& lines, long long found, long long expected) {
  if (!lines.next_with_data('%')) lines.fail("the file ends after ", found, " of ", expected, " entries");
}

void require_end(Lines& lines, long long expected) {
  if (lines.next_with_data('%')) lines.fail("there is more than the ", expected, " entries announced");
}

struct Sizes {
  int rows, columns;
  long long entries;
};

Sizes read_sizes(Lines& lines, const Header& header) {
  if (!lines.next_with_data('%')) lines.fail("the line of sizes is missing");
  lines.require_words(header.array ? 2 : 3, header.array ? "rows and columns" : "rows, columns and entries");
  Sizes sizes{read_side(lines, 0, "the count of rows"), read_side(lines, 1, "the count of columns"), 0};
  const long long rows = sizes.rows, room = rows * sizes.columns;
  if (header.one_triangle() && sizes.rows != sizes.columns)
    lines.fail("a symmetric or skew-symmetric matrix must be square; this one is ", sizes.rows, " x ",
               sizes.columns);
  if (header.array)
    sizes.entries = header.symmetry == Symmetry::symmetric ? rows * (rows + 1) / 2
                    : header.symmetry == Symmetry::skew    ? rows * (rows - 1) / 2
                                                           : room;
  else
    sizes.entries = read_size(lines, 2, "the count of entries");
  if (sizes.entries > room)
    lines.fail("the count of entries is ", sizes.entries, "; the matrix has room for ", room);
  return sizes;
}

/// A file of one triangle has no entry above the diagonal, and of a skew-symmetric matrix none on it.
void require_in_triangle(const Lines& lines, Symmetry symmetry, int row, int column) {
  if (row > column || (row == column && symmetry != Symmetry::skew)) return;
  lines.fail("the entry (", row + 1, ", ", column + 1, ") is ", (row == column ? "on" : "above"),
             " the diagonal; a ",
             (symmetry == Symmetry::skew ? "skew-symmetric file holds what is below it"
                                         : "symmetric file holds the lower triangle"));
}

MatrixEntries read_coordinates(Lines& lines, const Sizes& sizes, const Header& header) {
  MatrixEntries entries;
  for (long long found = 0; found < sizes.entries; ++found) {
    require_data(lines, found, sizes.entries);
    lines.require_words(3, "row, column and value");
    const int row = lines.index(0, "the row", sizes.rows);
    const int column = lines.index(1, "the column", sizes.columns);
    if (header.one_triangle()) require_in_triangle(lines, header.symmetry, row, column);
    entries.emplace_back(row, column, lines.finite(2));
  }
  return entries;
}

// The values column by column; of a symmetric matrix the lower triangle, of a skew-symmetric one what is
// below the diagonal. Zeros are left out.
MatrixEntries read_array(Lines& lines, const Sizes& sizes, const Header& header) {
  const auto first_row = [&](int column) {
    return !header.one_triangle() ? 0 : header.symmetry == Symmetry::skew ? column + 1 : column;
  };
  MatrixEntries entries;
  long long found = 0;
  for (int column = 0; column < sizes.columns; ++column)
    for (int row = first_row(column); row < sizes.rows; ++row) {
      require_data(lines, found++, sizes.entries);
      lines.require_words(1, "one value");
      const double value = lines.finite(0);
      if (value != 0.0) entries.emplace_back(row, column, value);
    }
  return entries;
}

/// The other triangle of a skew-symmetric matrix.
void append_negative_mirror(MatrixEntries& entries) {
  const std::size_t given = entries.size();
  entries.reserve(2 * given);
  for (std::size_t i = 0; i < given; ++i) {
    const auto entry = entries[i];
    entries.emplace_back(entry.col(), entry.row(), -entry.value());
  }
}

bool is_symmetric(const Sparse& matrix) {
  if (matrix.rows() != matrix.cols()) return false;
  const Sparse turned = matrix.transpose();
  return turned.nonZeros() == matrix.nonZeros() &&
         std::equal(turned.valuePtr(), turned.valuePtr() + turned.nonZeros(), matrix.valuePtr()) &&
         std::equal(turned.innerIndexPtr(), turned.innerIndexPtr() + turned.nonZeros(),
                    matrix.innerIndexPtr());
}

void append(std::string& text, double value) {
  std::array<char, 32> digits;
  text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
  text += '\n';
}

}  // namespace

Sparse read_matrix_market(std::istream& input, const std::string& name) {
  Lines lines(input, name);
  const Header header = read_header(lines);
  const Sizes sizes = read_sizes(lines, header);
  MatrixEntries entries =
      header.array ? read_array(lines, sizes, header) : read_coordinates(lines, sizes, header);
  require_end(lines, sizes.entries);
  if (header.symmetry == Symmetry::skew) append_negative_mirror(entries);
  return detail::matrix_of(std::move(entries), sizes.rows, sizes.columns,
                           header.symmetry == Symmetry::symmetric, name);
}

Sparse read_matrix_market(const std::filesystem::path& file) {
  return detail::from_file(file, [](auto&&... from) { return read_matrix_market(from...); });
}

std::string matrix_market_text(const Sparse& given) {
  Sparse matrix = given;
  matrix.makeCompressed();
  const bool symmetric = is_symmetric(matrix);
  std::string entries;
  long long count = 0;
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry) {
      const std::string place = std::to_string(entry.row() + 1) + " " + std::to_string(column + 1);
      if (!std::isfinite(entry.value()))
        throw std::invalid_argument("matrix_market_text: the entry (" + place + ") is not finite");
      if (symmetric && entry.row() < column) continue;
      append(entries += place + " ", entry.value());
      ++count;
    }
  return std::string("%%MatrixMarket matrix coordinate real ") + (symmetric ? "symmetric\n" : "general\n") +
         std::to_string(matrix.rows()) + " " + std::to_string(matrix.cols()) + " " + std::to_string(count) +
         "\n" + entries;
}

std::string matrix_market_text(const Eigen::MatrixXd& matrix, const std::string& comment) {
  std::string text = "%%MatrixMarket matrix array real general\n";
  std::istringstream lines(comment);
  for (std::string line; std::getline(lines, line);) text += "% " + line + "\n";
  text += std::to_string(matrix.rows()) + " " + std::to_string(matrix.cols()) + "\n";
  for (const double value : matrix.reshaped()) append(text, value);
  return text;
}

}  // namespace wavebalance::fem

#include "wavebalance/fem/matrix_market.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <istream>
#include <limits>
#include <sstream>
#include <string_view>
#include <vector>

namespace wavebalance::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Triplet = Eigen::Triplet<double, int>;

// Lines of a file with their numbers, for errors that say where.
class Lines {
 public:
  Lines(std::istream& input, const std::string& name) : input_(input), name_(name) {}

  bool next() {
    if (!std::getline(input_, text_)) return false;
    ++number_;
    words_.clear();
    const std::string_view view = text_;
    for (std::size_t start = view.find_first_not_of(blank); start != std::string_view::npos;) {
      const std::size_t end = std::min(view.find_first_of(blank, start), view.size());
      words_.push_back(view.substr(start, end - start));
      start = view.find_first_not_of(blank, end);
    }
    return true;
  }
  bool next_with_data() {
    while (next())
      if (!words_.empty() && words_[0][0] != '%') return true;
    return false;
  }
  const std::vector<std::string_view>& words() const { return words_; }
  [[noreturn]] void fail(const std::string& what) const {
    throw MatrixMarketError(name_ + ":" + std::to_string(number_) + ": " + what);
  }
  void require_words(std::size_t count, const char* layout) const {
    if (words_.size() != count) fail("found \"" + text_ + "\"; the line must hold " + std::string(layout));
  }
  template <typename Number>
  Number number(std::size_t word, const char* what) const {
    std::string_view text = words_[word];
    if (text.size() > 1 && text[0] == '+') text.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size())
      fail(std::string(what) + " is \"" + std::string(words_[word]) + "\"; it must be a " +
           (std::is_integral_v<Number> ? "whole number" : "number") + " in range");
    return value;
  }
  int index(std::size_t word, const char* what, int size) const {
    const int value = number<int>(word, what);
    if (value < 1 || value > size)
      fail(std::string(what) + " is " + std::to_string(value) + "; it must be in 1.." + std::to_string(size));
    return value - 1;
  }
  double finite(std::size_t word) const {
    const double value = number<double>(word, "the value");
    if (!std::isfinite(value)) fail("the value is \"" + std::string(words_[word]) + "\"; it must be finite");
    return value;
  }

 private:
  static constexpr const char* blank = " \t\r";
  std::istream& input_;
  std::string name_;
  std::string text_;
  std::vector<std::string_view> words_;
  int number_ = 0;
};

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& letter : result)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return result;
}

// The header's symmetry. `format` is coordinate or array.
std::string read_header(Lines& lines, const std::string& format, const std::vector<std::string>& symmetries) {
  if (!lines.next()) lines.fail("the file is empty");
  const auto& words = lines.words();
  if (words.size() != 5 || lower(words[0]) != "%%matrixmarket" || lower(words[1]) != "matrix")
    lines.fail("the header must be \"%%MatrixMarket matrix " + format + " real " + symmetries[0] + "\"");
  if (lower(words[2]) != format)
    lines.fail("the format is \"" + std::string(words[2]) + "\"; it must be " + format);
  if (lower(words[3]) != "real" && lower(words[3]) != "integer")
    lines.fail("the field is \"" + std::string(words[3]) + "\"; it must be real or integer");
  const std::string symmetry = lower(words[4]);
  if (std::find(symmetries.begin(), symmetries.end(), symmetry) == symmetries.end())
    lines.fail("the symmetry is \"" + symmetry + "\"; it must be " + symmetries[0] +
               (symmetries.size() > 1 ? " or " + symmetries[1] : ""));
  return symmetry;
}

// A line of sizes alone must not take memory that no file of that length can need.
constexpr int largest_side = 100'000'000;

int read_size(const Lines& lines, std::size_t word, const char* what) {
  const int size = lines.number<int>(word, what);
  if (size < 0) lines.fail(std::string(what) + " is " + std::to_string(size) + "; it must not be negative");
  return size;
}

int read_side(const Lines& lines, std::size_t word, const char* what) {
  const int size = read_size(lines, word, what);
  if (size > largest_side)
    lines.fail(std::string(what) + " is " + std::to_string(size) + "; it must be at most " +
               std::to_string(largest_side));
  return size;
}

void require_data(Lines& lines, int found, int expected) {
  if (!lines.next_with_data())
    lines.fail("the file ends after " + std::to_string(found) + " of " + std::to_string(expected) +
               " entries");
}

void require_end(Lines& lines, int expected) {
  if (lines.next_with_data())
    lines.fail("there is more than the " + std::to_string(expected) + " entries announced");
}

struct CoordinateSizes {
  int rows, columns, entries;
};

CoordinateSizes read_coordinate_sizes(Lines& lines, bool symmetric) {
  if (!lines.next_with_data()) lines.fail("the line of sizes is missing");
  lines.require_words(3, "rows, columns and entries");
  const CoordinateSizes sizes{read_side(lines, 0, "the count of rows"),
                              read_side(lines, 1, "the count of columns"),
                              read_size(lines, 2, "the count of entries")};
  if (symmetric && sizes.rows != sizes.columns)
    lines.fail("a symmetric matrix must be square; this one is " + std::to_string(sizes.rows) + " x " +
               std::to_string(sizes.columns));
  if (sizes.entries > static_cast<double>(sizes.rows) * sizes.columns)
    lines.fail("the count of entries is " + std::to_string(sizes.entries) + "; the matrix has room for " +
               std::to_string(static_cast<long long>(sizes.rows) * sizes.columns));
  return sizes;
}

void reject_repeats(const std::vector<Triplet>& entries, const std::string& name) {
  std::vector<std::pair<int, int>> places;
  places.reserve(entries.size());
  for (const Triplet& entry : entries) places.emplace_back(entry.col(), entry.row());
  std::sort(places.begin(), places.end());
  const auto twice = std::adjacent_find(places.begin(), places.end());
  if (twice != places.end())
    throw MatrixMarketError(name + ": the entry (" + std::to_string(twice->second + 1) + ", " +
                            std::to_string(twice->first + 1) + ") is given twice");
}

std::ifstream open(const std::filesystem::path& file) {
  std::ifstream input(file);
  if (!input) throw MatrixMarketError(file.string() + ": the file cannot be opened for reading");
  return input;
}

void require_writable(const Sparse& matrix, MatrixMarketSymmetry symmetry) {
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry) {
      const auto place = [&] {
        return "(" + std::to_string(entry.row() + 1) + ", " + std::to_string(entry.col() + 1) + ")";
      };
      if (!std::isfinite(entry.value()))
        throw std::invalid_argument("write_matrix_market: the entry " + place() + " is not finite");
      if (symmetry == MatrixMarketSymmetry::symmetric &&
          (matrix.rows() != matrix.cols() || matrix.coeff(entry.col(), entry.row()) != entry.value()))
        throw std::invalid_argument("write_matrix_market: the matrix is not symmetric at " + place());
    }
}

}  // namespace

Sparse read_matrix_market(std::istream& input, const std::string& name) {
  Lines lines(input, name);
  const bool symmetric = read_header(lines, "coordinate", {"general", "symmetric"}) == "symmetric";
  const CoordinateSizes sizes = read_coordinate_sizes(lines, symmetric);
  std::vector<Triplet> entries;
  for (int found = 0; found < sizes.entries; ++found) {
    require_data(lines, found, sizes.entries);
    lines.require_words(3, "row, column and value");
    const int row = lines.index(0, "the row", sizes.rows);
    const int column = lines.index(1, "the column", sizes.columns);
    if (symmetric && row < column)
      lines.fail("the entry (" + std::to_string(row + 1) + ", " + std::to_string(column + 1) +
                 ") is above the diagonal; a symmetric file holds the lower triangle");
    const double value = lines.finite(2);
    entries.emplace_back(row, column, value);
  }
  require_end(lines, sizes.entries);
  reject_repeats(entries, name);
  if (symmetric)
    for (std::size_t i = 0, stored = entries.size(); i < stored; ++i)
      if (entries[i].row() != entries[i].col())
        entries.emplace_back(entries[i].col(), entries[i].row(), entries[i].value());
  Sparse matrix(sizes.rows, sizes.columns);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Sparse read_matrix_market(const std::filesystem::path& file) {
  std::ifstream input = open(file);
  return read_matrix_market(input, file.string());
}

Eigen::VectorXd read_matrix_market_vector(std::istream& input, const std::string& name) {
  Lines lines(input, name);
  read_header(lines, "array", {"general"});
  if (!lines.next_with_data()) lines.fail("the line of sizes is missing");
  lines.require_words(2, "rows and columns");
  const int rows = read_size(lines, 0, "the count of rows");
  const int columns = read_size(lines, 1, "the count of columns");
  if (columns != 1) lines.fail("the count of columns is " + std::to_string(columns) + "; it must be 1");
  std::vector<double> values;
  for (int found = 0; found < rows; ++found) {
    require_data(lines, found, rows);
    lines.require_words(1, "one value");
    values.push_back(lines.finite(0));
  }
  require_end(lines, rows);
  return Eigen::Map<const Eigen::VectorXd>(values.data(), rows);
}

Eigen::VectorXd read_matrix_market_vector(const std::filesystem::path& file) {
  std::ifstream input = open(file);
  return read_matrix_market_vector(input, file.string());
}

void write_matrix_market(std::ostream& output, const Sparse& matrix, MatrixMarketSymmetry symmetry) {
  require_writable(matrix, symmetry);
  const bool symmetric = symmetry == MatrixMarketSymmetry::symmetric;
  std::ostringstream text;
  text << std::setprecision(std::numeric_limits<double>::max_digits10);
  long long count = 0;
  for (int column = 0; column < matrix.outerSize(); ++column)
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry) {
      if (symmetric && entry.row() < entry.col()) continue;
      text << entry.row() + 1 << ' ' << entry.col() + 1 << ' ' << entry.value() << '\n';
      ++count;
    }
  output << "%%MatrixMarket matrix coordinate real " << (symmetric ? "symmetric" : "general") << '\n'
         << matrix.rows() << ' ' << matrix.cols() << ' ' << count << '\n'
         << text.str();
  if (!output) throw MatrixMarketError("write_matrix_market: writing failed");
}

void write_matrix_market(const std::filesystem::path& file, const Sparse& matrix,
                         MatrixMarketSymmetry symmetry) {
  std::ofstream output(file);
  if (!output) throw MatrixMarketError(file.string() + ": the file cannot be opened for writing");
  write_matrix_market(output, matrix, symmetry);
  output.close();
  if (!output) throw MatrixMarketError(file.string() + ": writing failed");
}

}  // namespace wavebalance::fem

#include "wavebalance/fem/matrix_file.hpp"

#include <optional>
#include <vector>

#include "text_lines.hpp"
#include "wavebalance/fem/matrix_market.hpp"

namespace wavebalance::fem {
namespace {

using detail::lower;

/// Row, column and value, as CalculiX writes them.
bool is_coordinate_line(const std::vector<std::string>& words) {
  if (words.size() != 3) return false;
  const auto is_digits = [](const std::string& word) {
    return word.find_first_not_of("0123456789") == std::string::npos;
  };
  return is_digits(words[0]) && is_digits(words[1]) &&
         words[2].find_first_not_of("+-.0123456789eE") == std::string::npos;
}

/// Three letters: real, complex or pattern; symmetry; assembled or by elements.
bool is_type_of_harwell_boeing(const std::string& word) {
  const auto one_of = [&](std::size_t place, const char* letters) {
    return std::string_view(letters).find(word[place]) != std::string_view::npos;
  };
  return word.size() == 3 && one_of(0, "rcp") && one_of(1, "suhzr") && one_of(2, "ae");
}

/// The words of the first four lines, in lower case; shorter if the file ends.
std::vector<std::vector<std::string>> first_lines(const std::filesystem::path& file) {
  std::ifstream input = detail::open_matrix_file(file);
  detail::Lines lines(input, file.string());
  std::vector<std::vector<std::string>> found;
  while (found.size() < 4 && lines.next()) {
    found.emplace_back();
    for (const std::string_view word : lines.words()) found.back().push_back(lower(word));
  }
  return found;
}

std::optional<MatrixFormat> format_of(const std::vector<std::vector<std::string>>& lines) {
  if (lines.empty()) return std::nullopt;
  if (!lines[0].empty() && lines[0][0] == "%%matrixmarket") return MatrixFormat::matrix_market;
  if (lines.size() == 4 && !lines[2].empty() && is_type_of_harwell_boeing(lines[2][0]) && !lines[3].empty() &&
      lines[3][0].front() == '(')
    return MatrixFormat::harwell_boeing;
  if (is_coordinate_line(lines[0])) return MatrixFormat::calculix;
  return std::nullopt;
}

std::optional<MatrixFormat> format_of_extension(const std::filesystem::path& file) {
  const std::string extension = lower(file.extension().string());
  if (extension == ".mtx") return MatrixFormat::matrix_market;
  if (extension == ".sti" || extension == ".mas") return MatrixFormat::calculix;
  if (extension == ".rsa" || extension == ".rua") return MatrixFormat::harwell_boeing;
  return std::nullopt;
}

}  // namespace

std::string_view to_string(MatrixFormat format) {
  if (format == MatrixFormat::matrix_market) return "Matrix Market";
  return format == MatrixFormat::calculix ? "CalculiX" : "Harwell-Boeing";
}

MatrixFormat matrix_format(const std::filesystem::path& file) {
  auto format = format_of_extension(file);
  if (format == MatrixFormat::matrix_market) return *format;  // whose errors say what a header must be
  if (const auto seen = format_of(first_lines(file))) format = seen;
  if (!format)
    throw MatrixFileError(
        file.string() +
        ":1: the file has no known format; it must be Matrix Market (opens with %%MatrixMarket), CalculiX "
        "(.sti, .mas: lines of row, column and value) or Harwell-Boeing (RSA or RUA in its third line)");
  return *format;
}

Eigen::SparseMatrix<double> read_matrix(const std::filesystem::path& file) {
  switch (matrix_format(file)) {
    case MatrixFormat::calculix:
      return read_calculix_matrix(file);
    case MatrixFormat::harwell_boeing:
      return read_harwell_boeing(file);
    case MatrixFormat::matrix_market:
      break;
  }
  return read_matrix_market(file);
}

}  // namespace wavebalance::fem

#include "wavebalance/fem/matrix_file.hpp"

#include <algorithm>
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

bool is_integer(std::string_view text) {
  const auto first = text.find_first_not_of(" -");
  return first != std::string_view::npos &&
         text.find_first_not_of("0123456789 ", first) == std::string_view::npos;
}

/// Of Abaqus and of Nastran.
bool is_comment(const std::string& line) { return line.starts_with("**") || line.starts_with('$'); }

/// "2,1, 2,1, 2.0e+03": node, dof, node, dof and value.
bool is_matrix_input(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char letter : line) {
    if (letter == ',')
      fields.emplace_back();
    else
      fields.back() += letter;
  }
  return fields.size() >= 5 && std::all_of(fields.begin(), fields.begin() + 4, is_integer);
}

/// Four integers in fields of eight characters, and a name.
bool is_header_of_output4(const std::string& line) {
  constexpr std::size_t width = 8, integers = 4;
  if (line.size() <= integers * width) return false;
  for (std::size_t i = 0; i < integers; ++i)
    if (!is_integer(std::string_view(line).substr(i * width, width))) return false;
  return line[integers * width] >= 'a' && line[integers * width] <= 'z';
}

/// Three letters: real, complex or pattern; symmetry; assembled or by elements.
bool is_type_of_harwell_boeing(const std::string& word) {
  const auto one_of = [&](std::size_t place, const char* letters) {
    return std::string_view(letters).find(word[place]) != std::string_view::npos;
  };
  return word.size() == 3 && one_of(0, "rcp") && one_of(1, "suhzr") && one_of(2, "ae");
}

constexpr std::size_t header_lines = 4;

struct FirstLine {
  std::string text;                ///< in lower case
  std::vector<std::string> words;  ///< of it
};

/// The first lines of a file, and after them those up to the first that is no comment of Abaqus or Nastran.
std::vector<FirstLine> first_lines(const std::filesystem::path& file) {
  constexpr std::size_t most = 1000;
  std::ifstream input = detail::open_matrix_file(file);
  detail::Lines lines(input, file.string());
  std::vector<FirstLine> found;
  while ((found.size() < header_lines || is_comment(found.back().text)) && found.size() < most &&
         lines.next()) {
    found.push_back({lower(lines.text()), {}});
    for (const std::string_view word : lines.words()) found.back().words.push_back(lower(word));
  }
  return found;
}

std::optional<MatrixFormat> format_of(const std::vector<FirstLine>& lines) {
  if (lines.empty()) return std::nullopt;
  if (!lines[0].words.empty() && lines[0].words[0] == "%%matrixmarket") return MatrixFormat::matrix_market;
  if (lines.size() >= header_lines && !lines[2].words.empty() &&
      is_type_of_harwell_boeing(lines[2].words[0]) && !lines[3].words.empty() &&
      lines[3].words[0].front() == '(')
    return MatrixFormat::harwell_boeing;
  if (is_coordinate_line(lines[0].words)) return MatrixFormat::calculix;
  return std::nullopt;
}

/// Which format it is that is known but not read; empty if it is none.
std::string unread_format(const std::vector<FirstLine>& lines) {
  const auto data =
      std::find_if(lines.begin(), lines.end(), [](const FirstLine& one) { return !is_comment(one.text); });
  if (data == lines.end()) return "";
  if (is_matrix_input(data->text))
    return "matrix input of Abaqus (node, dof, node, dof, value), which is not read; *MATRIX OUTPUT, "
           "FORMAT=COORDINATE writes lines that are";
  if (data->text.starts_with("dmig")) return "DMIG entries of Nastran, which are not read";
  if (is_header_of_output4(data->text)) return "OUTPUT4 of Nastran, which is not read";
  return "";
}

std::optional<MatrixFormat> format_of_extension(const std::filesystem::path& file) {
  const std::string extension = lower(file.extension().string());
  if (extension == ".mtx") return MatrixFormat::matrix_market;
  if (extension == ".sti" || extension == ".mas") return MatrixFormat::calculix;
  if (extension == ".rsa" || extension == ".rua") return MatrixFormat::harwell_boeing;
  return std::nullopt;
}

struct FoundFormat {
  MatrixFormat format;
  bool by_content;
};

FoundFormat found_format(const std::filesystem::path& file) {
  const std::vector<FirstLine> lines = first_lines(file);
  if (const auto seen = format_of(lines)) return {*seen, true};
  const std::string known =
      "; expected Matrix Market (opens with %%MatrixMarket), CalculiX or Abaqus (lines of row, column and "
      "value) or Harwell-Boeing (RSA or RUA in its third line)";
  if (const std::string unread = unread_format(lines); !unread.empty())
    throw MatrixFileError(file.string() + ":1: the file holds " + unread + known);
  if (const auto named = format_of_extension(file)) return {*named, false};
  throw MatrixFileError(file.string() + ":1: the file has no known format" + known);
}

/// What `reader` makes of a file; its errors say which format the file was taken for.
template <class Reader>
auto read_as(const FoundFormat& found, const std::filesystem::path& file, Reader reader) {
  try {
    return reader(file);
  } catch (const MatrixFileError& error) {
    throw MatrixFileError(std::string(error.what()) + "; the file was read as " +
                          std::string(to_string(found.format)) +
                          (found.by_content ? "" : " because of its name"));
  }
}

}  // namespace

std::string_view to_string(MatrixFormat format) {
  if (format == MatrixFormat::matrix_market) return "Matrix Market";
  return format == MatrixFormat::calculix ? "coordinates of CalculiX or Abaqus" : "Harwell-Boeing";
}

MatrixFormat matrix_format(const std::filesystem::path& file) { return found_format(file).format; }

Eigen::SparseMatrix<double> read_matrix(const std::filesystem::path& file) {
  const FoundFormat found = found_format(file);
  return read_as(found, file, [&](const std::filesystem::path& path) {
    return found.format == MatrixFormat::calculix         ? read_calculix_matrix(path)
           : found.format == MatrixFormat::harwell_boeing ? read_harwell_boeing(path)
                                                          : read_matrix_market(path);
  });
}

Eigen::VectorXd read_vector(const std::filesystem::path& file) {
  const FoundFormat found = found_format(file);
  return read_as(found, file, [&](const std::filesystem::path& path) {
    if (found.format == MatrixFormat::calculix)
      throw MatrixFileError(path.string() +
                            ":1: the file holds a matrix; expected a vector in Matrix Market, "
                            "or Harwell-Boeing with a right-hand side");
    return found.format == MatrixFormat::harwell_boeing ? read_right_hand_side(path)
                                                        : read_matrix_market_vector(path);
  });
}

}  // namespace wavebalance::fem

// The format of a file by its content, or else by its name.
#include "wavebalance/fem/matrix_file.hpp"

#include <algorithm>

#include "formats.hpp"
#include "output4.hpp"
#include "text_parts.hpp"

namespace wavebalance::fem {
namespace {

using detail::FoundFormat;
using detail::lower;
using LowerWords = std::vector<std::string>;

/// A format, its name in errors and its ends of file names.
struct KnownFormat {
  MatrixFormat format;
  std::string_view name;
  std::array<std::string_view, 3> extensions;
};

constexpr std::array known_formats{
    KnownFormat{MatrixFormat::matrix_market, "Matrix Market", {".mtx"}},
    KnownFormat{MatrixFormat::calculix, "coordinates of CalculiX or Abaqus", {".sti", ".mas"}},
    KnownFormat{MatrixFormat::harwell_boeing, "Harwell-Boeing", {".rsa", ".rua"}},
    KnownFormat{MatrixFormat::abaqus, "matrix input of Abaqus", {}},
    KnownFormat{MatrixFormat::substructure, "a substructure of Abaqus or CalculiX", {}},
    KnownFormat{MatrixFormat::dmig, "DMIG of Nastran", {".pch", ".bdf", ".dmig"}},
    KnownFormat{MatrixFormat::output4, "OUTPUT4 of Nastran", {".op4"}}};

constexpr std::string_view all_formats =
    "expected Matrix Market (opens with %%MatrixMarket), CalculiX or Abaqus (lines of row, column and value), "
    "Abaqus (node, dof, node, dof and value, or a substructure), Harwell-Boeing (RSA or RUA in its third line) or Nastran (DMIG or "
    "OUTPUT4)";

bool has_digits_alone(std::string_view word) {
  if (word.starts_with('-')) word.remove_prefix(1);
  return !word.empty() && word.find_first_not_of("0123456789") == std::string_view::npos;
}

/// `indices` whole numbers and a value.
bool is_entry(const LowerWords& words, std::size_t indices) {
  return words.size() == indices + 1 &&
         std::all_of(words.begin(), words.begin() + static_cast<std::ptrdiff_t>(indices), has_digits_alone) &&
         words[indices].find_first_not_of("+-.0123456789eE") == std::string::npos;
}

/// In Abaqus and in Nastran.
bool is_comment(const std::string& line) { return line.starts_with("**") || line.starts_with('$'); }

/// Three letters: real, complex or pattern; symmetry; assembled or by elements.
bool is_type_of_harwell_boeing(const std::string& word) {
  const auto one_of = [&](std::size_t place, const char* letters) {
    return std::string_view(letters).find(word[place]) != std::string_view::npos;
  };
  return word.size() == 3 && one_of(0, "rcp") && one_of(1, "suhzr") && one_of(2, "ae");
}

constexpr std::size_t header_lines = 4;

struct FirstLine {
  std::string text;  ///< in lower case
  LowerWords words;  ///< of it
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

/// By the first line that is no comment.
std::optional<MatrixFormat> format_of_data(const FirstLine& line) {
  if (is_entry(line.words, 2)) return MatrixFormat::calculix;
  LowerWords fields;
  for (const std::string_view word : detail::split(line.text, " ,\t\r")) fields.emplace_back(word);
  if (is_entry(fields, 4) || line.text.starts_with("*matrix") || line.text.starts_with("*cload"))
    return MatrixFormat::abaqus;
  if (line.text.starts_with("*user element")) return MatrixFormat::substructure;
  if (line.text.starts_with("dmig")) return MatrixFormat::dmig;
  if (detail::is_output4_header(line.text)) return MatrixFormat::output4;
  return std::nullopt;
}

std::optional<MatrixFormat> format_of(const std::vector<FirstLine>& lines) {
  if (lines.empty()) return std::nullopt;
  if (!lines[0].words.empty() && lines[0].words[0] == "%%matrixmarket") return MatrixFormat::matrix_market;
  if (lines.size() >= header_lines && !lines[2].words.empty() &&
      is_type_of_harwell_boeing(lines[2].words[0]) && !lines[3].words.empty() &&
      lines[3].words[0].front() == '(')
    return MatrixFormat::harwell_boeing;
  const auto data = std::ranges::find_if(
      lines, [](const FirstLine& one) { return !one.words.empty() && !is_comment(one.text); });
  return data == lines.end() ? std::nullopt : format_of_data(*data);
}

std::optional<MatrixFormat> format_of_extension(const std::filesystem::path& file) {
  const std::string extension = lower(file.extension().string());
  for (const KnownFormat& one : known_formats)
    if (!extension.empty() && std::ranges::find(one.extensions, extension) != one.extensions.end())
      return one.format;
  return std::nullopt;
}

/// Whether an entry DMIG comes after others of bulk data.
bool has_dmig(const std::filesystem::path& file) {
  std::ifstream input = detail::open_matrix_file(file);
  detail::Lines lines(input, file.string());
  while (lines.next())
    if (lower(lines.text().substr(0, 4)) == "dmig") return true;
  return false;
}

bool is_binary(const std::filesystem::path& file) {
  std::ifstream input = detail::open_matrix_file(file);
  return detail::is_output4_binary(input);
}

}  // namespace

std::optional<FoundFormat> detail::format_if_known(const std::filesystem::path& file) {
  if (is_binary(file)) return FoundFormat{MatrixFormat::output4, true};
  if (const auto seen = format_of(first_lines(file))) return FoundFormat{*seen, true};
  if (has_dmig(file)) return FoundFormat{MatrixFormat::dmig, true};
  if (const auto named = format_of_extension(file)) return FoundFormat{*named, false};
  return std::nullopt;
}

FoundFormat detail::found_format(const std::filesystem::path& file) {
  if (const auto found = format_if_known(file)) return *found;
  throw MatrixFileError(file.string() + ":1: the file has no known format; " + std::string(all_formats));
}

std::string_view to_string(MatrixFormat format) {
  return std::ranges::find_if(known_formats, [&](const KnownFormat& one) { return one.format == format; })
      ->name;
}

MatrixFormat matrix_format(const std::filesystem::path& file) { return detail::found_format(file).format; }

}  // namespace wavebalance::fem

#include "text_parts.hpp"

#include <algorithm>
#include <istream>

namespace wavebalance::fem::detail {
namespace {

constexpr std::string_view blank_characters = " \t\r";

}  // namespace

std::ifstream open_matrix_file(const std::filesystem::path& file) {
  std::error_code failure;
  const auto status = std::filesystem::status(file, failure);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw MatrixFileError(file.string() + " is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, failure);
  std::ifstream input(file);
  if (failure || !input) throw MatrixFileError(file.string() + ": the file cannot be opened for reading");
  if (size > largest_matrix_file)
    throw MatrixFileError(file.string() + ": the size of the file is " + std::to_string(size) +
                          " bytes; it must be at most " + std::to_string(largest_matrix_file));
  return input;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& letter : result)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return result;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(blank_characters);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank_characters) - first + 1);
}

std::vector<std::string_view> split(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> words;
  for (std::size_t start = text.find_first_not_of(separators); start != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(separators, start), text.size());
    words.push_back(text.substr(start, end - start));
    start = text.find_first_not_of(separators, end);
  }
  return words;
}

bool Lines::next() {
  if (!std::getline(input_, text_)) return false;
  ++number_;
  words_ = split(text_, blank_characters);
  return true;
}

bool Lines::next_with_data(char comment) {
  while (next())
    if (!words_.empty() && words_[0][0] != comment) return true;
  return false;
}

void Lines::fail(const std::string& what) const {
  throw MatrixFileError(name_ + ":" + std::to_string(number_) + ": " + what);
}

void Lines::require_words(std::size_t count, const char* layout) const {
  constexpr std::size_t most = 120;  // of a file that is no text at all
  if (words_.size() != count) fail("found \"", text_.substr(0, most), "\"; the line must hold ", layout);
}

int Lines::index(std::string_view text, const char* what, int size) const {
  const int value = number<int>(text, what);
  if (value < 1 || value > size) fail(what, " is ", value, "; it must be in 1..", size);
  return value - 1;
}

double Lines::finite(std::string_view text) const {
  const double value = number<double>(text, "the value");
  if (!std::isfinite(value)) fail("the value is \"", text, "\"; it must be finite");
  return value;
}

double Lines::finite_of_column(std::string_view text) {
  const double value = finite(text);
  const std::size_t width = text.size() - (text.starts_with('-') ? 1 : 0);
  if (input_.eof() && of_one_width_ && width < width_)
    fail("the value is \"", text,
         "\" and shorter than all before, and no end of line follows; the file is cut off");
  of_one_width_ = of_one_width_ && (width_ == 0 || width == width_) &&
                  text.find_first_of("eEdD") != std::string_view::npos;
  width_ = width;
  return value;
}

}  // namespace wavebalance::fem::detail

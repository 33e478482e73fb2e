#pragma once
#include <array>
#include <charconv>
#include <fstream>
#include <system_error>
#include <vector>

#include "require.hpp"
#include "wavebalance/fem/matrix_file.hpp"

namespace wavebalance::fem::detail {

/// A line of bulk data of Nastran: its first field, and the four large or eight small ones after it.
struct BulkLine {
  std::string_view name;  ///< without the star of large fields
  std::array<std::string_view, 8> fields;
  int count = 8;
  bool continues = false;  ///< whether it belongs to the entry before it
};

/// Splits a line with small fields of 8 characters, large ones of 16, or free ones with commas. Blanks around
/// fields do not count, and fields that are missing are empty. The views are into `text`.
BulkLine bulk_line(std::string_view text);

/// A Fortran format of numbers that all have the same field, such as (1P,3E26.18) or (10I8).
struct FortranFormat {
  char letter = 'i';    ///< i, or for reals one of e, d, f, g
  int repeat = 1;       ///< fields per line
  int width = 0;        ///< characters per field
  int decimals = 0;     ///< digits after the point of a real that is written without one
  int scale_power = 0;  ///< k of kP: a real that is written without an exponent is divided by 10^k

  bool real() const { return letter != 'i'; }
};

/// The format that a text in parentheses is, or none if it is another one.
std::optional<FortranFormat> fortran_format(std::string_view text);

/// The real number in a field, as Fortran reads it: with the exponent letter E or D, with only a sign
/// (1.5-101), or without an exponent. None if it is no finite number. Blanks around it do not count.
std::optional<double> fortran_real(std::string_view field, const FortranFormat& format);

/// The first text in parentheses of a line, which is taken from it; empty if there is none.
std::string_view next_parentheses(std::string_view& line);

/// Bounds the memory that an index or a size can claim.
constexpr int largest_side = 100'000'000;

/// Opens a regular file of at most largest_matrix_file bytes. Throws MatrixFileError.
std::ifstream open_matrix_file(const std::filesystem::path& file);

/// Result of `read(input, name)` for a file.
template <class Read>
auto from_file(const std::filesystem::path& file, Read read) {
  std::ifstream input = open_matrix_file(file);
  return read(input, file.string());
}

/// The text in lower case.
std::string lower(std::string_view text);

/// Without the blanks around it.
std::string_view trimmed(std::string_view text);

/// The words that any of `separators` separate, none of them empty.
std::vector<std::string_view> split(std::string_view text, std::string_view separators);

/// Lines of a file with their numbers, for errors that say where. Errors are MatrixFileError.
class Lines {
 public:
  Lines(std::istream& input, std::string name) : input_(input), name_(std::move(name)) {}

  /// Goes to the next line. False at the end of the file.
  bool next();
  /// Goes to the next line that is neither empty nor opened by `comment`.
  bool next_with_data(char comment);
  const std::string& text() const { return text_; }
  /// The words of the line, which blanks separate.
  const std::vector<std::string_view>& words() const { return words_; }
  const std::string& name() const { return name_; }
  int number_of_line() const { return number_; }

  [[noreturn]] void fail(const std::string& what) const;
  template <class... Parts>
  [[noreturn]] void fail(const Parts&... parts) const {
    fail(joined(parts...));
  }
  void require_words(std::size_t count, const char* layout) const;
  /// The number that a text of this line is.
  template <typename Number>
  Number number(std::string_view text, const char* what) const {
    std::string_view digits = text;
    if (digits.size() > 1 && digits[0] == '+') digits.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc() || end != digits.data() + digits.size())
      fail(what, " is \"", text, "\"; it must be a ",
           (std::is_integral_v<Number> ? "whole number" : "number"), " in range");
    return value;
  }
  template <typename Number>
  Number number(std::size_t word, const char* what) const {
    return number<Number>(words_[word], what);
  }
  /// An index from 1 to size, less 1.
  int index(std::string_view text, const char* what, int size) const;
  int index(std::size_t word, const char* what, int size) const { return index(words_[word], what, size); }
  double finite(std::string_view text) const;
  /// The same of lines of one layout: of values with exponents and one length, a shorter one that nothing
  /// follows was cut off.
  double finite_of_column(std::string_view text);
  double finite(std::size_t word) const { return finite(words_[word]); }

 private:
  std::istream& input_;
  std::string name_;
  std::string text_;
  std::vector<std::string_view> words_;
  int number_ = 0;
  std::size_t width_ = 0;  // of the values of a column without their signs
  bool of_one_width_ = true;
};

}  // namespace wavebalance::fem::detail

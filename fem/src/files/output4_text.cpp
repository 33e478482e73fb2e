#include <algorithm>

#include "output4.hpp"
#include "text_parts.hpp"

namespace wavebalance::fem::detail {
namespace {

constexpr std::size_t integer_width = 8, header_integers = 4, name_width = 8;
constexpr long long string_step = 65536;  // what one word adds to the integer before a string

bool is_integer(std::string_view field) {
  const auto first = field.find_first_not_of(" -");
  return first != std::string_view::npos &&
         field.find_first_not_of("0123456789 ", first) == std::string_view::npos;
}

/// OUTPUT4 as text: integers in fields of eight characters, values in the format of the header.
class TextSource final : public Output4Source {
 public:
  TextSource(std::istream& input, const std::string& name) : lines_(input, name) {}

  std::optional<Output4Header> header() override {
    do {
      if (!lines_.next()) return std::nullopt;
    } while (lines_.words().empty());
    const std::string_view text = lines_.text();
    if (!is_output4_header(text))
      fail("found \"", text.substr(0, 60),
           "\"; the line must be a header, four integers in fields of 8 characters, a name and a format");
    Output4Header header;
    long long* const numbers[] = {&header.columns, &header.rows, &header.form, &header.type};
    for (std::size_t i = 0; i < header_integers; ++i)
      *numbers[i] = lines_.number<long long>(trimmed(text.substr(i * integer_width, integer_width)),
                                             "a number of the header");
    header.big = header.rows < 0;
    header.rows = std::abs(header.rows);
    const std::string_view rest = text.substr(header_integers * integer_width);
    header.name = trimmed(rest.substr(0, name_width));
    read_format(trimmed(rest.substr(std::min(name_width, rest.size()))));
    return header;
  }

  Output4Column column() override {
    next_line(3, "number, first row and words of a column");
    return {integer(0), integer(1), integer(2)};
  }

  Output4String string(bool big) override {
    if (big) {
      next_line(2, "words and first row of a string");
      return {integer(1), integer(0) - 1};
    }
    next_line(1, "the integer before a string");
    return {integer(0) % string_step, integer(0) / string_step - 1};
  }

  double value() override {
    if (field_ == format_.repeat) {
      if (!lines_.next()) fail("the file ends within a column");
      field_ = 0;
    }
    const auto width = static_cast<std::size_t>(format_.width);
    const std::size_t start = static_cast<std::size_t>(field_++) * width;
    const std::string_view text = lines_.text();
    const std::string_view field = start < text.size() ? text.substr(start, width) : std::string_view();
    const auto found = fortran_real(field, format_);
    if (!found)
      fail("a value is \"", field, "\"; it must be a finite number in a field of ", format_.width,
           " characters");
    return *found;
  }

  void end_matrix() override { lines_.next(); }

  int words(long long type, bool dense) const override {
    const int parts = type > 2 ? 2 : 1;
    return dense || type % 2 == 1 ? parts : 2 * parts;
  }

  std::string place() const override { return lines_.name() + ":" + std::to_string(lines_.number_of_line()); }

 private:
  void read_format(std::string_view text) {
    const auto format = fortran_format("(" + std::string(text) + ")");
    if (!format || !format->real())
      fail("the format is \"", text, "\"; it must be one of Fortran such as 1P,3E23.16");
    format_ = *format;
  }

  /// The values of the line before, if any, end with it.
  void next_line(std::size_t words, const char* layout) {
    if (!lines_.next()) fail("the file ends before ", layout);
    lines_.require_words(words, layout);
    field_ = format_.repeat;
  }

  long long integer(std::size_t word) const { return lines_.number<long long>(word, "an integer"); }

  Lines lines_;
  FortranFormat format_;
  int field_ = 0;  ///< the next one of the line
};

}  // namespace

bool is_output4_header(std::string_view line) {
  if (line.size() <= header_integers * integer_width) return false;
  for (std::size_t i = 0; i < header_integers; ++i)
    if (!is_integer(line.substr(i * integer_width, integer_width))) return false;
  const std::string letter = lower(line.substr(header_integers * integer_width, 1));
  return letter[0] >= 'a' && letter[0] <= 'z';
}

std::vector<NamedMatrix> read_output4_text(std::istream& input, const std::string& name,
                                           std::string_view wanted) {
  TextSource source(input, name);
  return read_output4(source, name, wanted);
}

}  // namespace wavebalance::fem::detail

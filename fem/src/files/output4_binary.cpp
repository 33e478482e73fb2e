#include <algorithm>
#include <bit>
#include <cstring>
#include <istream>

#include "output4.hpp"
#include "text_parts.hpp"

namespace wavebalance::fem::detail {
namespace {

constexpr std::int32_t short_header = 24, long_header = 48;  // bytes, with words of 4 and of 8
constexpr long long word_step = 65536;  // what one word adds to the integer before a string

template <class Number>
Number number_at(const char* bytes, bool swapped) {
  std::array<char, sizeof(Number)> copy;
  std::copy_n(bytes, sizeof(Number), copy.begin());
  if (swapped) std::reverse(copy.begin(), copy.end());
  return std::bit_cast<Number>(copy);
}

/// How the first record of a binary file is stored.
struct Layout {
  bool swapped;  ///< in the other byte order than this machine's
  int word;      ///< bytes
};

/// None if it is no such file. The stream is back at its start.
std::optional<Layout> layout_of(std::istream& input) {
  std::array<char, long_header + 8> bytes{};
  input.read(bytes.data(), std::ssize(bytes));
  const auto count = input.gcount();
  input.clear();
  input.seekg(0);
  for (const bool swapped : {false, true})
    for (const std::int32_t size : {short_header, long_header})
      if (count >= size + 8 && number_at<std::int32_t>(bytes.data(), swapped) == size &&
          number_at<std::int32_t>(bytes.data() + 4 + size, swapped) == size)
        return Layout{swapped, size == short_header ? 4 : 8};
  return std::nullopt;
}

/// OUTPUT4 in unformatted records of Fortran, each between its length twice.
class BinarySource final : public Output4Source {
 public:
  BinarySource(std::istream& input, const std::string& name, Layout layout)
      : input_(input), name_(name), layout_(layout) {
    input_.seekg(0, std::ios::end);
    left_ = input_.tellg();
    input_.seekg(0);
  }

  std::optional<Output4Header> header() override {
    if (left_ == 0) return std::nullopt;
    next_record();
    const std::size_t expected = layout_.word == 4 ? short_header : long_header;
    if (record_.size() != expected)
      fail("the record has ", record_.size(), " bytes; a header must have ", expected);
    Output4Header header;
    header.columns = integer();
    header.rows = integer();
    header.form = integer();
    header.type = integer();
    header.big = header.rows < 0;
    header.rows = std::abs(header.rows);
    for (; next_ < record_.size(); ++next_)
      if (record_[next_] > ' ') header.name += record_[next_];
    type_ = header.type;
    return header;
  }

  Output4Column column() override {
    next_record();
    Output4Column column{integer(), integer(), integer()};
    const auto bytes = static_cast<long long>(record_.size() - next_);
    if (column.words * layout_.word != bytes)
      fail("a column says that it has ", column.words, " words; its record has ", bytes / layout_.word);
    return column;
  }

  Output4String string(bool big) override {
    const long long first = integer();
    if (big) return {integer(), first - 1};
    return {first % word_step, first / word_step - 1};
  }

  double value() override {
    const bool single = type_ % 2 == 1 && layout_.word == 4;
    const char* bytes = take(single ? sizeof(float) : sizeof(double));
    return single ? static_cast<double>(number_at<float>(bytes, layout_.swapped))
                  : number_at<double>(bytes, layout_.swapped);
  }

  void end_matrix() override {}

  int words(long long type, bool) const override {
    const int parts = type > 2 ? 2 : 1;
    return layout_.word == 8 || type % 2 == 1 ? parts : 2 * parts;
  }

  std::string place() const override { return name_ + ": record " + std::to_string(number_); }

 private:
  std::int32_t marker() {
    std::array<char, 4> bytes;
    if (!input_.read(bytes.data(), std::ssize(bytes))) fail("the file ends within this record");
    left_ -= std::ssize(bytes);
    return number_at<std::int32_t>(bytes.data(), layout_.swapped);
  }

  void next_record() {
    ++number_;
    if (left_ == 0) fail("the file ends before this record");
    const std::int32_t size = marker();
    if (size < 0) fail("its length is ", size, "; it must not be negative");
    if (size > left_) fail("the file ends within this record");
    record_.resize(static_cast<std::size_t>(size));
    input_.read(record_.data(), size);
    left_ -= size;
    if (const std::int32_t again = marker(); again != size)
      fail("its length is ", size, " before it and ", again, " after it; they must agree");
    next_ = 0;
  }

  const char* take(std::size_t bytes) {
    if (record_.size() - next_ < bytes) fail("the record ends within its values");
    next_ += bytes;
    return record_.data() + next_ - bytes;
  }

  long long integer() {
    const char* bytes = take(static_cast<std::size_t>(layout_.word));
    return layout_.word == 4 ? number_at<std::int32_t>(bytes, layout_.swapped)
                             : number_at<std::int64_t>(bytes, layout_.swapped);
  }

  std::istream& input_;
  std::string name_;
  Layout layout_;
  long long left_ = 0;  ///< bytes of the file
  int number_ = 0;      ///< of the record
  std::vector<char> record_;
  std::size_t next_ = 0;  ///< byte of it
  long long type_ = 2;
};

}  // namespace

bool is_output4_binary(std::istream& input) { return layout_of(input).has_value(); }

std::vector<NamedMatrix> read_output4_binary(std::istream& input, const std::string& name,
                                             std::string_view wanted) {
  BinarySource source(input, name, *layout_of(input));
  return read_output4(source, name, wanted);
}

}  // namespace wavebalance::fem::detail

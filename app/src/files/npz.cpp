#include "wavebalance/app/files/npz.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>

namespace wavebalance::app {
namespace {

static_assert(std::endian::native == std::endian::little);

/// The bytes of a number, least first.
template <class Number>
void append_number(std::string& bytes, Number number) {
  char raw[sizeof(Number)];
  std::memcpy(raw, &number, sizeof(Number));
  bytes.append(raw, sizeof(Number));
}

/// The code points of UTF-8; a byte that is none is taken as it is.
std::u32string code_points(const std::string& text) {
  std::u32string points;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto first = static_cast<unsigned char>(text[i]);
    const int length = first < 0xc0 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    if (length == 1 || i + static_cast<std::size_t>(length) > text.size()) {
      points += first;
      continue;
    }
    char32_t point = first & (0x7fu >> length);
    for (int k = 1; k < length; ++k) point = point << 6 | (static_cast<unsigned char>(text[++i]) & 0x3fu);
    points += point;
  }
  return points;
}

/// An array of the NPY format; its data begin at a multiple of 64 bytes.
std::string npy_text(const std::string& type, std::size_t size, const std::string& data) {
  std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({},), }}", type, size);
  constexpr std::size_t before = 10;
  header.append(63 - (before + header.size()) % 64, ' ');
  header += '\n';
  std::string text("\x93NUMPY\x01\x00", 8);
  append_number(text, static_cast<std::uint16_t>(header.size()));
  return text + header + data;
}

template <class Kind>
bool all_are(const Table& table, std::size_t column) {
  for (std::size_t i = 0; i < table.rows(); ++i)
    if (!std::holds_alternative<Kind>(table.row(i)[column])) return false;
  return true;
}

template <class Kind, class Stored>
std::string plain_array(const char* type, const Table& table, std::size_t column) {
  std::string data;
  for (std::size_t i = 0; i < table.rows(); ++i)
    append_number(data, static_cast<Stored>(std::get<Kind>(table.row(i)[column])));
  return npy_text(type, table.rows(), data);
}

bool holds_text(const Table& table, std::size_t column) {
  for (std::size_t i = 0; i < table.rows(); ++i)
    if (std::holds_alternative<std::string>(table.row(i)[column])) return true;
  return false;
}

std::string text_array(const std::vector<std::string>& texts) {
  std::vector<std::u32string> rows;
  std::size_t width = 1;
  for (const std::string& text : texts) {
    rows.push_back(code_points(text));
    width = std::max(width, rows.back().size());
  }
  std::string data;
  for (std::u32string& row : rows) {
    row.resize(width, U'\0');
    for (const char32_t point : row) append_number(data, static_cast<std::uint32_t>(point));
  }
  return npy_text(fmt::format("<U{}", width), texts.size(), data);
}

std::string array_of(const Table& table, std::size_t column) {
  const std::string& name = table.columns()[column];
  if (holds_text(table, column)) return text_array(table.texts(name));
  if (all_are<bool>(table, column)) return plain_array<bool, char>("|b1", table, column);
  if (all_are<std::int64_t>(table, column))
    return plain_array<std::int64_t, std::int64_t>("<i8", table, column);
  std::string data;
  for (const double value : table.numbers(name)) append_number(data, value);
  return npy_text("<f8", table.rows(), data);
}

/// Common part of a file's two headers in an archive: version 2.0, no flags but names in UTF-8, no
/// compression, and the first day of the format.
std::string zip_fields(const std::string& name, const std::string& contents) {
  std::string fields;
  for (const std::uint16_t field : {20, 0x800, 0, 0, 0x21}) append_number(fields, field);
  const auto size = static_cast<std::uint32_t>(contents.size());
  append_number(fields, static_cast<std::uint32_t>(
                            crc32_z(0, reinterpret_cast<const Bytef*>(contents.data()), contents.size())));
  append_number(fields, size);
  append_number(fields, size);
  append_number(fields, static_cast<std::uint16_t>(name.size()));
  append_number(fields, std::uint16_t{0});
  return fields;
}

class ZipArchive {
 public:
  void add(const std::string& name, const std::string& contents) {
    constexpr auto most = std::numeric_limits<std::uint32_t>::max();
    if (contents.size() > most || text_.size() + contents.size() > most)
      throw std::length_error("npz_text: the table would take more than 4 GB; expected fewer rows");
    const std::string fields = zip_fields(name, contents);
    directory_ += "PK\x01\x02";
    append_number(directory_, std::uint16_t{20});
    directory_ += fields;
    // No comment, first volume, no attributes.
    directory_.append(10, '\0');
    append_number(directory_, static_cast<std::uint32_t>(text_.size()));
    directory_ += name;
    text_ += "PK\x03\x04" + fields + name + contents;
    ++files_;
  }

  std::string finish() && {
    const auto begin = static_cast<std::uint32_t>(text_.size());
    text_ += directory_ + "PK\x05\x06";
    for (const std::uint16_t field : {std::uint16_t{0}, std::uint16_t{0}, files_, files_})
      append_number(text_, field);
    append_number(text_, static_cast<std::uint32_t>(directory_.size()));
    append_number(text_, begin);
    append_number(text_, std::uint16_t{0});
    return std::move(text_);
  }

 private:
  std::string text_, directory_;
  std::uint16_t files_ = 0;
};

}  // namespace

std::string npz_text(const Table& table) {
  ZipArchive archive;
  for (std::size_t i = 0; i < table.columns().size(); ++i)
    archive.add(table.columns()[i] + ".npy", array_of(table, i));
  return std::move(archive).finish();
}

}  // namespace wavebalance::app

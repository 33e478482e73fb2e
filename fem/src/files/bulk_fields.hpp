#pragma once
#include <array>
#include <string_view>

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

}  // namespace wavebalance::fem::detail

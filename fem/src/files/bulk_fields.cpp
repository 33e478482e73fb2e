#include "text_parts.hpp"

#include <algorithm>

namespace wavebalance::fem::detail {
namespace {

constexpr std::size_t small_width = 8;

/// The next field of a line, which is taken from it.
std::string_view take(std::string_view& text, bool free, std::size_t width) {
  const std::size_t end = free ? std::min(text.find(','), text.size()) : std::min(width, text.size());
  const std::string_view field = trimmed(text.substr(0, end));
  text.remove_prefix(std::min(text.size(), free ? end + 1 : end));
  return field;
}

}  // namespace

BulkLine bulk_line(std::string_view text) {
  const bool free = text.find(',') != std::string_view::npos;
  std::string_view first = take(text, free, small_width);
  BulkLine line;
  line.continues = first.empty() || first.front() == '+' || first.front() == '*';
  const bool large = first.find('*') != std::string_view::npos;
  line.count = large ? 4 : 8;
  line.name = first.substr(0, first.find('*'));
  for (int i = 0; i < line.count; ++i)
    line.fields[static_cast<std::size_t>(i)] = take(text, free, large ? 2 * small_width : small_width);
  return line;
}

}  // namespace wavebalance::fem::detail

#include "scene/toml_nesting.hpp"

#include <algorithm>
#include <string>

namespace wavebalance::app {
namespace {

/// The end of the comment or string that starts at `begin`. A string that is not closed ends with its line,
/// or with the text if its quotes are threefold.
std::size_t end_of_comment(std::string_view text, std::size_t begin) {
  return std::min(text.find('\n', begin), text.size());
}

std::size_t end_of_string(std::string_view text, std::size_t begin) {
  const char quote = text[begin];
  const std::string threefold(3, quote);
  const bool several_lines = text.substr(begin, 3) == threefold;
  std::size_t at = begin + (several_lines ? 3 : 1);
  for (; at < text.size(); ++at) {
    if (quote == '"' && text[at] == '\\')
      ++at;
    else if (several_lines && text.substr(at, 3) == threefold)
      return at + 3;
    else if (!several_lines && (text[at] == quote || text[at] == '\n'))
      return text[at] == quote ? at + 1 : at;
  }
  return text.size();
}

}  // namespace

int line_of_long_key(std::string_view text, int max_parts) {
  constexpr std::string_view delimiters = "\n=,[]{}";
  int line = 1, parts = 1;
  for (std::size_t at = 0; at < text.size();) {
    const char c = text[at];
    std::size_t end = at + 1;
    if (c == '#')
      end = end_of_comment(text, at);
    else if (c == '"' || c == '\'')
      end = end_of_string(text, at);
    else if (c == '.' && ++parts > max_parts)
      return line;
    else if (delimiters.find(c) != std::string_view::npos)
      parts = 1;
    line += static_cast<int>(std::count(text.begin() + static_cast<std::ptrdiff_t>(at),
                                        text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
    at = end;
  }
  return 0;
}

}  // namespace wavebalance::app

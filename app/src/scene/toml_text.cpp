#include "scene/toml_text.hpp"

#include <algorithm>
#include <sstream>

#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/scene/scene_error.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

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

std::string_view line_of_text(std::string_view text, int line) {
  for (; line > 1 && !text.empty(); --line)
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.substr(0, text.find('\n'));
}

/// The correct form of the line `key = text` without its quotes, or without the last one; empty for others.
std::string quotes_text(std::string_view line) {
  line = line.substr(0, line.find('#'));
  const auto equals = line.find('=');
  if (equals == std::string_view::npos) return "";
  const auto trimmed = [](std::string_view part) {
    const auto first = part.find_first_not_of(" \t\r");
    return first == std::string_view::npos ? std::string_view()
                                           : part.substr(first, part.find_last_not_of(" \t\r") - first + 1);
  };
  std::string_view value = trimmed(line.substr(equals + 1));
  const bool opened = value.starts_with('"');
  if (opened) value.remove_prefix(1);
  if (value.ends_with('"')) value.remove_suffix(1);
  const bool is_word = !value.empty() && value.find_first_of("\"'[]{}=,") == std::string_view::npos &&
                       value.find_first_not_of("0123456789.+-eE_: \t") != std::string_view::npos;
  if (!is_word) return "";
  return "; a text stands between quotes, as in " + std::string(trimmed(line.substr(0, equals))) + " = " +
         toml_text(SceneValue(std::string(value)));
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

std::string long_key_text() {
  return "a key has more than " + std::to_string(max_key_parts) +
         " parts between dots; expected section.key or [section]";
}

toml::table parse_toml(std::string_view text, const std::string& name) {
  if (const int line = line_of_long_key(text, max_key_parts); line > 0)
    throw SceneError({name, line, "", "", "", long_key_text()});
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const int line = static_cast<int>(error.source().begin.line);
    throw SceneError(
        {name, line, "", "", "",
         "not valid TOML: " + std::string(error.description()) + quotes_text(line_of_text(text, line))});
  }
}

std::string read_toml(const std::filesystem::path& file, std::size_t max_bytes) {
  try {
    return read_file(file, max_bytes);
  } catch (const IoError& error) {
    throw SceneError({file.string(), 0, "", "", "", error.reason()});
  }
}

std::string shortened(std::string text) {
  constexpr std::size_t longest_found = 60;
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.size() <= longest_found ? text : text.substr(0, longest_found - 3) + "...";
}

std::string found_text(const toml::node& node) {
  if (node.is_integer()) return toml_text(node.as_integer()->get());
  if (node.is_floating_point()) return toml_text(node.as_floating_point()->get());
  if (node.is_string()) return shortened(toml_text(node.as_string()->get()));
  if (node.is_table()) return "a table";
  std::ostringstream text;
  node.visit([&](const auto& concrete) { text << concrete; });
  return shortened(text.str());
}

}  // namespace wavebalance::app

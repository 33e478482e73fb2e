#include "wavebalance/app/page/html.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>

#include "files/contains.hpp"
#include "page/library_files.hpp"
#include "wavebalance/app/files/output.hpp"

namespace wavebalance::app {
namespace {

/// Whether a cell is one number, which no line may break.
bool is_number(const std::string& cell) {
  char* end = nullptr;
  std::strtod(cell.c_str(), &end);
  return !cell.empty() && *end == '\0';
}

std::string row_html(const std::vector<std::string>& cells, const char* tag) {
  std::string text = "<tr>";
  for (const auto& cell : cells)
    text += fmt::format("<{0}{2}>{1}</{0}>", tag,
                        cell.find('$') == cell.npos ? with_options(cell) : with_formulas(cell),
                        is_number(cell) ? " class=\"whole\"" : "");
  return text + "</tr>\n";
}

std::string link_or_content(const std::string& folder, const std::string& name, std::string_view content) {
  const bool style = name.ends_with(".css");
  if (folder.empty())
    return style ? fmt::format("<style>\n{}</style>\n", content)
                 : fmt::format("<script type=\"module\">\n{}</script>\n", content);
  return style ? fmt::format("<link rel=\"stylesheet\" href=\"{}{}\">\n", folder, name)
               : fmt::format("<script defer src=\"{}{}\"></script>\n", folder, name);
}

/// A library that is no module defines its name for all scripts only in a plain script element.
std::string library_html(const std::string& folder, Library library) {
  if (!available(library) || (folder.empty() && library == Library::katex)) return "";
  std::string text;
  for (const auto& file : library_files(library)) {
    const std::string name = file.filename().string();
    text += folder.empty() ? fmt::format("<script>\n{}</script>\n", read_file(file))
                           : link_or_content(folder, name, "");
  }
  return text;
}

std::string scripts_html(const PageParts& parts) {
  std::string text;
  for (const Library library : parts.libraries) text += library_html(parts.assets, library);
  std::vector<std::string> names{"page.js"};
  if (contains(parts.libraries, Library::d3)) names.push_back("curves.js");
  names.insert(names.end(), parts.scripts.begin(), parts.scripts.end());
  for (const auto& name : names) text += link_or_content(parts.assets, name, asset(name));
  return text;
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

std::string with_formulas(std::string_view text) {
  std::string result;
  while (true) {
    const std::size_t begin = text.find('$');
    const std::size_t end = begin == text.npos ? text.npos : text.find('$', begin + 1);
    if (end == text.npos) return result + escaped(text);
    result += escaped(text.substr(0, begin)) + "<span class=\"math\">" +
              escaped(text.substr(begin + 1, end - begin - 1)) + "</span>";
    text.remove_prefix(end + 1);
  }
}

std::string with_options(std::string_view text) {
  std::string result;
  for (std::size_t begin = text.find("--"); begin != text.npos; begin = text.find("--")) {
    const std::size_t end =
        std::min(text.find_first_not_of("abcdefghijklmnopqrstuvwxyz-", begin), text.size());
    result += escaped(text.substr(0, begin)) + "<span class=\"whole\">" +
              escaped(text.substr(begin, end - begin)) + "</span>";
    text.remove_prefix(end);
  }
  return result + escaped(text);
}

std::string picture_size(std::string_view bytes) {
  const auto text = [](auto width, auto height) {
    return fmt::format(" width=\"{}\" height=\"{}\"", width, height);
  };
  if (bytes.starts_with("\x89PNG") && bytes.size() >= 24) {
    const auto number = [&](std::size_t at) {
      std::uint32_t value = 0;
      for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
      return value;
    };
    return text(number(16), number(20));
  }
  const std::string_view head = bytes.substr(0, bytes.find('>', bytes.find("<svg")));
  const auto value = [&](std::string_view name) {
    const std::size_t begin = std::min(head.find(name), head.size() - name.size()) + name.size();
    return head.substr(begin, head.find('"', begin) - begin);
  };
  if (head.find(" width=\"") == head.npos || head.find(" height=\"") == head.npos) return "";
  return text(value(" width=\""), value(" height=\""));
}

std::string figure_html(const FigureBlock& block) {
  if (block.alternative.empty())
    throw std::invalid_argument("figure_html: \"" + block.path + "\" has no alternative text");
  const std::string path = escaped(block.path);
  const std::string curves = block.curves ? fmt::format(" data-curves=\"{}.figure.js\"", path) : "";
  return fmt::format(
      "<figure class=\"picture\"{}>\n<a href=\"{}{}\"><img src=\"{}{}\"{} alt=\"{}\" loading=\"lazy\"></a>\n{}"
      "</figure>\n",
      curves, path, block.suffix, path, block.suffix, block.size, escaped(block.alternative),
      block.caption.empty() ? "" : "<figcaption>" + block.caption + "</figcaption>\n");
}

std::string table_html(const std::vector<std::vector<std::string>>& rows, bool names) {
  if (rows.empty()) return "";
  std::string text = std::string("<div class=\"wide") + (names ? " named" : "") + "\"><table>\n<thead>" +
                     row_html(rows[0], "th") + "</thead>\n<tbody>\n";
  for (std::size_t i = 1; i < rows.size(); ++i) text += row_html(rows[i], "td");
  return text + "</tbody></table></div>\n";
}

std::string page_html(const PageParts& parts) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n{}{}</head>\n"
      "<body>\n{}</body>\n</html>\n",
      escaped(parts.title), link_or_content(parts.assets, "page.css", asset("page.css")), scripts_html(parts),
      parts.body);
}

}  // namespace wavebalance::app

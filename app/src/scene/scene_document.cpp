#include "scene/scene_document.hpp"

#include <algorithm>

#include "scene/spelling.hpp"
#include "scene/toml_text.hpp"
#include "wavebalance/app/scene/scene_error.hpp"

namespace wavebalance::app {
namespace {

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

/// A list of texts and numbers; monostate if there is another entry.
DocumentValue list_of(const toml::array& array) {
  DocumentList list;
  for (const auto& node : array) {
    if (node.is_integer())
      list.emplace_back(node.as_integer()->get());
    else if (node.is_floating_point())
      list.emplace_back(node.as_floating_point()->get());
    else if (node.is_string())
      list.emplace_back(node.as_string()->get());
    else
      return std::monostate{};
  }
  return list;
}

DocumentValue value_of(const toml::node& node) {
  if (const auto* array = node.as_array()) return list_of(*array);
  if (node.is_boolean()) return node.as_boolean()->get();
  if (node.is_integer()) return node.as_integer()->get();
  if (node.is_floating_point()) return node.as_floating_point()->get();
  if (node.is_string()) return node.as_string()->get();
  return std::monostate{};
}

DocumentEntry entry_of(std::string section, std::string key, const toml::node& node) {
  return {std::move(section), std::move(key), value_of(node), found_text(node), line_of(node), ""};
}

void add_section(Document& document, const std::string& name, const toml::table& table, int line);

/// The entries of [[contact.pairs]] or [[forcing.terms]], each a separate section.
void add_tables(Document& document, const toml::array& tables, std::string (*section)(std::size_t)) {
  for (std::size_t i = 0; i < tables.size(); ++i)
    add_section(document, section(i), *tables[i].as_table(), line_of(tables[i]));
}

void add_section(Document& document, const std::string& name, const toml::table& table, int line) {
  document.sections.push_back({name, line});
  for (const auto& [key, node] : table) {
    if (name == "contact" && key.str() == "pairs" && node.is_array_of_tables()) {
      add_tables(document, *node.as_array(), pair_section);
      continue;
    }
    if (name == "forcing" && key.str() == "terms" && node.is_array_of_tables()) {
      add_tables(document, *node.as_array(), term_section);
      continue;
    }
    document.entries.push_back(entry_of(name, std::string(key.str()), node));
    // A dotted key has no separate line for the intermediate table.
    if (document.entries.back().line == 0)
      document.entries.back().line = static_cast<int>(key.source().begin.line);
  }
}

/// Without those at its ends.
std::string without_blanks(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

/// The value of an override: TOML if it is one value, text otherwise.
DocumentEntry parse_override(const std::string& text, const std::string& section, const std::string& key,
                             const std::string& value) {
  DocumentEntry entry{section, key, value, shortened(toml_text(value)), 0, "--set " + text};
  if (line_of_long_key(value, max_key_parts) > 0)
    throw SceneError({"", 0, "--set " + shortened(text), "", "", long_key_text()});
  try {
    const toml::table table = toml::parse("value = " + value);
    if (table.size() == 1) {
      entry.value = value_of(*table.get("value"));
      entry.found = found_text(*table.get("value"));
    }
  } catch (const toml::parse_error&) {
    // Not TOML: text without its quotes.
  }
  return entry;
}

}  // namespace

std::pair<std::string, std::string> split_name(const std::string& full_name) {
  const auto bracket = full_name.find("].");
  const auto dot = bracket == std::string::npos ? full_name.find('.') : bracket + 1;
  return {full_name.substr(0, dot), full_name.substr(dot + 1)};
}

const DocumentEntry* Document::find(std::string_view section, std::string_view key) const {
  for (const auto& entry : entries)
    if (entry.section == section && entry.key == key) return &entry;
  return nullptr;
}

bool Document::has_section(std::string_view section) const {
  return std::ranges::any_of(sections, [&](const DocumentSection& one) { return one.name == section; });
}

int Document::section_line(std::string_view section) const {
  for (const auto& [name_of_section, line] : sections)
    if (name_of_section == section) return line;
  return 0;
}

std::size_t count_tables(const Document& document, const std::string& name, int most) {
  const auto count = std::ranges::count_if(
      document.sections, [&](const DocumentSection& one) { return one.name.starts_with(name + "["); });
  if (count > most)
    throw SceneError({document.name, document.section_line(name + "[1]"), "", name, "",
                      "there are " + std::to_string(count) + "; expected at most " + std::to_string(most)});
  return static_cast<std::size_t>(count);
}

Document parse_document(std::string_view text, const std::string& name) {
  const toml::table root = parse_toml(text, name);
  Document document;
  document.name = name;
  for (const auto& [key, node] : root) {
    const int line = static_cast<int>(key.source().begin.line);
    if (const auto* table = node.as_table())
      add_section(document, std::string(key.str()), *table, line);
    else
      document.entries.push_back(entry_of("", std::string(key.str()), node));
  }
  // Errors are reported in the order of the file, not of the alphabet.
  std::ranges::stable_sort(document.entries, {}, &DocumentEntry::line);
  return document;
}

namespace {

/// Removes all entries of the tables [[name]], as of "forcing.terms"; false where there are none.
bool remove_tables(Document& document, const std::string& name) {
  const std::string begin = name + "[";
  const bool any =
      std::erase_if(document.sections, [&](const auto& one) { return one.name.starts_with(begin); }) > 0;
  std::erase_if(document.entries, [&](const auto& one) { return one.section.starts_with(begin); });
  return any;
}

}  // namespace

void remove_entries(Document& document, std::span<const std::string> names) {
  for (const std::string& name : names) {
    const auto same = [&](const DocumentEntry& entry) { return entry.full_name() == name; };
    if (std::erase_if(document.entries, same) > 0) continue;
    if (remove_tables(document, name)) continue;
    std::vector<std::string> known;
    for (const DocumentEntry& entry : document.entries) known.push_back(entry.full_name());
    throw SceneError(
        {document.name, 0, "--unset " + name, "", "",
         "there is no such key in " + document.name + suggestion(name, known, "; expected section.key")});
  }
}

void apply_overrides(Document& document, std::span<const std::string> overrides) {
  for (const std::string& text : overrides) {
    const auto equals = text.find('=');
    const auto dot = text.find('.');
    if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 >= equals)
      throw SceneError(
          {document.name, 0, "--set " + text, "", "", "expected section.key=value, as in contact.gap=2e-3"});
    const auto [section, key] = split_name(without_blanks(text.substr(0, equals)));
    DocumentEntry entry = parse_override(text, section, key, text.substr(equals + 1));
    const auto same = [&](const DocumentEntry& other) { return other.full_name() == entry.full_name(); };
    const auto place = std::ranges::find_if(document.entries, same);
    if (place == document.entries.end())
      document.entries.push_back(std::move(entry));
    else
      *place = std::move(entry);
  }
}

}  // namespace wavebalance::app

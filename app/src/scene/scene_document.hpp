#pragma once

#include "wavebalance/app/scene/scene.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {

/// An entry of a list.
using DocumentScalar = std::variant<std::int64_t, double, std::string>;
using DocumentList = std::vector<DocumentScalar>;
/// A TOML value of a type that scenes use, or a list of numbers and texts; monostate is any other value
/// (another array, table, date).
using DocumentValue = std::variant<std::monostate, bool, std::int64_t, double, std::string, DocumentList>;

/// One `key = value` of a scene file or of an override.
struct DocumentEntry {
  std::string section;  ///< empty for a key outside of any table
  std::string key;
  DocumentValue value;
  std::string found;     ///< the value as messages show it
  int line = 0;          ///< 1 is the first
  std::string override;  ///< "--set contact.gap=big", or empty

  std::string full_name() const { return section.empty() ? key : section + "." + key; }
};

struct DocumentSection {
  std::string name;
  int line = 0;
};

/// A scene file taken apart, not yet checked against the table of keys.
struct Document {
  std::string name;
  std::vector<DocumentSection> sections;
  std::vector<DocumentEntry> entries;

  const DocumentEntry* find(std::string_view section, std::string_view key) const;
  bool has_section(std::string_view section) const;
  int section_line(std::string_view section) const;  ///< 0 if the file has no such section
};

/// The number of sections [[name]]. Throws SceneError for more than `most`.
std::size_t count_tables(const Document& document, const std::string& name, int most);

/// The section and the key of "section.key"; the section of "contact.pairs[1].gap" is "contact.pairs[1]". The
/// name must have a dot.
std::pair<std::string, std::string> split_name(const std::string& full_name);

/// Parses TOML. Throws SceneError with the line of a syntax error.
Document parse_document(std::string_view text, const std::string& name);

/// The keys and values that write_scene() writes, without lines.
Document document_of(const Scene& scene, const std::string& name);

/// Removes the entries of these names, "section.key" or, of tables, "forcing.terms" for all of them. Throws
/// SceneError if there is no such entry.
void remove_entries(Document& document, std::span<const std::string> names);

/// Sets or replaces entries by "section.key=value". Throws SceneError if an override has no such form.
void apply_overrides(Document& document, std::span<const std::string> overrides);

}  // namespace wavebalance::app

#include "compose/dof_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>

#include "compose/structure_inputs.hpp"
#include "scene/pair_reader.hpp"
#include "scene/scene_reader.hpp"
#include "scene/term_reader.hpp"
#include "wavebalance/app/scene/scene_error.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"
#include "wavebalance/fem/dof_map.hpp"

namespace wavebalance::app {
namespace {

struct NamedDof {
  int sign = 1;
  fem::NodeDof dof;
  bool numbered = false;  // "node 2 z #2", one of several rows of the name
};

bool is_list_of_dofs(const DocumentEntry& entry) {
  if (is_term_section(entry.section)) return entry.key == "dofs";
  if (is_pair_section(entry.section))
    return std::ranges::any_of(pair_keys(0),
                               [&](const SceneKey& key) { return key.dofs && key.name == entry.key; });
  const SceneKey* key = find_scene_key(entry.full_name());
  return key != nullptr && key->dofs;
}

template <class Integer>
std::optional<Integer> integer_of(const std::string& word) {
  Integer value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

/// "node 1042 z" or "node 2 z #2", with a minus sign before it or not; none if the text is another.
std::optional<NamedDof> named_dof(std::string text) {
  NamedDof found;
  if (text.starts_with('-')) {
    found.sign = -1;
    text.erase(0, 1);
  }
  std::istringstream words(text);
  std::string node, number, direction, copy, more;
  words >> node >> number >> direction;
  const auto value = integer_of<int>(number);
  if (node != "node" || !value) return std::nullopt;
  found.dof = {*value, fem::direction_of(direction)};
  if (words >> copy) {
    const auto place = copy.starts_with('#') ? integer_of<int>(copy.substr(1)) : std::nullopt;
    if (!place || *place < 1 || words >> more) return std::nullopt;
    found.dof.copy = *place;
    found.numbered = true;
  }
  return found.dof.direction == 0 ? std::nullopt : std::optional(found);
}

class RowsOfNames {
 public:
  explicit RowsOfNames(const Document& document) : document_(document) {}

  DocumentList rows(const DocumentEntry& entry, DocumentList list) {
    for (DocumentScalar& one : list)
      if (const auto* text = std::get_if<std::string>(&one)) {
        const auto integer = integer_of<std::int64_t>(*text);
        one = integer ? *integer : row(entry, *text);
      }
    return list;
  }

 private:
  std::int64_t row(const DocumentEntry& entry, const std::string& text) {
    const auto named = named_dof(text);
    if (!named)
      fail_at(
          document_, entry,
          fmt::format(
              "\"{}\" is no degree of freedom; expected an integer, \"node 1042 z\" or \"-node 1042 "
              "z\", with a direction of x, y, z, rx, ry, rz or scalar and, where several rows have one name, #1, #2 ...",
              text));
    if (named->sign < 0 && is_pair_section(entry.section))
      fail_at(document_, entry,
              fmt::format("\"{}\": expected no sign here; coefficients has the signs", text));
    const fem::DofMap& map = read_once(entry);
    const int found = map.row(named->dof);
    if (found < 0) fail_at(document_, entry, absent_text(map, named->dof));
    if (!named->numbered && map.copies(named->dof) > 1)
      fail_at(document_, entry, several_text(map, named->dof));
    return named->sign * (found + std::int64_t{1});
  }

  /// The entry of a key whose value is the name of a file, or null.
  const DocumentEntry* file_entry(const char* key) const {
    const DocumentEntry* entry = document_.find("structure", key);
    const auto* name = entry == nullptr ? nullptr : std::get_if<std::string>(&entry->value);
    return name == nullptr || name->empty() ? nullptr : entry;
  }

  const fem::DofMap& read_once(const DocumentEntry& entry) {
    if (map_) return *map_;
    const DocumentEntry *given = file_entry("dof_map"), *stiffness = file_entry("stiffness");
    const DocumentEntry* place = given != nullptr ? given : stiffness;
    try {
      if (place != nullptr) {
        path_ = path_in(document_, std::get<std::string>(place->value));
        map_ = map_of_rows(given != nullptr ? path_ : "", path_);
      }
    } catch (const fem::MatrixFileError& error) {
      fail_at(document_, *place, error.what());
    }
    if (map_) return *map_;
    fail_at(
        document_, entry,
        "names a node, but the scene has no structure.dof_map and the file of structure.stiffness names no "
        "nodes; expected a map, which says which row is which motion of which node, or integers");
  }

  /// Which rows a name could mean.
  std::string several_text(const fem::DofMap& map, fem::NodeDof dof) const {
    constexpr int shown = 6;
    const int copies = map.copies(dof);
    std::vector<std::string> rows;
    for (dof.copy = 1; dof.copy <= std::min(copies, shown); ++dof.copy)
      rows.push_back(fmt::format("\"{}\" (row {})", map.name(map.row(dof)), map.row(dof) + 1));
    return fmt::format(
        "{} rows of {} have that name, as those of shells and beams that are expanded to solids; expected one of {}{}",
        copies, path_, fmt::join(rows, ", "), copies > shown ? ", ..." : "");
  }

  std::string absent_text(const fem::DofMap& map, const fem::NodeDof& dof) const {
    if (const int copies = map.copies(dof); copies > 0)
      return fmt::format("there {} {} row{} of that name in {}; expected no #{}", copies == 1 ? "is" : "are",
                         copies, copies == 1 ? "" : "s", path_, dof.copy);
    std::vector<std::string> present;
    for (const int direction : map.directions(dof.node)) {
      const std::string name = map.name(map.row({dof.node, direction}));
      present.push_back(name.substr(name.rfind(' ') + 1));
    }
    if (present.empty())
      return fmt::format(
          "node {} is not in {}; expected one that has rows of the matrices, which a node that "
          "is held does not",
          dof.node, path_);
    return fmt::format("node {} does not move that way in {}; expected one of {}", dof.node, path_,
                       fmt::join(present, ", "));
  }

  const Document& document_;
  std::string path_;
  std::optional<fem::DofMap> map_;
};

}  // namespace

Document with_rows_for_names(Document document) {
  const DocumentEntry* type = document.find("structure", "type");
  if (type == nullptr || type->value != DocumentValue("matrices")) return document;
  RowsOfNames names(document);
  std::vector<std::pair<std::size_t, DocumentList>> found;
  for (std::size_t i = 0; i < document.entries.size(); ++i) {
    const DocumentEntry& entry = document.entries[i];
    const auto* list = std::get_if<DocumentList>(&entry.value);
    if (list == nullptr || !is_list_of_dofs(entry)) continue;
    const auto is_number = [](const DocumentScalar& one) { return std::holds_alternative<double>(one); };
    if (std::ranges::none_of(*list, is_number)) found.emplace_back(i, names.rows(entry, *list));
  }
  for (auto& [index, rows] : found) document.entries[index].value = std::move(rows);
  return document;
}

}  // namespace wavebalance::app

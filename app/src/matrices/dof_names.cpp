#include "matrices/dof_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "matrices/structure_inputs.hpp"
#include "scene/pair_reader.hpp"
#include "scene/scene_reader.hpp"
#include "scene/term_reader.hpp"
#include "wavebalance/app/scene/scene_error.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

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

/// Treatment of a name of several rows, by its list.
enum class SeveralRows {
  mean,     // of them, by coefficients: contacts, and forces that do work with it
  all,      // of the support that moves
  refused,  // where each row is separate
};

/// A list of degrees of freedom, and what its names become: rows, each with its part of the name's weight.
struct NamedRows {
  DocumentList rows;
  std::vector<std::size_t> names;  // of each row, the entry of the list
  std::vector<double> parts;       // of each row
  bool means() const { return rows.size() > (names.empty() ? 0 : names.back() + 1); }
};

class RowsOfNames {
 public:
  explicit RowsOfNames(const Document& document) : document_(document) {}

  NamedRows rows(const DocumentEntry& entry, const DocumentList& list, SeveralRows several) {
    NamedRows found;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const auto* text = std::get_if<std::string>(&list[i]);
      const auto integer = text == nullptr ? std::nullopt : integer_of<std::int64_t>(*text);
      std::vector<std::int64_t> rows;
      if (text != nullptr && !integer) rows = rows_named(entry, *text, several);
      const std::size_t count = std::max<std::size_t>(1, rows.size());
      for (std::size_t k = 0; k < count; ++k) {
        found.rows.push_back(integer ? DocumentScalar(*integer) : text ? DocumentScalar(rows[k]) : list[i]);
        found.names.push_back(i);
        found.parts.push_back(1.0 / double(count));
      }
    }
    return found;
  }

 private:
  std::vector<std::int64_t> rows_named(const DocumentEntry& entry, const std::string& text,
                                       SeveralRows several) {
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
    std::vector<std::int64_t> rows;
    for (const int row : rows_of(map, *named)) rows.push_back(named->sign * (row + std::int64_t{1}));
    if (rows.empty()) fail_at(document_, entry, absent_text(map, named->dof, path_));
    if (rows.size() > 1 && several == SeveralRows::refused)
      fail_at(document_, entry, several_text(map, named->dof));
    return rows;
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
    fail_at(document_, entry,
            "names a node, but the scene has no structure.dof_map and the file of "
            "structure.stiffness names no nodes; expected a map, which assigns rows to nodes and "
            "directions, or integers");
  }

  /// Which rows a name could mean.
  std::string several_text(const fem::DofMap& map, fem::NodeDof dof) const {
    constexpr int shown = 6;
    const int copies = map.copies(dof);
    std::vector<std::string> rows;
    for (dof.copy = 1; dof.copy <= std::min(copies, shown); ++dof.copy)
      rows.push_back(fmt::format("\"{}\" (row {})", map.name(map.row(dof)), map.row(dof) + 1));
    return fmt::format(
        "{} rows of {} have that name, as in shells and beams that are expanded to solids; "
        "expected one of {}{}; a contact of [[contact.pairs]] takes their mean",
        copies, path_, fmt::join(rows, ", "), copies > shown ? ", ..." : "");
  }

  const Document& document_;
  std::string path_;
  std::optional<fem::DofMap> map_;
};

bool has_text(const Document& document, const std::string& section, std::string_view key,
              std::string_view text) {
  const DocumentEntry* entry = document.find(section, key);
  return entry != nullptr && entry->value == DocumentValue(std::string(text));
}

SeveralRows several_rows_in(const Document& document, const DocumentEntry& entry) {
  if (is_pair_section(entry.section)) return SeveralRows::mean;
  if (entry.key == "load_dofs") return SeveralRows::mean;
  if (!is_term_section(entry.section) || has_text(document, entry.section, "kind", "unbalance"))
    return SeveralRows::refused;
  const bool moves = has_text(document, entry.section, "kind", "base_displacement") ||
                     has_text(document, entry.section, "kind", "base_acceleration");
  return moves ? SeveralRows::all : SeveralRows::mean;
}

/// The key of the weights of a list of degrees of freedom.
std::string weights_key(const std::string& key) {
  return key == "dofs" ? "coefficients" : key == "load_dofs" ? "load_coefficients" : key + "_coefficients";
}

/// The weights of each row of `found` from the weights of its names: the given or the default ones.
DocumentList weights_of(const NamedRows& found, const DocumentEntry* given, bool pair) {
  const auto* list = given == nullptr ? nullptr : std::get_if<DocumentList>(&given->value);
  const std::size_t names = found.names.back() + 1;
  DocumentList weights;
  for (std::size_t i = 0; i < found.rows.size(); ++i) {
    const std::size_t name = found.names[i];
    double weight = pair && names == 2 && name == 1 ? -1.0 : 1.0;  // two places that face each other
    if (list != nullptr)
      if (const auto* number = std::get_if<double>(&(*list)[name])) weight = *number;
    if (list != nullptr)
      if (const auto* integer = std::get_if<std::int64_t>(&(*list)[name])) weight = double(*integer);
    weights.emplace_back(weight * found.parts[i]);
  }
  return weights;
}

/// Sets the weights for a list whose names are means of several rows. A list of weights of another length
/// is reported later.
void set_weights(Document& document, const DocumentEntry& entry, const NamedRows& found) {
  const std::string key = weights_key(entry.key);
  const bool pair = is_pair_section(entry.section);
  const DocumentEntry* given = document.find(entry.section, key);
  const std::size_t names = found.names.back() + 1;
  if (given == nullptr && pair && names > 2) return;  // missing
  const auto* list = given == nullptr ? nullptr : std::get_if<DocumentList>(&given->value);
  if (given != nullptr &&
      (list == nullptr || list->size() != names || std::ranges::any_of(*list, [](const DocumentScalar& one) {
         return std::holds_alternative<std::string>(one);
       })))
    return;
  DocumentList weights = weights_of(found, given, pair);
  if (given == nullptr)
    document.entries.push_back({entry.section, key, std::move(weights), "", entry.line, entry.override});
  else
    document.entries[std::size_t(given - document.entries.data())].value = std::move(weights);
}

}  // namespace

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

std::vector<int> rows_of(const fem::DofMap& map, const NamedDof& named) {
  std::vector<int> rows;
  fem::NodeDof dof = named.dof;
  const int copies = named.numbered ? 1 : map.copies(dof);
  for (int copy = 0; copy < copies; ++copy) {
    if (!named.numbered) dof.copy = copy + 1;
    if (const int row = map.row(dof); row >= 0) rows.push_back(row);
  }
  return rows;
}

std::string absent_text(const fem::DofMap& map, const fem::NodeDof& dof, const std::string& path) {
  if (const int copies = map.copies(dof); copies > 0)
    return fmt::format("there {} {} row{} of that name in {}; expected no #{}", copies == 1 ? "is" : "are",
                       copies, copies == 1 ? "" : "s", path, dof.copy);
  std::vector<std::string> present;
  for (const int direction : map.directions(dof.node)) {
    const std::string name = map.name(map.row({dof.node, direction}));
    present.push_back(name.substr(name.rfind(' ') + 1));
  }
  if (present.empty())
    return fmt::format(
        "node {} is not in {}; expected one that has rows of the matrices, which a node that "
        "is held does not",
        dof.node, path);
  return fmt::format("node {} does not move that way in {}; expected one of {}", dof.node, path,
                     fmt::join(present, ", "));
}

Document with_rows_for_names(Document document) {
  const DocumentEntry* type = document.find("structure", "type");
  if (type == nullptr || type->value != DocumentValue("matrices")) return document;
  RowsOfNames names(document);
  std::vector<std::pair<std::size_t, NamedRows>> found;
  for (std::size_t i = 0; i < document.entries.size(); ++i) {
    const DocumentEntry& entry = document.entries[i];
    const auto* list = std::get_if<DocumentList>(&entry.value);
    if (list == nullptr || list->empty() || !is_list_of_dofs(entry)) continue;
    const auto is_number = [](const DocumentScalar& one) { return std::holds_alternative<double>(one); };
    if (std::ranges::none_of(*list, is_number))
      found.emplace_back(i, names.rows(entry, *list, several_rows_in(document, entry)));
  }
  for (auto& [index, rows] : found) {
    const DocumentEntry entry = document.entries[index];
    if (rows.means() && several_rows_in(document, entry) == SeveralRows::mean)
      set_weights(document, entry, rows);
    document.entries[index].value = std::move(rows.rows);
  }
  return document;
}

}  // namespace wavebalance::app

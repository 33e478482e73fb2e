#include "wavebalance/app/scene/scene_writer.hpp"

#include "files/contains.hpp"
#include "scene/keys/law_keys.hpp"
#include "scene/scene_document.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

bool is_empty(const SceneValue& value) {
  return value == SceneValue(std::string()) || value == SceneValue(std::vector<std::int64_t>()) ||
         value == SceneValue(std::vector<double>()) || value == SceneValue(std::vector<NumberOrText>());
}

/// Whether a key was not given and has no default, or a default that cannot be derived. It is not written:
/// time stepping needs no bases, for example.
bool is_unset(const SceneKey& key, const Scene& scene) {
  const SceneValue value = key.get(scene);
  if (key.section == "plot") return value == key.get(Scene{});  // changes no result
  if (std::holds_alternative<bool>(value)) return false;
  if (key.required_in(scene) || value != key.get(Scene{})) return false;
  return key.fallback != SceneKey::Default::value || is_empty(value);
}

std::string line_of(const SceneKey& key, const Scene& scene) {
  std::string line = std::string(key.name) + " = " + toml_text(key.get(scene));
  if (!key.unit.empty()) line += "  # " + std::string(key.unit);
  return line + "\n";
}

/// Whether a pair of this law has the key with a separate value.
bool is_written(const SceneKey& key, const Scene& scene, const ContactPair& pair) {
  if (key.name == "law") return pair.law != no_law && !is_rigid(pair.law);
  const bool of_law = key.laws.empty() || contains(key.laws, pair.law);
  return of_law && !is_empty(key.get(scene));
}

/// Whether a term has the key: one of samples has no harmonic, and a static one no phase.
bool is_written(const SceneKey& key, const Scene& scene, const ForcingTerm& term) {
  const bool sampled = !term.samples.empty();
  if (key.name == "harmonic") return !sampled;
  if (key.name == "phase") return !sampled && term.harmonic != 0;
  return !is_empty(key.get(scene));
}

/// One of the tables of a scene that may have several, with its keys that are written.
struct WrittenTable {
  std::string section;
  std::vector<SceneKey> keys;
};

template <class Entry>
std::vector<WrittenTable> written_tables(const Scene& scene, const std::vector<Entry>& entries,
                                         std::string (*section)(std::size_t),
                                         std::vector<SceneKey> (*keys)(std::size_t)) {
  std::vector<WrittenTable> tables;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    tables.push_back({section(i), keys(i)});
    std::erase_if(tables.back().keys,
                  [&](const SceneKey& key) { return !is_written(key, scene, entries[i]); });
  }
  return tables;
}

std::vector<WrittenTable> written_pairs(const Scene& scene) {
  return written_tables(scene, scene.contact.pairs, pair_section, pair_keys);
}

std::vector<WrittenTable> written_terms(const Scene& scene) {
  return written_tables(scene, scene.forcing.terms, term_section, term_keys);
}

std::string lines_of(const std::vector<WrittenTable>& tables, const Scene& scene) {
  std::string text;
  for (const auto& [section, keys] : tables) {
    text += "\n[[" + section.substr(0, section.find('[')) + "]]\n";
    for (const SceneKey& key : keys) text += line_of(key, scene);
  }
  return text;
}

template <class Content>
DocumentValue document_value(const Content& content) {
  return content;
}
template <class Entry>
DocumentValue document_value(const std::vector<Entry>& list) {
  DocumentList entries;
  for (const Entry& one : list)
    if constexpr (std::is_same_v<Entry, NumberOrText>)
      entries.push_back(std::visit([](const auto& content) { return DocumentScalar(content); }, one));
    else
      entries.emplace_back(one);
  return entries;
}

DocumentEntry entry_of(const SceneKey& key, const Scene& scene, std::string section) {
  const SceneValue value = key.get(scene);
  return {std::move(section),
          std::string(key.name),
          std::visit([](const auto& content) { return document_value(content); }, value),
          toml_text(value),
          0,
          ""};
}

}  // namespace

Document document_of(const Scene& scene, const std::string& name) {
  Document document;
  document.name = name;
  for (const SceneKey& key : scene_keys())
    if (key.belongs.holds(scene) && !is_unset(key, scene))
      document.entries.push_back(entry_of(key, scene, std::string(key.section)));
  for (const auto& tables : {written_pairs(scene), written_terms(scene)})
    for (const auto& [section, keys] : tables) {
      document.sections.push_back({section, 0});
      for (const SceneKey& key : keys) document.entries.push_back(entry_of(key, scene, section));
    }
  return document;
}

std::string write_scene(const Scene& scene) {
  std::string text;
  std::string_view section;
  std::string terms = lines_of(written_terms(scene), scene);  // which may be all that there is of the loads
  for (const SceneKey& key : scene_keys()) {
    if (!key.belongs.holds(scene) || is_unset(key, scene)) continue;
    if (key.section != section) {
      if (section == "contact") text += lines_of(written_pairs(scene), scene);
      if (key.section == "time" || key.section == "analysis") text += std::exchange(terms, "");
      text += (text.empty() ? "[" : "\n[") + std::string(key.section) + "]\n";
    }
    section = key.section;
    text += line_of(key, scene);
  }
  return text;
}

}  // namespace wavebalance::app

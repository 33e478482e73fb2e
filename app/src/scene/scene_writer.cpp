#include "wavebalance/app/scene/scene_writer.hpp"

#include <algorithm>
#include <utility>

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
  if (std::holds_alternative<bool>(value)) return false;
  if (key.required_in(scene) || value != key.get(Scene{})) return false;
  return key.fallback != SceneKey::Default::value || is_empty(value);
}

std::string line_of(const SceneKey& key, const Scene& scene) {
  std::string line = std::string(key.name) + " = " + toml_text(key.get(scene));
  if (!key.unit.empty()) line += "  # " + std::string(key.unit);
  return line + "\n";
}

/// Whether a pair of this law has the key, with a value of its own.
bool has_value(const Scene& scene, std::size_t index, const SceneKey& key) {
  const std::string& law = scene.contact.pairs[index].law;
  if (key.name == "law") return law != no_law && !is_rigid(law);
  const bool of_law = key.laws.empty() || std::find(key.laws.begin(), key.laws.end(), law) != key.laws.end();
  return of_law && !is_empty(key.get(scene));
}

/// Calls use(section, key) for each key of the pairs that is written.
template <class Use>
void for_each_pair_key(const Scene& scene, Use use) {
  for (std::size_t i = 0; i < scene.contact.pairs.size(); ++i)
    for (const SceneKey& key : pair_keys(i))
      if (has_value(scene, i, key)) use(pair_section(i), key);
}

std::string pair_lines(const Scene& scene) {
  std::string text, current;
  for_each_pair_key(scene, [&](const std::string& section, const SceneKey& key) {
    if (section != current) text += "\n[[contact.pairs]]\n";
    current = section;
    text += line_of(key, scene);
  });
  return text;
}

/// Calls use(section, key) for each key of the terms that is written.
template <class Use>
void for_each_term_key(const Scene& scene, Use use) {
  for (std::size_t i = 0; i < scene.forcing.terms.size(); ++i)
    for (const SceneKey& key : term_keys(i)) {
      const ForcingTerm& term = scene.forcing.terms[i];
      const bool sampled = !term.samples.empty();
      const bool optional =
          key.name == "samples" || key.name == "dofs" || key.name == "load" || key.name == "direction";
      if (optional && is_empty(key.get(scene))) continue;
      if (key.name == "harmonic" && sampled) continue;
      if (key.name == "phase" && (sampled || term.harmonic == 0)) continue;
      use(term_section(i), key);
    }
}

std::string term_lines(const Scene& scene) {
  std::string text, current;
  for_each_term_key(scene, [&](const std::string& section, const SceneKey& key) {
    if (section != current) text += "\n[[forcing.terms]]\n";
    current = section;
    text += line_of(key, scene);
  });
  return text;
}

DocumentValue document_value(const SceneValue& value) {
  return std::visit([](const auto& content) { return DocumentValue(content); }, value);
}

}  // namespace

Document document_of(const Scene& scene, const std::string& name) {
  Document document;
  document.name = name;
  for (const SceneKey& key : scene_keys()) {
    if (!key.belongs.holds(scene) || is_unset(key, scene)) continue;
    const SceneValue value = key.get(scene);
    document.entries.push_back(
        {std::string(key.section), std::string(key.name), document_value(value), toml_text(value), 0, ""});
  }
  for (std::size_t i = 0; i < scene.contact.pairs.size(); ++i)
    document.sections.push_back({pair_section(i), 0});
  for_each_pair_key(scene, [&](const std::string& section, const SceneKey& key) {
    const SceneValue value = key.get(scene);
    document.entries.push_back(
        {section, std::string(key.name), document_value(value), toml_text(value), 0, ""});
  });
  for (std::size_t i = 0; i < scene.forcing.terms.size(); ++i)
    document.sections.push_back({term_section(i), 0});
  for_each_term_key(scene, [&](const std::string& section, const SceneKey& key) {
    const SceneValue value = key.get(scene);
    document.entries.push_back(
        {section, std::string(key.name), document_value(value), toml_text(value), 0, ""});
  });
  return document;
}

std::string write_scene(const Scene& scene) {
  std::string text;
  std::string_view section;
  std::string terms = term_lines(scene);  // which may be all that there is of the loads
  for (const SceneKey& key : scene_keys()) {
    if (!key.belongs.holds(scene) || is_unset(key, scene)) continue;
    if (key.section != section) {
      if (section == "contact") text += pair_lines(scene);
      if (key.section == "time" || key.section == "analysis") text += std::exchange(terms, "");
      text += (text.empty() ? "[" : "\n[") + std::string(key.section) + "]\n";
    }
    section = key.section;
    text += line_of(key, scene);
  }
  return text;
}

}  // namespace wavebalance::app

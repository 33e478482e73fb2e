#include "wavebalance/app/compose/compose.hpp"

#include "files/contains.hpp"
#include "scene/scene_document.hpp"
#include "scene/term_reader.hpp"
#include "scene/toml_text.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 20;
constexpr std::string_view structure_section = "structure";

/// Sets a key that decides which others belong to a scene, unless its value is none.
void set_text(Scene& scene, const Document& document, const std::string& name) {
  const auto [section, key_name] = split_name(name);
  const DocumentEntry* entry = document.find(section, key_name);
  const SceneKey* key = find_scene_key(name);
  if (entry == nullptr || key == nullptr) return;
  const auto* text = std::get_if<std::string>(&entry->value);
  if (text != nullptr && contains(key->choices, *text)) key->set(scene, *text);
}

/// Whether a change names a key, to set it or to leave it out.
bool names_key(const SceneChange& change, const std::string& key) {
  return contains(change.unset, key) || std::ranges::any_of(change.set, [&](const std::string& one) {
           return one.substr(0, one.find('=')) == key;
         });
}

/// Whether the key at fault only has to go, as it belongs to what the change replaced. One of the structure
/// that is set stays, since without it the structure is another one.
bool is_left_over(const SceneError::Details& fault, const SceneChange& change) {
  const bool set = split_name(fault.key).first == structure_section && fault.found != "false";
  return fault.allowed.starts_with("does not belong to") && !names_key(change, fault.key) && !set;
}

/// Whether a law of the document has friction.
bool has_friction_law(const Document& document) {
  const std::vector<std::string_view>& laws = find_scene_key("contact.law")->choices;
  return std::ranges::any_of(document.entries, [&](const DocumentEntry& entry) {
    const auto* text = std::get_if<std::string>(&entry.value);
    return entry.key == "law" && text != nullptr && contains(laws, *text) && has_friction(*text);
  });
}

/// For a motion without damping and load.
bool acts_on_free_motion(const DocumentEntry& entry) {
  constexpr std::array<std::string_view, 5> names{"structure.damping", "structure.modal_damping",
                                                  "structure.stiffness_damping", "structure.loss_factor",
                                                  "forcing.weight"};
  return contains(names, entry.full_name());
}

}  // namespace

std::vector<std::string> keys_beside_analysis(const std::filesystem::path& file, const std::string& type,
                                              const std::vector<std::string>& overrides) {
  const Document given = parse_document(read_toml(file, most_bytes), file.string());
  Document document = given;
  apply_overrides(document, overrides);
  Scene scene;
  for (const char* name : {"structure.type", "contact.law", "contact.mass", "time.method"})
    set_text(scene, document, name);
  const SceneKey& analysis = *find_scene_key("analysis.type");
  if (!contains(analysis.choices, type))
    throw SceneError({"", 0, "--analysis " + type, "", "", "expected " + analysis.expected()});
  analysis.set(scene, type);
  const bool free_motion = type == "nonlinear_mode" && !has_friction_law(document);
  const bool without_bases = free_motion && is_rigid(scene.contact.law) && !redistributes_mass(scene);
  std::vector<std::string> names;
  for (const DocumentEntry& entry : given.entries) {
    const SceneKey* key = find_scene_key(entry.full_name());
    const bool stray =
        key != nullptr && entry.section != structure_section &&
        (key->belongs.broken_by(scene) == "analysis.type" || (without_bases && entry.section == "time"));
    if (stray || (free_motion && acts_on_free_motion(entry))) names.push_back(entry.full_name());
  }
  const bool terms = std::ranges::any_of(
      given.sections, [](const DocumentSection& one) { return is_term_section(one.name); });
  if (free_motion && terms) names.emplace_back("forcing.terms");
  return names;
}

SceneChange as_response(const Scene& scene) {
  SceneChange change{.analysis = "forced_response", .unset = {"time.tolerance"}};
  if (!solves_by_impacts(scene) && scene.time.trial.empty())
    change.set = {"time.trial=\"fourier\"", "time.weight=\"fourier\"", "time.functions=127"};
  return change;
}

SceneChange statistics_in_time() {
  return {.analysis = "time_stepping", .set = {"analysis.max_periods=200"}};
}

std::optional<Scene> changed_scene(const Scene& scene, const SceneChange& change) {
  constexpr int most_left_over = 100;
  const std::string text = write_scene(scene) + "\n" + change.added + "\n";
  std::vector<std::string> set = change.set, removed;
  if (!change.analysis.empty()) set.push_back("analysis.type=" + change.analysis);
  const Document document = parse_document(text, "scene");
  for (const DocumentEntry& entry : document.entries)
    if (contains(change.unset, entry.full_name())) removed.push_back(entry.full_name());
  for (int i = 0; i < most_left_over; ++i) {
    try {
      return parse_scene(text, "scene", set, removed, &scene);
    } catch (const SceneError& error) {
      if (!is_left_over(error.details(), change) || contains(removed, error.details().key))
        return std::nullopt;
      removed.push_back(error.details().key);
    }
  }
  return std::nullopt;
}

bool accepts(const Scene& scene, const SceneChange& change) {
  return changed_scene(scene, change).has_value();
}

}  // namespace wavebalance::app

#include "scene/pair_reader.hpp"

#include <set>

#include "files/contains.hpp"
#include "scene/keys/law_keys.hpp"
#include "scene/scene_reader.hpp"
#include "wavebalance/app/scene/scene_error.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

/// Reads the entry at one index.
class PairReader {
 public:
  PairReader(const Document& document, std::size_t index, Scene& scene)
      : document_(document),
        section_(pair_section(index)),
        scene_(scene),
        pair_(scene.contact.pairs[index]),
        keys_(pair_keys(index)) {}

  void read() {
    read_directions();
    read_law();
  }

 private:
  const DocumentEntry* entry(std::string_view name) const { return document_.find(section_, name); }
  const SceneKey& key(std::string_view name) const {
    return *std::ranges::find_if(keys_, [&](const SceneKey& one) { return one.name == name; });
  }

  [[noreturn]] void fail_without(std::string_view name, const std::string& more) const {
    fail_missing(document_, section_, name, key(name).expected() + more);
  }

  /// Sets a value from the file, or else its default.
  void take(std::string_view name) { take_key(document_, section_, key(name), scene_); }

  void read_directions() {
    if (entry("dofs") == nullptr) fail_without("dofs", "");
    read_direction({"dofs", "coefficients", pair_.dofs, pair_.coefficients});
    read_direction({"tangent", "tangent_coefficients", pair_.tangent, pair_.tangent_coefficients});
    read_direction({"second_tangent", "second_tangent_coefficients", pair_.second_tangent,
                    pair_.second_tangent_coefficients});
    take("side");
    take("name");
    take("unit");
    check_name();
  }

  /// Columns and legends have it, each once.
  void check_name() const {
    for (const ContactPair& other : scene_.contact.pairs)
      if (&other < &pair_ && !pair_.name.empty() && other.name == pair_.name)
        fail_at(document_, *entry("name"),
                "another of [[contact.pairs]] has this name; expected a unique one");
  }

  struct PairDirection {
    std::string_view dofs_name, weights_name;
    const std::vector<int>& dofs;
    const std::vector<double>& weights;
  };

  void read_direction(const PairDirection& one) {
    const DocumentEntry *dofs = entry(one.dofs_name), *weights = entry(one.weights_name);
    if (dofs == nullptr && weights != nullptr)
      fail_at(document_, *weights, "there is no " + std::string(one.dofs_name) + "; expected both, or none");
    if (dofs == nullptr) return;
    take(one.dofs_name);
    if (std::set<int>(one.dofs.begin(), one.dofs.end()).size() < one.dofs.size())
      fail_at(document_, *dofs, "a degree of freedom is there twice; expected each once");
    const std::string one_each =
        ", one for each of " + std::to_string(one.dofs.size()) + " " + std::string(one.dofs_name);
    if (weights == nullptr && one.dofs.size() > 2) fail_without(one.weights_name, one_each);
    take(one.weights_name);
    if (one.weights.size() != one.dofs.size())
      fail_at(document_, *weights,
              "there are " + std::to_string(one.weights.size()) + "; expected a list of numbers" + one_each);
    if (std::ranges::all_of(one.weights, [](double weight) { return weight == 0.0; }))
      fail_at(document_, *weights, "all are zero; expected a direction, with one that is not");
  }

  void read_law() {
    const DocumentEntry* own = entry("law");
    if (own != nullptr) {
      take("law");
      check_mixture(*own);
    } else {
      pair_.law = scene_.contact.law;
    }
    for (const SharedParameter& one : law_parameters()) read_parameter(one.first.name);
  }

  static std::string elastic_laws() {
    std::string names;
    for (const contact::LawEntry& law : contact::law_catalogue())
      if (law.name != no_law && !law.rigid)
        names += (names.empty() ? "\"" : ", \"") + std::string(law.name) + "\"";
    return names;
  }

  /// Laws of pairs are in addition to a law of the scene.
  void check_mixture(const DocumentEntry& own) const {
    if (scene_.contact.law == no_law)
      fail_at(
          document_, own,
          "does not belong to a scene with contact.law = \"none\", which has no contact; expected another "
          "contact.law, or none, where all pairs have a law");
    if (is_rigid(pair_.law) && !is_rigid(scene_.contact.law))
      fail_at(document_, own,
              "none is rigid beside contact.law = \"" + scene_.contact.law + "\"; expected " +
                  elastic_laws() + ", or contact.law = \"rigid\"");
  }

  void read_parameter(std::string_view name) {
    const DocumentEntry* own = entry(name);
    const contact::LawParameter* parameter = contact::law_entry(pair_.law).find(name);
    if (parameter == nullptr) {
      if (own != nullptr)
        fail_at(document_, *own,
                "does not belong to a pair with the law \"" + pair_.law + "\", whose keys are " +
                    parameter_names(pair_.law));
      return;
    }
    if (own == nullptr && parameter->required() && document_.find("contact", name) == nullptr)
      fail_without(name, ", here or in [contact]");
    take(name);
  }

  const Document& document_;
  std::string section_;
  Scene& scene_;
  ContactPair& pair_;
  std::vector<SceneKey> keys_;
};

/// The first of the laws of pairs that is one, before others a rigid one; nullptr where there is none.
const DocumentEntry* first_law(const Document& document) {
  const std::vector<SceneKey> keys = pair_keys(0);
  const auto law = std::ranges::find_if(keys, [](const SceneKey& key) { return key.name == "law"; });
  const DocumentEntry* first = nullptr;
  for (const DocumentEntry& entry : document.entries) {
    const auto* text = std::get_if<std::string>(&entry.value);
    if (!is_pair_section(entry.section) || entry.key != "law" || text == nullptr) continue;
    if (!contains(law->choices, *text)) continue;
    if (is_rigid(*text)) return &entry;
    if (first == nullptr) first = &entry;
  }
  return first;
}

}  // namespace

bool is_pair_section(std::string_view section) { return section.starts_with("contact.pairs["); }

std::size_t count_pairs(const Document& document) {
  return count_tables(document, "contact.pairs", most_pairs);
}

Document with_law_of_pairs(Document document) {
  const DocumentEntry* law = document.find("contact", "law") == nullptr ? first_law(document) : nullptr;
  if (law == nullptr) return document;
  for (const DocumentSection& section : document.sections)
    if (is_pair_section(section.name) && document.find(section.name, "law") == nullptr)
      throw SceneError(
          {document.name, section.line, "", section.name + ".law", "",
           "missing, where other pairs have one; expected a law here, or contact.law, which holds "
           "for pairs without one"});
  const DocumentEntry* restitution = document.find(law->section, "restitution");
  std::vector<DocumentEntry> shared{{"contact", "law", law->value, law->found, law->line, law->override}};
  if (restitution != nullptr && document.find("contact", "restitution") == nullptr)
    shared.push_back({"contact", "restitution", restitution->value, restitution->found, restitution->line,
                      restitution->override});
  document.entries.insert(document.entries.end(), shared.begin(), shared.end());
  return document;
}

void read_pairs(const Document& document, Scene& scene) {
  if (scene.contact.pairs.empty()) return;
  if (scene.structure.type != StructureType::matrices)
    throw SceneError({document.name, document.section_line(pair_section(0)), "", "contact.pairs", "",
                      "does not belong to a scene with structure.type = \"" + name_of(scene.structure.type) +
                          "\"; only with structure.type = \"matrices\""});
  for (std::size_t i = 0; i < scene.contact.pairs.size(); ++i) PairReader(document, i, scene).read();
}

}  // namespace wavebalance::app

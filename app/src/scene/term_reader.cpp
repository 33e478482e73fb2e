#include "scene/term_reader.hpp"

#include "scene/scene_reader.hpp"
#include "wavebalance/app/scene/scene_error.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

/// Reads the entry at one index.
class TermReader {
 public:
  TermReader(const Document& document, std::size_t index, Scene& scene)
      : document_(document), section_(term_section(index)), scene_(scene), term_(scene.forcing.terms[index]) {
    for (const SceneKey& key : term_keys(index)) take_key(document_, section_, key, scene_);
    check_samples();
    if (term_.harmonic == 0 && entry("phase") != nullptr)
      fail_at(document_, *entry("phase"), "does not belong to a static load, harmonic = 0");
    if (!term_.unit.empty() && term_.kind != LoadKind::base_acceleration)
      fail_at(document_, *entry("unit"), "only with kind = \"base_acceleration\"");
    check_table();
    check_place();
  }

 private:
  const DocumentEntry* entry(std::string_view name) const { return document_.find(section_, name); }

  [[noreturn]] void fail_without(const std::string& name, const std::string& expected) const {
    fail_missing(document_, section_, name, expected);
  }

  void check_samples() const {
    if (term_.samples.empty()) {
      if (entry("amplitude") == nullptr && term_.amplitude_table.empty())
        fail_without("amplitude", "a number in N, m, m/s^2 or kg m, or samples");
      return;
    }
    for (const std::string_view name : {"harmonic", "phase", "amplitude_table"})
      if (const DocumentEntry* given = entry(name))
        fail_at(document_, *given, "does not belong to a term with samples");
  }

  void check_table() const {
    const DocumentEntry* given = entry("amplitude_table");
    if (given == nullptr) return;
    if (term_.harmonic == 0) fail_at(document_, *given, "does not belong to a static load, harmonic = 0");
    const AnalysisType type = scene_.analysis.type;
    if (type == AnalysisType::amplitude_sweep || type == AnalysisType::nonlinear_mode)
      fail_at(document_, *given,
              "not with analysis.type = \"" + name_of(type) + "\"; expected amplitude alone");
  }

  void check_place() const {
    const StructureType type = scene_.structure.type;
    if (type != StructureType::matrices) {
      for (const std::string_view name : {"dofs", "load", "direction"})
        if (const DocumentEntry* given = entry(name))
          fail_at(document_, *given, "only with structure.type = \"matrices\"");
      if (term_.kind == LoadKind::base_displacement || term_.kind == LoadKind::unbalance)
        fail_at(document_, *entry("kind"),
                "only with structure.type = \"matrices\"; expected \"force\" or \"base_acceleration\"");
      return;
    }
    refuse_beside("load", LoadKind::force);
    refuse_beside("direction", LoadKind::base_acceleration);
    if (term_.kind == LoadKind::unbalance) check_unbalance();
    if (term_.kind == LoadKind::base_displacement && term_.dofs.empty())
      fail_without("dofs", "a list of integers, the rows that move");
    if (term_.kind == LoadKind::base_acceleration && term_.dofs.empty() && term_.direction.empty())
      fail_without("dofs",
                   "a list of integers, the rows that point along the motion of the base, or direction");
  }

  void check_unbalance() const {
    if (const DocumentEntry* given = entry("samples"))
      fail_at(document_, *given, "does not belong to an unbalance; expected harmonic and phase");
    if (term_.harmonic == 0)
      fail_at(document_, *entry("harmonic"), "an unbalance turns; expected 1 or more, times the frequency");
    if (term_.dofs.empty())
      fail_without("dofs", "the two rows of the plane in which it turns, or one of them");
    if (term_.dofs.size() > 2)
      fail_at(document_, *entry("dofs"),
              "expected the two rows of the plane in which it turns, or one of them");
  }

  /// The key belongs to terms of one kind, and replaces dofs.
  void refuse_beside(std::string_view name, LoadKind kind) const {
    const DocumentEntry* given = entry(name);
    if (given == nullptr) return;
    if (term_.kind != kind) fail_at(document_, *given, "only with kind = \"" + name_of(kind) + "\"");
    if (!term_.dofs.empty()) fail_at(document_, *given, "there are dofs, too; expected one or the other");
  }

  const Document& document_;
  std::string section_;
  Scene& scene_;
  ForcingTerm& term_;
};

}  // namespace

bool is_term_section(std::string_view section) { return section.starts_with("forcing.terms["); }

std::size_t count_terms(const Document& document) {
  return count_tables(document, "forcing.terms", most_terms);
}

void read_terms(const Document& document, Scene& scene) {
  if (scene.forcing.terms.empty()) return;
  if (scene.analysis.type == AnalysisType::nonlinear_mode && !names_friction(scene.contact))
    throw SceneError({document.name, document.section_line(term_section(0)), "", "forcing.terms", "",
                      "does not belong to a scene with analysis.type = \"nonlinear_mode\", a motion without "
                      "any load, unless friction makes it begin at rest under static ones"});
  for (std::size_t i = 0; i < scene.forcing.terms.size(); ++i) TermReader(document, i, scene);
}

}  // namespace wavebalance::app


#include "compose/compose_parts.hpp"
#include "matrices/structure_files.hpp"
#include "scene/scene_reader.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/structure_model.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

void check_damping(const Document& document, const Scene& scene) {
  const Structure& structure = scene.structure;
  const bool file = !structure.matrices.damping.empty();
  const int given = static_cast<int>(structure.stiffness_damping > 0.0) +
                    static_cast<int>(structure.modal_damping > 0.0) + static_cast<int>(file);
  const auto names = {"structure.damping", "structure.modal_damping", "structure.stiffness_damping"};
  if (given > 1) {
    const auto first = std::ranges::find_if(names, [&](const char* name) {
      const SceneKey& key = *find_scene_key(name);
      return document.find(key.section, key.name) != nullptr && key.get(scene) != key.get(Scene{});
    });
    fail_rule(
        document, {*first},
        "another damping is given as well; expected one of damping, modal_damping and stiffness_damping");
  }
  if (given == 1 && scene.analysis.type == AnalysisType::nonlinear_mode && !names_friction(scene.contact))
    fail_rule(document,
              {file                            ? "structure.damping"
               : structure.modal_damping > 0.0 ? "structure.modal_damping"
                                               : "structure.stiffness_damping"},
              file ? "expected none for a nonlinear mode, which is a motion without damping"
                   : "expected 0 for a nonlinear mode, which is a motion without damping");
}

/// Only contacts with mass hold a free structure.
void check_free(const Document& document, const Scene& scene) {
  if (!scene.structure.matrices.free) return;
  if (names_friction(scene.contact) && scene.analysis.type == AnalysisType::nonlinear_mode)
    fail_rule(document, {"structure.free", "contact.law"},
              "not with friction, whose modes require a structure that is not free; expected false");
  if (names_friction(scene.contact) && scene.contact.mass == ContactMass::redistribute)
    fail_rule(document, {"contact.mass", "structure.free"},
              "not of a structure that is free to move; expected \"keep\"");
  if (is_rigid(scene.contact.law) && !has_impacts(scene.contact))
    fail_rule(document, {"structure.free", "contact.law"},
              "not with contact.law = \"rigid\", which removes the mass of the contacts; expected a "
              "stiff \"linear\" law");
  if (scene.analysis.branches)
    fail_rule(document, {"structure.free", "analysis.branches"},
              "not with analysis.branches; expected analysis.branches = false");
}

/// The speed belongs to matrices that vary with it. Results of a single stiffness cannot depend on it.
void check_turning(const Document& document, const Scene& scene) {
  const MatricesStructure& structure = scene.structure.matrices;
  const bool turns = !structure.gyroscopic.empty() || !structure.spin_stiffness.empty();
  if (!turns && structure.spin_speed > 0.0)
    fail_rule(document, {"structure.spin_speed"},
              "expected structure.gyroscopic or structure.spin_stiffness beside it");
  if (turns && structure.spin_speed == 0.0 && integrates_in_time(scene.analysis.type) &&
      varies_frequency(scene.analysis))
    fail_missing(document, "structure", "spin_speed",
                 "a number in rad/s, at which the structure turns along the whole diagram");
  if (!turns_along_curve(scene) || structure.spin_stiffness.empty()) return;
  const std::string instead =
      ", as structure.spin_stiffness changes the stiffness along the sweep; expected structure.spin_speed > 0, or ";
  if (scene.structure.modal_damping > 0.0)
    fail_rule(document, {"structure.modal_damping"},
              "not with modes that vary" + instead + "damping or stiffness_damping in its place");
  if (structure.free)
    fail_rule(document, {"structure.free"}, "not with springs that vary" + instead + "false");
  if (redistributes_mass(scene))
    fail_rule(document, {"contact.mass", "contact.law"},
              "not with modes that vary" + instead + "contact.mass = \"keep\" and a law that is not rigid");
}

/// It is defined for periodic motions that are solved for as such.
void check_loss_factor(const Document& document, const Scene& scene) {
  if (scene.structure.loss_factor == 0.0) return;
  if (scene.analysis.type == AnalysisType::nonlinear_mode && !names_friction(scene.contact))
    fail_rule(document, {"structure.loss_factor"},
              "expected 0 for a nonlinear mode, which is a motion without damping");
  const std::string instead =
      scene.structure.type == StructureType::bar
          ? "stiffness_damping = loss_factor / omega, which damps as much at the angular frequency omega"
          : "modal_damping = loss_factor / 2, which damps each mode as much at its own frequency";
  if (integrates_in_time(scene.analysis.type))
    fail_rule(
        document, {"structure.loss_factor", "analysis.type"},
        "not with time stepping: structural damping has no equation in time; expected 0, or " + instead);
  if (scene.analysis.branches)
    fail_rule(
        document, {"structure.loss_factor", "analysis.branches"},
        "not with analysis.branches, which need stability: structural damping has no equation in time; expected "
        "0, or " +
            instead);
}

void check_blade(const Document& document, const Structure& structure) {
  const auto& axis = structure.blade.rotation_axis;
  if (std::hypot(axis[0], axis[1], axis[2]) == 0.0)
    fail_rule(document, {"structure.rotation_axis"}, "expected a direction, which is not zero");
  const std::int64_t interior = blade_unknowns(structure.blade) - 3 * tip_corners(structure.blade);
  if (structure.kept_modes > interior)
    fail_rule(document, {"structure.kept_modes", "structure.span_elements"},
              "expected at most " + std::to_string(interior) +
                  ", the degrees of freedom of the mesh without the corner nodes of the tip");
}

/// Contacts of matrices are directions along single degrees of freedom or pairs.
void check_directions(const Document& document, const Scene& scene) {
  const bool dofs = !scene.structure.matrices.contact_dofs.empty(), pairs = !scene.contact.pairs.empty();
  if (dofs && pairs)
    fail_rule(document, {"structure.contact_dofs"},
              "there are [[contact.pairs]] too; expected one or the other");
  if (!dofs && !pairs)
    fail_rule(document, {"structure.contact_dofs"},
              "missing; expected a list of integers, or [[contact.pairs]]");
}

void check_gaps(const Document& document, const Scene& scene) {
  const int contacts = contact_count(scene);
  const auto given = static_cast<int>(scene.contact.gaps.size());
  if (given > 0 && !scene.contact.pairs.empty())
    fail_rule(document, {"contact.gap"},
              "there are [[contact.pairs]], each of which may have its own gap; expected one number");
  if (given > 0 && given != contacts)
    fail_rule(document, {"contact.gap"},
              "there are " + std::to_string(given) + " numbers; expected one, or one for each of " +
                  (contacts == 1 ? "1 degree" : std::to_string(contacts) + " degrees") +
                  " of freedom in contact");
}

/// One file is mass and stiffness of an oscillator with m = k at most.
void check_same_file(const Document& document, const MatricesStructure& matrices, Eigen::Index rows) {
  std::error_code ignored;
  if (rows > 1 && std::filesystem::equivalent(matrices.mass, matrices.stiffness, ignored))
    fail_rule(document, {"structure.stiffness"}, "is the file of structure.mass, too; expected another one");
}

void check_files(const Document& document, Scene& scene) {
  try {
    const auto files = structure_files(scene);
    scene.structure.matrices.files.contents = files;
    check_same_file(document, scene.structure.matrices, files->matrices.stiffness.rows());
    check_against_files(scene, *files);
  } catch (const StructureFault& fault) {
    fail_rule(document, {fault.key()}, fault.what());
  }
}

}  // namespace

void fail_rule(const Document& document, std::initializer_list<std::string_view> names,
               const std::string& rule) {
  for (const auto name : names) {
    const auto [section, key] = split_name(std::string(name));
    if (const auto* entry = document.find(section, key)) fail_at(document, *entry, rule);
  }
  const std::string first(*names.begin());
  throw SceneError({document.name, document.section_line(split_name(first).first), "", first, "", rule});
}

void check_structure_rules(const Document& document, Scene& scene) {
  const Structure& structure = scene.structure;
  const bool massless = structure.massless_tip || redistributes_mass(scene);
  if (structure.type == StructureType::bar && massless && structure.elements < 2)
    fail_rule(document, {"structure.elements"},
              "expected 2 or more with massless_tip or rigid contact: the tip's mass goes to a neighbour");
  check_damping(document, scene);
  check_loss_factor(document, scene);
  if (structure.type == StructureType::blade) check_blade(document, structure);
  if (structure.type == StructureType::matrices) {
    check_directions(document, scene);
    check_files(document, scene);
    check_free(document, scene);
    check_turning(document, scene);
  }
  check_gaps(document, scene);
}

}  // namespace wavebalance::app

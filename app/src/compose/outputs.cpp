#include "wavebalance/app/compose/outputs.hpp"

#include <algorithm>
#include <cstdlib>

#include "compose/load_places.hpp"
#include "compose/scene_rules.hpp"
#include "compose/structure_facts.hpp"
#include "compose/structure_files.hpp"
#include "files/contains.hpp"
#include "scene/scene_reader.hpp"
#include "scene/spelling.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/scene/contacts.hpp"

namespace wavebalance::app {
namespace {

bool is_rotation(const StructureFiles& files, int row) {
  const int direction = files.dof_map ? files.dof_map->dof(row).direction : 1;
  return direction > 3 && direction <= 6;
}

Output output_of(const Scene& scene, int dof) {
  Output output;
  output.dof = dof;
  if (scene.structure.type == StructureType::matrices) {
    const auto files = structure_files(scene);
    output.name = files->row_name(std::abs(dof) - 1);
    if (is_rotation(*files, std::abs(dof) - 1)) output.unit = "rad";
  } else {
    output.name = "node " + std::to_string(std::abs(dof));
  }
  if (dof < 0) output.name = "-" + output.name;
  output.title = output.name;
  output.column = column_of(output.name);
  return output;
}

/// Output::closed_by of a contact, of which `row` is this direction.
int closing_direction(const SceneContact& contact, int row) {
  const bool never_opens =
      acts_everywhere(contact.law) || (has_friction(contact.law) && contact.directions == 1);
  return never_opens ? -1 : row - contact.place;
}

/// The displacement of a row of the files from those of the unknowns.
Eigen::RowVectorXd row_of_unknowns(const StructureFiles& files, int row) {
  const auto place = [row](const std::vector<int>& rows) -> Eigen::Index {
    const auto found = std::find(rows.begin(), rows.end(), row);
    return found == rows.end() ? -1 : found - rows.begin();
  };
  if (const Eigen::Index condensed = place(files.massless); condensed >= 0)
    return files.followers.row(condensed);
  return Eigen::RowVectorXd::Unit(std::ssize(files.rows), place(files.rows));
}

}  // namespace

std::string column_of(const std::string& name) {
  std::string column;
  for (const char c : name)
    column += c == '-' ? "minus_" : c == '#' ? "" : std::string(1, c == ' ' ? '_' : c);
  return column;
}

std::string displacement_unit(const Scene& scene, const SceneContact& contact) {
  if (scene.structure.type != StructureType::matrices) return "m";
  const auto files = structure_files(scene);
  const auto rotates = [&](int dof) { return is_rotation(*files, dof - 1); };
  return std::ranges::all_of(contact.dofs, rotates) ? "rad" : "m";
}

std::string displacement_unit(const Scene& scene) {
  const std::vector<SceneContact> contacts = contact_places(scene);
  const auto rotates = [&](const SceneContact& one) { return displacement_unit(scene, one) == "rad"; };
  return !contacts.empty() && std::ranges::all_of(contacts, rotates) ? "rad" : "m";
}

std::vector<Output> outputs_of(const Scene& scene) {
  std::vector<Output> outputs;
  for (const int dof : scene.analysis.outputs) outputs.push_back(output_of(scene, dof));
  if (!scene.analysis.contact_outputs) return outputs;
  const std::vector<SceneContact> contacts = contacts_of(scene);
  std::vector<std::string> places;
  if (scene.structure.type == StructureType::matrices) places = contact_names(scene);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const std::string name = name_of(contacts[i]);
    const std::string title = places.empty() ? name : name + ", " + places[i];
    outputs.push_back({.name = name,
                       .title = title,
                       .column = column_of(name),
                       .unit = displacement_unit(scene, contacts[i]),
                       .contact = static_cast<int>(i),
                       .closed_by = closing_direction(contacts[i], static_cast<int>(i))});
  }
  return outputs;
}

std::optional<std::size_t> leading_output(const std::vector<Output>& outputs, const Scene& scene) {
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (outputs[i].name == scene.analysis.peak_of) return i;
  if (outputs.empty() || outputs.front().is_contact()) return std::nullopt;
  return 0;
}

Eigen::MatrixXd rows_of_outputs(const std::vector<Output>& outputs, const Scene& scene,
                                const StructureModel& model) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(std::ssize(outputs), model.size());
  const bool matrices = scene.structure.type == StructureType::matrices;
  const auto files = matrices ? structure_files(scene) : nullptr;
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].is_contact()) continue;
    const int row = std::abs(outputs[i].dof) - 1;
    const Eigen::RowVectorXd unknowns =
        matrices ? row_of_unknowns(*files, row) : Eigen::RowVectorXd::Unit(model.unknowns, row);
    rows.row(Eigen::Index(i)) = (outputs[i].dof < 0 ? -1.0 : 1.0) *
                                (model.reduced() ? Eigen::RowVectorXd(unknowns * model.recovery) : unknowns);
  }
  return rows;
}

namespace {

void check_output_dofs(const Document& document, const Scene& scene) {
  const std::vector<int>& outputs = scene.analysis.outputs;
  try {
    if (scene.structure.type == StructureType::matrices) {
      const auto files = structure_files(scene);
      check_dofs(outputs, files->file_rows(), "analysis.outputs");
      check_unknown(outputs, *files, "analysis.outputs");
    } else {
      check_dofs(outputs, scene.structure.elements, "analysis.outputs");
    }
  } catch (const StructureFault& fault) {
    fail_rule(document, {fault.key()}, fault.what());
  }
}

void check_peak(const Document& document, const Scene& scene) {
  const std::string& wanted = scene.analysis.peak_of;
  if (wanted.empty()) return;
  std::vector<std::string> names;
  for (const Output& output : outputs_of(scene)) names.push_back(output.name);
  if (contains(names, wanted)) return;
  fail_rule(document, {"analysis.peak_of"},
            names.empty() ? "there are no outputs; expected analysis.outputs or contact_outputs beside it"
                          : "expected one of the outputs, which are " + joined(names));
}

}  // namespace

void check_outputs(const Document& document, const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  if (!analysis.outputs.empty()) check_output_dofs(document, scene);
  check_peak(document, scene);
  if (!analysis.has_outputs()) return;
  const bool response =
      analysis.type == AnalysisType::forced_response || analysis.type == AnalysisType::time_stepping;
  if (response && analysis.motion_points > 0 && analysis.output_points % analysis.motion_points != 0)
    fail_rule(document, {"analysis.motion_points"},
              "expected a divisor of analysis.output_points = " + std::to_string(analysis.output_points) +
                  " beside outputs, or 0");
  if (2 * analysis.output_harmonics * std::max(1, analysis.subharmonic) >= analysis.output_points)
    fail_rule(
        document, {"analysis.output_harmonics"},
        "expected less than half of analysis.output_points = " + std::to_string(analysis.output_points));
}

}  // namespace wavebalance::app

#include "wavebalance/app/compose/outputs.hpp"

#include <fmt/format.h>

#include <charconv>

#include "compose/compose_parts.hpp"
#include "files/contains.hpp"
#include "matrices/carried_rows.hpp"
#include "matrices/dof_names.hpp"
#include "matrices/loads.hpp"
#include "matrices/structure_facts.hpp"
#include "matrices/structure_files.hpp"
#include "scene/scene_reader.hpp"
#include "scene/spelling.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

bool is_rotation(const StructureFiles& files, int row) {
  const int direction = files.dof_map ? files.dof_map->dof(row).direction : 1;
  return direction > 3 && direction <= 6;
}

[[noreturn]] void fail_at_place(const OutputWords& words) {
  throw std::invalid_argument(fmt::format(
      "\"{}\" is no place; expected \"row 7\", a node of structure.dof_map such as \"node 1042 z\", or \"node 3\" of "
      "a bar",
      words.place));
}

/// The whole number at the end of "row 7"; none in other texts.
std::optional<int> number_after(std::string_view text, std::string_view noun) {
  if (!text.starts_with(noun)) return std::nullopt;
  text.remove_prefix(noun.size());
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

void set_numbered_place(Output& output, int number, int size) {
  if (number < 1 || number > size)
    throw std::invalid_argument(
        fmt::format("there is no degree of freedom {}; expected 1..{}", number, size));
  output.rows = {number - 1};
}

/// The rows of a place, and its name, from the dof map where this has the row. Sets whether it rotates,
/// which of matrices without a dof map is not known.
void set_place(Output& output, OutputWords& words, const Scene& scene, std::optional<bool>& rotation) {
  const bool negative = words.place.starts_with('-');
  std::string place = negative ? words.place.substr(1) : words.place;
  if (scene.structure.type != StructureType::matrices) {
    const std::optional<int> node = number_after(place, "node ");
    if (!node) fail_at_place(words);
    set_numbered_place(output, *node, scene.structure.elements);
    rotation = false;
  } else {
    const auto files = structure_files(scene);
    const auto named = named_dof(place);
    if (named && !files->dof_map)
      throw std::invalid_argument("names a node, but the scene has no structure.dof_map; expected this file");
    if (named) {
      output.rows = rows_of(*files->dof_map, *named);
      if (output.rows.empty())
        throw std::invalid_argument(
            absent_text(*files->dof_map, named->dof, scene.structure.matrices.dof_map));
    } else {
      const std::optional<int> row = number_after(place, "row ");
      if (!row) fail_at_place(words);
      set_numbered_place(output, *row, int(files->file_rows()));
    }
    if (output.rows.size() == 1) place = files->row_name(output.rows.front());
    if (files->dof_map) rotation = is_rotation(*files, output.rows.front());
    for (const int row : output.rows)
      if (std::ranges::binary_search(files->moving, row))
        throw std::invalid_argument(fmt::format(
            "degree of freedom {} moves with a base displacement; expected one that does not", row + 1));
  }
  output.weight = (negative ? -1.0 : 1.0) / double(output.rows.size());
  words.place = (negative ? "-" : "") + place;
}

/// Adds how far a base carries the rows of an output, which the unknowns do not have.
void add_carried(Output& output, const Scene& scene) {
  if (scene.structure.type != StructureType::matrices) return;
  const auto files = structure_files(scene);
  const Eigen::MatrixXd carried = carried_rows(scene, *files);
  if (carried.size() == 0) return;
  for (const ForcingTerm& term : scene.forcing.terms) {
    if (term.kind != LoadKind::base_displacement) continue;
    const Eigen::VectorXd moved = carried_by(term, carried, *files);
    double share = 0.0;
    for (const int row : output.rows) {
      const auto place = std::ranges::lower_bound(files->rows, row);
      if (place != files->rows.end() && *place == row)
        share += output.weight * moved[place - files->rows.begin()];
    }
    if (share != 0.0) output.added.push_back({share * harmonics_of(term), 0});
  }
}

Output output_of(const Scene& scene, const std::string& text) {
  OutputWords words = output_words(text);
  Output output;
  std::optional<bool> rotation;
  set_place(output, words, scene, rotation);
  const OutputUnit& unit = output_unit(words, rotation);
  output.name = output_name(words);
  output.title = output.name;
  output.column = column_of(output.name);
  output.unit = unit.name == "um" ? "µm" : std::string(unit.name);
  output.suffix = unit.suffix;
  output.size = unit.size;
  output.derivative = derivative_of(words.quantity);
  set_frame(output, words, scene);
  add_carried(output, scene);
  return output;
}

/// Output::closed_by of a contact, of which `row` is this direction.
int closing_direction(const SceneContact& contact, int row) {
  const bool never_opens =
      acts_everywhere(contact.law) || (has_friction(contact.law) && contact.directions == 1);
  return never_opens ? -1 : row - contact.place;
}

/// The displacement of a row of the files from the unknowns.
Eigen::RowVectorXd row_of_unknowns(const StructureFiles& files, int row) {
  const auto place = [row](const std::vector<int>& rows) -> Eigen::Index {
    const auto found = std::ranges::find(rows, row);
    return found == rows.end() ? -1 : found - rows.begin();
  };
  if (const Eigen::Index condensed = place(files.massless); condensed >= 0)
    return files.followers.row(condensed);
  return Eigen::RowVectorXd::Unit(std::ssize(files.rows), place(files.rows));
}

/// Balances of other bases have no second derivative at a point, and impacts none at all.
void check_acceleration(const Document& document, const Scene& scene) {
  if (has_impacts(scene.contact))
    fail_rule(document, {"analysis.outputs"},
              "an impact has no finite acceleration; expected velocities, or contact.restitution left out");
  const bool of_mode = scene.analysis.type == AnalysisType::nonlinear_mode;
  if (of_mode && !is_elastic_mode(scene) && !is_damped_mode(scene))
    fail_rule(
        document, {"analysis.outputs"},
        "a mode of rigid contacts with mass has no finite acceleration where they close; expected velocities, "
        "or a stiff \"linear\" law");
  const bool by_bases = !integrates_in_time(scene.analysis.type) && !solves_exactly(scene) &&
                        !scene.analysis.exact && !scene.time.trial.empty();
  if (by_bases && is_wavelet(scene.time.trial))
    fail_rule(document, {"analysis.outputs"},
              "functions of time.trial = \"" + scene.time.trial +
                  "\" have no second derivative at each instant; expected time.trial = \"fourier\" beside an "
                  "acceleration");
}

void check_output_words(const Document& document, const Scene& scene) {
  std::vector<std::string> names;
  for (const std::string& text : scene.analysis.outputs) {
    try {
      const Output output = output_of(scene, text);
      std::string name = output.name;  // whatever its sign
      std::erase(name, '-');
      if (contains(names, name)) throw std::invalid_argument(name + " is there twice; expected each once");
      names.push_back(name);
      if (output.derivative == 2) check_acceleration(document, scene);
      const bool in_section = output.derivative == 0 && output.added.empty() && output.over.empty();
      if (scene.analysis.type == AnalysisType::bifurcation_diagram && !in_section)
        throw std::invalid_argument(
            "a section has the displacement and the velocity of a place in the frame of the scene; expected the "
            "place alone");
    } catch (const std::invalid_argument& error) {
      fail_rule(document, {"analysis.outputs"}, toml_text(text) + ": " + error.what());
    } catch (const StructureFault& fault) {
      fail_rule(document, {fault.key()}, fault.what());
    } catch (const SamplesFault& fault) {
      fail_rule(document, {"forcing.terms"}, fault.what());
    }
  }
}

void check_peak(const Document& document, const Scene& scene) {
  if (scene.analysis.peak_of.empty()) return;
  const std::string wanted = peak_name(scene);
  std::vector<std::string> names;
  for (const Output& output : outputs_of(scene)) {
    if (output.name == wanted || output.number == wanted) return;
    names.push_back(output.name);
  }
  fail_rule(document, {"analysis.peak_of"},
            names.empty() ? "there are no outputs; expected analysis.outputs or contact_outputs beside it"
                          : "expected one of the outputs, which are " + joined(names));
}

}  // namespace

std::string column_of(const std::string& name) {
  std::string column;
  for (const char c : name)
    column += c == '-' ? "minus_" : c == '#' ? "" : std::string(1, c == ' ' ? '_' : c);
  return column;
}

std::string Output::column_of(const std::string& value) const {
  return column + "_" + value + (suffix.empty() ? "" : "_" + suffix);
}

std::string Output::quantity_words(const std::string& of_displacement) const {
  if (!over.empty()) return "Transmissibility";
  return derivative == 0 ? of_displacement : derivative == 1 ? "Velocity" : "Acceleration";
}

std::string displacement_unit(const Scene& scene, const SceneContact& contact) {
  if (scene.structure.type != StructureType::matrices) return "m";
  if (contact.pair && !scene.contact.pairs[*contact.pair].unit.empty())
    return scene.contact.pairs[*contact.pair].unit;
  const auto files = structure_files(scene);
  const auto rotates = [&](int dof) { return is_rotation(*files, dof - 1); };
  return std::ranges::all_of(contact.dofs, rotates) ? "rad" : "m";
}

std::string displacement_unit(const Scene& scene) {
  const std::vector<SceneContact> contacts = contact_places(scene);
  const auto rotates = [&](const SceneContact& one) { return displacement_unit(scene, one) == "rad"; };
  return !contacts.empty() && std::ranges::all_of(contacts, rotates) ? "rad" : "m";
}

std::string force_unit(const std::string& displacement_unit) {
  return displacement_unit == "rad" ? "N m" : "N";
}

std::vector<Output> outputs_of(const Scene& scene) {
  std::vector<Output> outputs;
  for (const std::string& text : scene.analysis.outputs) outputs.push_back(output_of(scene, text));
  if (!scene.analysis.contact_outputs) return outputs;
  const std::vector<SceneContact> contacts = contacts_of(scene);
  std::vector<std::string> places;
  if (scene.structure.type == StructureType::matrices) places = contact_names(scene);
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (is_signal(contacts[i])) continue;
    const std::string name = name_of(contacts[i]);
    const bool placed = !places.empty() && contacts[i].name.empty();
    const std::string title = placed ? name + ", " + places[i] : name;
    outputs.push_back({.name = name,
                       .title = title,
                       .column = column_of(name),
                       .unit = displacement_unit(scene, contacts[i]),
                       .suffix = displacement_unit(scene, contacts[i]),
                       .contact = static_cast<int>(i),
                       .number = number_text_of(contacts[i]),
                       .closed_by = closing_direction(contacts[i], static_cast<int>(i))});
  }
  return outputs;
}

std::string peak_name(const Scene& scene) {
  if (scene.analysis.peak_of.empty()) return "";
  return output_name(output_words(scene.analysis.peak_of));
}

std::optional<std::size_t> leading_output(const std::vector<Output>& outputs, const Scene& scene) {
  const std::string wanted = peak_name(scene);
  for (std::size_t i = 0; i < outputs.size(); ++i)
    if (!wanted.empty() && (outputs[i].name == wanted || outputs[i].number == wanted)) return i;
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
    Eigen::RowVectorXd unknowns = Eigen::RowVectorXd::Zero(model.unknowns);
    for (const int row : outputs[i].rows)
      unknowns += outputs[i].weight *
                  (matrices ? row_of_unknowns(*files, row) : Eigen::RowVectorXd::Unit(model.unknowns, row));
    const Eigen::RowVectorXd own = model.reduced() ? Eigen::RowVectorXd(unknowns * model.recovery) : unknowns;
    rows.row(Eigen::Index(i)).head(own.size()) = own;  // signals are behind them
  }
  return rows;
}

void check_outputs(const Document& document, const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  check_output_words(document, scene);
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

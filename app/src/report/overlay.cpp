#include "report/overlay.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "files/contains.hpp"
#include "files/missing.hpp"
#include "plot/plot_parts.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/files/output.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/files/summary.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

namespace fs = std::filesystem;

/// Measures of contact displacements.
const std::array<OverlayQuantity, 4>& contact_quantities() {
  static const std::array<OverlayQuantity, 4> quantities{
      {{"max", quantities::max_displacement.column(), "Largest displacement"},
       {"min", quantities::min_displacement.column(), "Least displacement"},
       {"max_abs", "max_abs_displacement_m", "Largest absolute displacement"},
       {"rms", quantities::rms_displacement.column(), "rms displacement"}}};
  return quantities;
}

OverlayQuantity quantity_of(const Output& output) {
  return {output.name, output.column_of("half_peak_to_peak"),
          output.names_quantity() ? capitalised(output.title) : "Vibration of " + output.title, output.unit,
          output.column + (output.suffix.empty() ? "" : "_" + output.suffix)};
}

bool holds(const fs::path& folder, const char* name) {
  std::error_code ignored;
  return fs::is_regular_file(folder / name, ignored);
}

Scene scene_in(const fs::path& folder) {
  if (!holds(folder, "scene.toml"))
    throw IoError(folder, "holds no scene.toml; expected the folder of the results of `wavebalance run`");
  return load_scene(folder / "scene.toml");
}

/// Keys of the structure that a nonlinear mode or another reduction may have otherwise.
bool may_differ(std::string_view key) {
  static const std::set<std::string_view> keys{"damping", "stiffness_damping", "modal_damping", "kept_modes",
                                               "massless_tip"};
  return keys.contains(key);
}

void require_same_directions(const Scene& first, const Scene& scene, const fs::path& place) {
  const std::vector<SceneContact> here = contact_places(scene), there = contact_places(first);
  const auto same = [](const SceneContact& one, const SceneContact& other) {
    return one.dofs == other.dofs && one.coefficients == other.coefficients;
  };
  if (!std::equal(here.begin(), here.end(), there.begin(), there.end(), same))
    throw std::invalid_argument(place.string() +
                                " has other [[contact.pairs]] than the first folder; expected the same "
                                "structure in all of them");
}

void require_same_structure(const Scene& first, const Scene& scene, const fs::path& place) {
  for (const SceneKey& key : scene_keys()) {
    if (key.section != "structure" || may_differ(key.name)) continue;
    const SceneValue here = key.get(scene), there = key.get(first);
    if (here != there)
      throw std::invalid_argument(
          fmt::format("{} is of another structure than the first folder: {} is {} and not {}", place.string(),
                      key.full_name(), toml_text(here), toml_text(there)));
  }
  require_same_directions(first, scene, place);
}

/// Modes and responses are over the frequency.
void require_same_axis(const Scene& first, const Scene& scene, const fs::path& place) {
  const SweepAxis axis = sweep_axis(first), other = sweep_axis(scene);
  if (axis.column() != other.column())
    throw std::invalid_argument(
        fmt::format("{} is over the {} in {}, and the first folder over the {} in {}; "
                    "expected one for all of them",
                    place.string(), other.quantity, other.unit, axis.quantity, axis.unit));
}

/// The names of folders if they differ, else the paths.
std::vector<std::string> labels_of(std::span<const fs::path> folders) {
  std::vector<std::string> names;
  for (const fs::path& folder : folders) {
    const fs::path plain_path = folder.lexically_normal();
    names.push_back((plain_path.has_filename() ? plain_path : plain_path.parent_path()).filename().string());
  }
  if (std::set<std::string>(names.begin(), names.end()).size() == names.size()) return names;
  names.clear();
  for (const fs::path& folder : folders) names.push_back(folder.string());
  return names;
}

std::vector<double> column_of(const Table& table, const std::string& name, const fs::path& file) {
  if (!table.has_column(name))
    throw IoError(file, "has no column " + name + "; an earlier version wrote it: run its scene again");
  return table.numbers(name);
}

std::vector<double> unstable_of(const Table& table) {
  return table.has_column("unstable") ? table.numbers("unstable")
                                      : std::vector<double>(table.rows(), missing);
}

void add_sweep(std::vector<OverlayCurve>& curves, const fs::path& file, const std::string& label,
               const std::string& column, const SweepAxis& axis) {
  const Table all = read_csv(file);
  const auto add = [&](const Table& table, const std::string& kind, int number) {
    curves.push_back({number == 0 ? label : fmt::format("{}, {} {}", label, kind, number),
                      number == 0 ? axis.quantity + "_sweep" : kind,
                      column_of(table, axis.column(), file),
                      {},
                      column_of(table, column, file),
                      unstable_of(table)});
  };
  // The curves of a table by their number in a column, the first of which is 0 in all columns.
  const auto add_each = [&](const Table& table, const std::string& kind, int first) {
    for (int number = first; table.has_column(kind); ++number) {
      const Table one = table.where(kind, std::to_string(number));
      if (one.empty()) return;
      add(one, kind, number);
    }
  };
  const std::string isola(quantities::isola.name);
  const Table along = all.has_column(isola) ? all.where(isola, "0") : all;
  if (!along.has_column("branch") && !along.empty()) add(along, "branch", 0);
  add_each(along, "branch", 0);
  add_each(all, isola, 1);
}

void add_mode(std::vector<OverlayCurve>& curves, const fs::path& file, const std::string& label,
              const std::string& column) {
  const Table table = read_csv(file);
  OverlayCurve curve{label,
                     "nonlinear_mode",
                     column_of(table, quantities::frequency.column(), file),
                     {},
                     column_of(table, column, file),
                     unstable_of(table)};
  const std::vector<std::string> statuses = table.texts("status");
  for (std::size_t i = 0; i < statuses.size(); ++i)
    if (statuses[i] != "converged" && statuses[i] != "linear") curve.displacement[i] = missing;
  curves.push_back(std::move(curve));
}

/// Half the peak-to-peak value of an output in a motion.
double vibration_in(const fs::path& folder, const OverlayQuantity& quantity) {
  const std::vector<double> values =
      column_of(read_csv(folder / "outputs.csv"), quantity.motion, folder / "outputs.csv");
  if (values.empty()) return missing;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return 0.5 * (*high - *low);
}

/// The displacements of all contacts where there are several.
void add_response(std::vector<OverlayCurve>& curves, const fs::path& folder, const std::string& label,
                  const OverlayQuantity& quantity) {
  const Table table = read_csv(folder / (holds(folder, "contacts.csv") ? "contacts.csv" : "response.csv"));
  const std::vector<double> u = column_of(table, "displacement_m", folder / "response.csv");
  const Summary summary = read_summary(folder / "summary.json");
  const auto [low, high] = std::minmax_element(u.begin(), u.end());
  double value = missing;
  if (!u.empty() && quantity.name == "max") value = *high;
  if (!u.empty() && quantity.name == "min") value = *low;
  if (!u.empty() && quantity.name == "max_abs") value = std::max(-*low, *high);
  if (quantity.name == "rms") value = number_in(summary, quantities::rms_displacement);
  if (quantity.is_output()) value = vibration_in(folder, quantity);
  curves.push_back({label, "response", {number_in(summary, quantities::frequency)}, {}, {value}, {missing}});
}

/// A motion of an output, or of the contact that leads in the folder `first`.
OverlayCurve motion_in(const fs::path& folder, const std::string& label, const fs::path& first,
                       const OverlayQuantity& quantity) {
  const Summary summary = read_summary(folder / "summary.json"),
                wanted = read_summary(first / "summary.json");
  fs::path file = folder / "response.csv";
  Table table = read_csv(file);
  if (quantity.is_output()) {
    file = folder / "outputs.csv";
    table = read_csv(file);
  } else if (holds(folder, "contacts.csv")) {
    file = folder / "contacts.csv";
    const double contact = number_in(wanted, quantities::leading_contact);
    table = read_csv(file).where("contact", fmt::format("{:g}", contact));
    if (table.has_column("direction"))
      table = table.where("direction", text_in(wanted, quantities::leading_direction));
  }
  const double frequency = number_in(summary, quantities::frequency),
               unstable = number_in(summary, quantities::unstable_multipliers);
  OverlayCurve curve{label + ", " + short_number(frequency, 6) + " Hz",
                     "motion",
                     {},
                     column_of(table, "time_fraction", file),
                     column_of(table, quantity.is_output() ? quantity.motion : "displacement_m", file),
                     {}};
  curve.frequency.assign(table.rows(), frequency);
  curve.unstable.assign(table.rows(), unstable);
  return curve;
}

/// Whether a folder holds one motion and no curve.
bool is_response(const fs::path& folder) {
  return holds(folder, "response.csv") && !holds(folder, "sweep.csv") && !holds(folder, "backbone.csv");
}

void add_curves(std::vector<OverlayCurve>& curves, const fs::path& folder, const Scene& scene,
                const std::string& label, const OverlayQuantity& quantity) {
  const std::string& column = quantity.column;
  if (holds(folder, "sweep.csv"))
    add_sweep(curves, folder / "sweep.csv", label, column, sweep_axis(scene));
  else if (holds(folder, "envelope.csv"))
    for (OverlayCurve& one : diagram_curves(folder, scene, label, quantity)) curves.push_back(std::move(one));
  else if (holds(folder, "backbone.csv"))
    add_mode(curves, folder / "backbone.csv", label, column);
  else if (holds(folder, "response.csv"))
    add_response(curves, folder, label, quantity);
  else
    throw IoError(
        folder,
        "holds neither sweep.csv, envelope.csv, backbone.csv nor response.csv; expected the results of a run");
}

std::vector<std::string> names_in(const std::vector<Output>& outputs) {
  std::vector<std::string> names;
  for (const Output& output : outputs) names.push_back(output.name);
  return names;
}

/// A name as in outputs: without unit; unchanged if it is not an output.
std::string name_of_output(const std::string& words) {
  try {
    return output_name(output_words(words));
  } catch (const std::invalid_argument&) {
    return words;
  }
}

/// The output of this name in the first folder, which all must have.
OverlayQuantity output_quantity(std::span<const fs::path> folders, const std::vector<Scene>& scenes,
                                const std::string& name) {
  for (std::size_t i = 0; i < folders.size(); ++i) {
    const std::vector<std::string> names = names_in(outputs_of(scenes[i]));
    if (contains(names, name)) continue;
    throw std::invalid_argument(fmt::format(
        "--quantity is \"{}\", but {} has {}; expected max, min, max_abs or rms, or an output of "
        "all folders (analysis.outputs)",
        name, folders[i].string(),
        names.empty() ? "no outputs" : "the outputs " + fmt::format("{}", fmt::join(names, ", "))));
  }
  for (const Output& output : outputs_of(scenes.front()))
    if (output.name == name) return quantity_of(output);
  return {};
}

OverlayQuantity overlay_quantity(std::span<const fs::path> folders, const std::vector<Scene>& scenes,
                                 const std::string& name) {
  for (const OverlayQuantity& one : contact_quantities())
    if (one.name == name) return one;
  if (!name.empty()) return output_quantity(folders, scenes, name_of_output(name));
  const std::vector<Output> outputs = outputs_of(scenes.front());
  const std::optional<std::size_t> leading = leading_output(outputs, scenes.front());
  const bool all = leading && std::ranges::all_of(scenes, [&](const Scene& scene) {
                     return contains(names_in(outputs_of(scene)), outputs[*leading].name);
                   });
  return all ? quantity_of(outputs[*leading]) : contact_quantities().front();
}

}  // namespace

Overlay read_overlay(std::span<const fs::path> folders, const std::string& quantity) {
  Overlay overlay;
  const std::vector<std::string> labels = labels_of(folders);
  std::vector<Scene> scenes;
  for (const fs::path& folder : folders) scenes.push_back(scene_in(folder));
  const Scene& first = scenes.front();
  overlay.quantity = overlay_quantity(folders, scenes, quantity);
  if (!overlay.quantity.is_output()) overlay.quantity.unit = displacement_unit(first);
  overlay.logarithmic = std::ranges::any_of(scenes, [](const Scene& scene) { return scene.plot.log; });
  overlay.gap = common_gap(first);
  overlay.axis = sweep_axis(first);
  const bool over_time = std::ranges::all_of(folders, is_response);
  for (std::size_t i = 0; i < folders.size(); ++i) {
    const Scene& scene = scenes[i];
    require_same_structure(first, scene, folders[i]);
    require_same_axis(first, scene, folders[i]);
    if (over_time)
      overlay.curves.push_back(motion_in(folders[i], labels[i], folders.front(), overlay.quantity));
    else
      add_curves(overlay.curves, folders[i], scene, labels[i], overlay.quantity);
    const double gap = common_gap(scene);
    if (gap == overlay.gap || (std::isnan(gap) && std::isnan(overlay.gap))) continue;
    if (scene.contact.law != no_law && first.contact.law != no_law)
      overlay.warnings.push_back(
          fmt::format("{} has another gap than the first folder: the curves belong to different contacts",
                      folders[i].string()));
    overlay.gap = missing;
  }
  return overlay;
}

}  // namespace wavebalance::app

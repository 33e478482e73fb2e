#include "results/record_parts.hpp"

#include <fmt/ranges.h>

#include <numbers>

#include "drawing/figures.hpp"
#include "wavebalance/app/analysis/whirl.hpp"
#include "wavebalance/app/files/quantity_text.hpp"

namespace wavebalance::app {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

bool is_sweep(const Scene& scene) { return scene.analysis.type == AnalysisType::frequency_sweep; }

/// rad/s: the end of a sweep, or twice the speed.
double highest_speed(const Scene& scene) {
  if (is_sweep(scene)) return two_pi * std::max(scene.analysis.frequency_from, scene.analysis.frequency_to);
  return 2.0 * spin_speed(scene);
}

Table campbell_table(const CampbellDiagram& diagram) {
  Table table;
  std::vector<double> speeds;
  for (const double speed : diagram.speeds) speeds.push_back(speed / two_pi);
  table.add_column("speed_Hz", speeds);
  for (std::size_t k = 0; k < diagram.lines.size(); ++k) {
    const auto column = [&](const char* name, auto value) {
      std::vector<double> values;
      for (const WhirlMode& mode : diagram.lines[k]) values.push_back(value(mode));
      table.add_column(fmt::format("whirl_{}_{}", k + 1, name), values);
    };
    column("frequency_Hz", [](const WhirlMode& mode) { return mode.frequency_hz(); });
    column("damping_ratio", [](const WhirlMode& mode) { return mode.damping_ratio(); });
    column("circularity", [](const WhirlMode& mode) { return mode.circularity; });
  }
  return table;
}

Table critical_table(const std::vector<CriticalSpeed>& critical) {
  Table table({"speed_Hz", "direction", "circularity", "damping_ratio"});
  for (const CriticalSpeed& one : critical)
    table.append_row(
        {one.speed / two_pi, one.whirl.direction(), one.whirl.circularity, one.whirl.damping_ratio()});
  return table;
}

std::string whirl_text(double frequency, const WhirlMode& whirl) {
  const std::string direction = whirl.direction();
  return fmt::format("{}{}{} ({})", quantity(frequency, "Hz", 5), direction == "-" ? "" : " ",
                     direction == "-" ? "" : direction, percentage(whirl.damping_ratio(), 2));
}

std::string whirls_text(const StructureModel& model, double speed) {
  std::vector<std::string> texts;
  for (const WhirlMode& whirl : whirls_at(model, speed, 6))
    texts.push_back(whirl_text(whirl.frequency_hz(), whirl));
  return fmt::format("at {}: {}", quantity(speed, "rad/s", 7),
                     texts.empty() ? "none found" : fmt::format("{}", fmt::join(texts, ", ")));
}

/// Warning for a matrix G whose sign differs from the unbalance's; empty without.
std::string sense_warning(const Scene& scene, const CampbellDiagram& diagram) {
  if (scene.structure.matrices.gyroscopic.empty() || !turns_against_plane(diagram)) return "";
  return "The unbalance turns against structure.gyroscopic, which lowers forward whirls and "
         "raises backward ones. Expected the other order or sign of its dofs, or the other sign "
         "of the matrix.";
}

}  // namespace

void append_whirls(Record& record, const Scene& scene, const StructureModel& model) {
  if (!is_sweep(scene) || !has_whirls(model)) return;
  const CampbellDiagram diagram = campbell_diagram(model, highest_speed(scene));
  if (diagram.lines.empty()) return;
  if (const std::string warning = sense_warning(scene, diagram); !warning.empty())
    record.warnings.push_back(warning);
  record.add("critical_speeds", critical_table(diagram.critical));
  record.files.push_back(
      {"campbell.csv", csv_text(campbell_table(diagram)), "whirl frequencies over the speed"});
  record.output_pictures.push_back(
      {"campbell", campbell_figure(diagram), "whirl frequencies over the speed"});
}

std::string whirl_lines(const Scene& scene) {
  const MatricesStructure& matrices = scene.structure.matrices;
  if (matrices.gyroscopic.empty() && matrices.spin_stiffness.empty()) return "";
  constexpr std::int64_t most = 2000;
  if (structure_dofs(scene) > most)
    return fmt::format(
        "whirl      not computed for more than {} degrees of freedom; a frequency sweep computes it\n", most);
  Scene whole = scene;
  whole.structure.kept_modes = -1;
  whole.contact.mass = ContactMass::keep;
  const StructureModel model = make_model(whole);
  std::vector<double> speeds{spin_speed(scene)};
  if (turns_along_curve(scene))
    speeds = {two_pi * scene.analysis.frequency_from, two_pi * scene.analysis.frequency_to};
  std::string text;
  for (const double speed : speeds)
    text += (text.empty() ? "whirl      " : "           ") + whirls_text(model, speed) + "\n";
  const double highest = highest_speed(scene);
  const CampbellDiagram diagram = campbell_diagram(model, highest);
  std::vector<std::string> critical;
  for (const CriticalSpeed& one : diagram.critical)
    critical.push_back(whirl_text(one.speed / two_pi, one.whirl));
  const std::string warning = sense_warning(scene, diagram);
  return text + (warning.empty() ? "" : "warning    " + warning + "\n") +
         fmt::format("critical   {}, up to {}\n",
                     critical.empty() ? "no speed" : fmt::format("{}", fmt::join(critical, ", ")),
                     quantity(highest / two_pi, "Hz", 5));
}

}  // namespace wavebalance::app

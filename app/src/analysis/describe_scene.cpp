#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "compose/structure_files.hpp"
#include "files/number_text.hpp"
#include "wavebalance/app/analysis/analysis.hpp"
#include "wavebalance/app/analysis/cost_estimate.hpp"
#include "wavebalance/app/compose/compose.hpp"

namespace wavebalance::app {
namespace {

std::string count_text(std::int64_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string bar_line(const Structure& bar) {
  // First natural frequency of the clamped bar before it is cut into elements.
  const double first = std::sqrt(bar.youngs_modulus / bar.density) / (4.0 * bar.length);
  return "structure  bar, " + std::to_string(bar.elements) +
         " elements and degrees of freedom, first natural frequency " + std::to_string(std::lround(first)) +
         " Hz" + (bar.massless_tip ? ", its tip without mass" : "") + "\n";
}

std::string blade_line(const Scene& scene) {
  const BladeStructure& blade = scene.structure.blade;
  std::string text = "structure  blade, " + std::to_string(blade.chord_elements) + " x " +
                     std::to_string(blade.thickness_elements) + " x " + std::to_string(blade.span_elements) +
                     " elements " + name_of(blade.element) + ", " + std::to_string(structure_dofs(scene)) +
                     " degrees of freedom, reduced to " + std::to_string(reduced_size(scene)) + " (" +
                     count_text(scene.structure.kept_modes, "mode") + ")";
  if (blade.rotation_speed > 0.0) text += ", turning at " + number_text(blade.rotation_speed) + " rad/s";
  return text + "\n";
}

std::string matrices_line(const Scene& scene) {
  std::string text = "structure  matrices, " + count_text(structure_dofs(scene), "degree") + " of freedom";
  if (scene.structure.kept_modes >= 0)
    text += ", reduced to " + std::to_string(reduced_size(scene)) + " (" +
            count_text(scene.structure.kept_modes, "mode") + ")";
  return text + "\n";
}

std::string structure_line(const Scene& scene) {
  switch (scene.structure.type) {
    case StructureType::blade:
      return blade_line(scene);
    case StructureType::matrices:
      return matrices_line(scene);
    case StructureType::bar:
      break;
  }
  return bar_line(scene.structure);
}

std::string contact_place(const Structure& structure) {
  if (structure.type == StructureType::bar) return "at the tip";
  const std::string count = count_text(contact_count(structure), "degree") + " of freedom";
  return "at " + count + (structure.type == StructureType::blade ? " along the tip, radially" : "");
}

std::string gap_text(const Contact& contact) {
  if (contact.gaps.empty()) return "gap " + number_text(contact.gap) + " m";
  const auto [least, most] = std::minmax_element(contact.gaps.begin(), contact.gaps.end());
  if (*least == *most) return "gap " + number_text(*least) + " m";
  return "gaps " + number_text(*least) + " to " + number_text(*most) + " m";
}

std::string contact_line(const Scene& scene) {
  const Contact& contact = scene.contact;
  if (contact.law == ContactLawType::none) return "contact    none: the problem is linear\n";
  const std::string what =
      contact.law == ContactLawType::rigid ? "rigid obstacle" : name_of(contact.law) + " law";
  return "contact    " + what + " " + contact_place(scene.structure) + ", " + gap_text(contact) + "\n";
}

std::string force_place(const Scene& scene) {
  const Forcing& forcing = scene.forcing;
  switch (scene.structure.type) {
    case StructureType::blade:
      return "at the tip's " + name_of(forcing.place) + " along " + name_of(forcing.direction);
    case StructureType::matrices:
      return forcing.load.empty()
                 ? "on " + count_text(std::ssize(forcing.load_dofs), "degree") + " of freedom"
                 : "along the load vector";
    case StructureType::bar:
      break;
  }
  return "at the tip";
}

std::string forcing_line(const Scene& scene) {
  const std::string amplitude =
      "forcing    " + number_text(scene.forcing.amplitude) + " N " + force_place(scene) + ", ";
  if (scene.analysis.type != AnalysisType::frequency_sweep)
    return amplitude + number_text(scene.forcing.frequency) + " Hz\n";
  return amplitude + number_text(scene.analysis.frequency_from) + " to " +
         number_text(scene.analysis.frequency_to) + " Hz\n";
}

std::string chosen_text(const Time& time) {
  const std::string pair = time.trial.empty() ? "pair" : time.trial + ":" + time.weight;
  return "time       " + pair + ", functions and quadrature points chosen for a relative error of " +
         number_text(time.tolerance) + "\n";
}

std::string time_lines(const Time& time) {
  if (time.tolerance > 0.0) return chosen_text(time);
  const auto products = effective_inner_products(time);
  std::string text = "time       " + time.trial + ":" + time.weight + ", " + std::to_string(time.functions) +
                     " functions, " + std::to_string(time.quadrature_points) + " quadrature points, " +
                     name_of(time.formulation) + " form, " + name_of(products) + " inner products";
  if (products != time.inner_products) text += " (connection coefficients)";
  const auto pair = pair_admissibility(time);
  return text + "\npair       " + (pair.admissible ? "admissible" : "NOT admissible: " + pair.reason) + "\n";
}

std::string size_line(const Scene& scene) {
  if (scene.analysis.type == AnalysisType::time_stepping)
    return "size       " + std::to_string(2 * reduced_size(scene)) +
           " states, periods until they differ by " + number_text(scene.analysis.tolerance) + "\n";
  if (scene.time.tolerance > 0.0) return "";
  const std::int64_t functions = scene.time.functions;
  return "size       " + std::to_string(contact_count(scene.structure) * functions) +
         " unknowns after condensation on the contact (" + std::to_string(reduced_size(scene) * functions) +
         " before)\n";
}

std::string mode_lines(const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  const std::string range = analysis.energy_ratio > 0.0
                                ? "the motion of energy ratio " + number_text(analysis.energy_ratio)
                                : std::to_string(analysis.points) + " points up to energy ratio " +
                                      number_text(analysis.largest_energy) + " or frequency ratio " +
                                      number_text(analysis.last_frequency_ratio);
  const std::string formulation =
      analysis.formulation == ModeFormulation::published ? ", equations as published" : "";
  return "mode       " + std::to_string(analysis.mode) + ", " + range + formulation +
         "\ntime       Fourier series, " + std::to_string(analysis.harmonics) + " harmonics" +
         (analysis.cosine_only ? " (cosines only)" : "") + "\nsize       " +
         std::to_string(std::int64_t{contact_count(scene.structure)} * analysis.samples) +
         " contact forces after condensation on the contact (" +
         std::to_string(std::int64_t{reduced_size(scene)} * (2 * analysis.harmonics + 1)) +
         " unknowns before)\n";
}

std::string duration_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1g s", seconds);
  if (seconds >= 10.0) std::snprintf(text, sizeof text, "%.0f s", seconds);
  if (seconds >= 600.0) std::snprintf(text, sizeof text, "%.0f min", seconds / 60.0);
  return text;
}

std::string cost_line(const Scene& scene) {
  const CostEstimate cost = estimate_cost(scene);
  const std::string time = std::isnan(cost.seconds) ? "" : duration_text(cost.seconds) + " and ";
  const double available = available_memory();
  return "cost       about " + time + memory_text(cost.bytes) + " of memory" +
         (cost.bytes > available ? "; MORE THAN the " + memory_text(available) + " that there are" : "") +
         "\n";
}

std::string warning_lines(const Scene& scene) {
  if (scene.structure.type != StructureType::matrices) return "";
  std::string text;
  for (const std::string& warning : warnings_of(*structure_files(scene)))
    text += "warning    " + warning + "\n";
  return text;
}

}  // namespace

std::string describe_scene(const Scene& scene) {
  const bool stepping = scene.analysis.type == AnalysisType::time_stepping;
  const std::string first_lines =
      "analysis   " + name_of(scene.analysis.type) + "\n" + structure_line(scene) + contact_line(scene);
  if (scene.analysis.type == AnalysisType::nonlinear_mode)
    return first_lines + mode_lines(scene) + cost_line(scene);
  return first_lines + forcing_line(scene) + (stepping ? "" : time_lines(scene.time)) + size_line(scene) +
         cost_line(scene) + warning_lines(scene);
}

}  // namespace wavebalance::app

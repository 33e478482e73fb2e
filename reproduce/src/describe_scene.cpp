#include <cmath>

#include "number_text.hpp"
#include "wavebalance/reproduce/analysis.hpp"
#include "wavebalance/reproduce/compose.hpp"

namespace wavebalance::reproduce {
namespace {

std::string structure_line(const Structure& bar) {
  // First natural frequency of the clamped bar before it is cut into elements.
  const double first = std::sqrt(bar.youngs_modulus / bar.density) / (4.0 * bar.length);
  return "structure  bar, " + std::to_string(bar.elements) +
         " elements and degrees of freedom, first natural frequency " + std::to_string(std::lround(first)) +
         " Hz" + (bar.massless_tip ? ", its tip without mass" : "") + "\n";
}

std::string contact_line(const Contact& contact) {
  if (contact.law == ContactLawType::none) return "contact    none: the problem is linear\n";
  if (contact.law == ContactLawType::rigid)
    return "contact    rigid obstacle at the tip, gap " + number_text(contact.gap) + " m\n";
  return "contact    " + name_of(contact.law) + " law at the tip, gap " + number_text(contact.gap) + " m\n";
}

std::string forcing_line(const Scene& scene) {
  const std::string amplitude = "forcing    " + number_text(scene.forcing.amplitude) + " N at the tip, ";
  if (scene.analysis.type != AnalysisType::frequency_sweep)
    return amplitude + number_text(scene.forcing.frequency) + " Hz\n";
  return amplitude + number_text(scene.analysis.frequency_from) + " to " +
         number_text(scene.analysis.frequency_to) + " Hz\n";
}

std::string time_lines(const Time& time) {
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
    return "size       " + std::to_string(2 * scene.structure.elements) +
           " states, periods until they differ by " + number_text(scene.analysis.tolerance) + "\n";
  return "size       " + std::to_string(scene.time.functions) +
         " unknowns after condensation on the contact (" +
         std::to_string(std::int64_t{scene.structure.elements} * scene.time.functions) + " before)\n";
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
         std::to_string(analysis.samples) + " contact forces after condensation on the contact (" +
         std::to_string(std::int64_t{scene.structure.elements} * (2 * analysis.harmonics + 1)) +
         " unknowns before)\n";
}

}  // namespace

std::string describe_scene(const Scene& scene) {
  const bool stepping = scene.analysis.type == AnalysisType::time_stepping;
  const std::string opening = "analysis   " + name_of(scene.analysis.type) + "\n" +
                              structure_line(scene.structure) + contact_line(scene.contact);
  if (scene.analysis.type == AnalysisType::nonlinear_mode) return opening + mode_lines(scene);
  return opening + forcing_line(scene) + (stepping ? "" : time_lines(scene.time)) + size_line(scene);
}

}  // namespace wavebalance::reproduce


#include <iterator>
#include <numbers>

#include "describe/contact_line.hpp"
#include "files/number_text.hpp"
#include "matrices/load_places.hpp"
#include "matrices/structure_facts.hpp"
#include "matrices/structure_files.hpp"
#include "results/analyses.hpp"
#include "results/record_parts.hpp"
#include "wavebalance/app/analysis/cost_estimate.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/results/record.hpp"
#include "wavebalance/app/scene/contacts.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"

namespace wavebalance::app {
namespace {

/// scene.toml has all digits.
std::string seven_digits(double value, const std::string& unit = "") { return quantity(value, unit, 7); }

std::string turning_text(double speed) {
  return speed > 0.0 ? ", turning at " + seven_digits(speed, "rad/s") : "";
}

std::string turning_text(const Scene& scene) {
  if (!turns_along_curve(scene)) return turning_text(spin_speed(scene));
  constexpr double per_hertz = 2.0 * std::numbers::pi;
  return fmt::format(", turning with the load at {} to {} rad/s",
                     seven_digits(per_hertz * scene.analysis.frequency_from),
                     seven_digits(per_hertz * scene.analysis.frequency_to));
}

std::string bar_line(const Structure& bar) {
  // First natural frequency of the clamped bar before it is cut into elements.
  const double first = std::sqrt(bar.youngs_modulus / bar.density) / (4.0 * bar.length);
  return fmt::format("structure  bar, {} elements and degrees of freedom, first natural frequency {} Hz{}\n",
                     bar.elements, std::lround(first), bar.massless_tip ? ", its tip without mass" : "");
}

std::string blade_line(const Scene& scene) {
  const BladeStructure& blade = scene.structure.blade;
  return fmt::format(
      "structure  blade, {} x {} x {} elements {}, {} degrees of freedom, reduced to {} ({}){}\n",
      blade.chord_elements, blade.thickness_elements, blade.span_elements, name_of(blade.element),
      structure_dofs(scene), reduced_size(scene), count_text(scene.structure.kept_modes, "mode"),
      turning_text(blade.rotation_speed));
}

std::string matrices_line(const Scene& scene) {
  const int modes = scene.structure.kept_modes;
  const auto condensed = static_cast<int>(structure_files(scene)->massless.size());
  const std::string size = (condensed > 0 ? count_text(condensed, "row") + " without mass condensed, " : "") +
                           count_text(structure_dofs(scene), "degree");
  const std::string reduced =
      modes < 0 ? "" : fmt::format(", reduced to {} ({})", reduced_size(scene), count_text(modes, "mode"));
  return fmt::format("structure  matrices, {} of freedom{}{}\n", size, reduced, turning_text(scene));
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

/// Where a term acts; empty if its structure has a single place.
std::string term_place(const Scene& scene, const ForcingTerm& term) {
  if (!term.direction.empty()) return "along " + term.direction;
  if (!term.load.empty()) return "along its load vector";
  if (!term.dofs.empty()) return "on " + count_text(std::ssize(term.dofs), "degree") + " of freedom";
  return scene.structure.type == StructureType::matrices ? force_place(scene) : "";
}

std::string table_text(const std::string& file) {
  return file.empty() ? "" : " times a table over the frequency";
}

/// One of the additional loads.
std::string term_line(const Scene& scene, const ForcingTerm& term) {
  const std::string size =
      seven_digits(term.amplitude, term.samples.empty() ? std::string(unit_of(term)) : "");
  const std::string series = !term.samples.empty() ? size + " times samples"
                             : term.harmonic == 0  ? "static, " + size
                                                   : fmt::format("harmonic {}, {}", term.harmonic, size);
  const std::string place = term_place(scene, term);
  const std::string phase =
      term.phase == 0.0 ? "" : fmt::format(", {} degrees ahead", seven_digits(term.phase));
  return fmt::format("           {}: {}{}{}{}\n", spaced_words(name_of(term.kind)), series,
                     table_text(term.amplitude_table), phase, place.empty() ? "" : " " + place);
}

/// The weight, and what it amounts to.
std::string weight_line(const Scene& scene) {
  const std::vector<double>& weight = scene.forcing.weight;
  if (weight.empty()) return "";
  const auto files = structure_files(scene);
  const Eigen::VectorXd force = weight_of(scene.forcing, *files);
  Eigen::Vector3d sum;
  for (int axis = 0; axis < 3; ++axis) sum[axis] = files->at_unknowns(files->rows_along(axis)).dot(force);
  const std::string internal =
      files->internal_from ? fmt::format("; nodes from {} on are internal to elements and weigh nothing",
                                         *files->internal_from)
                           : "";
  return fmt::format("           weight: static, {} m/s^2, {} in all{}\n", toml_text(weight),
                     quantity(sum.norm(), "N", 5), internal);
}

/// Outputs by their names, a few of many.
std::string outputs_line(const Scene& scene) {
  if (scene.analysis.outputs.empty()) return "";
  constexpr std::size_t shown = 8;
  std::vector<std::string> names;
  for (const Output& output : outputs_of(scene)) names.push_back(output.name);
  const std::size_t count = names.size();
  names.resize(std::min(shown, count));
  return fmt::format("outputs    {}{}\n", fmt::join(names, ", "),
                     count > shown ? fmt::format(" and {} more", count - shown) : "");
}

/// Where isolated branches are searched for, and the cost.
std::string isolas_line(const Analysis& analysis) {
  if (!analysis.isolas) return "";
  const double interval = std::abs(analysis.frequency_to - analysis.frequency_from);
  const double frequencies = std::ceil(interval / analysis.isola_spacing * (1.0 - 1e-9));
  return fmt::format(
      "isolas     searched for at {:.0f} frequenc{}, from rest and {} random states each: "
      "{:.0f} time integrations of up to seconds each, not in the cost below\n",
      frequencies, frequencies > 1.0 ? "ies" : "y", analysis.isola_starts,
      frequencies * (1 + analysis.isola_starts));
}

std::string forcing_line(const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  std::string frequency = seven_digits(scene.forcing.frequency);
  if (varies_frequency(analysis))
    frequency = seven_digits(analysis.frequency_from) + " to " + seven_digits(analysis.frequency_to);
  std::string terms = weight_line(scene);
  for (const ForcingTerm& term : scene.forcing.terms) terms += term_line(scene, term);
  if (is_over_amplitude(analysis)) {
    const std::string unit(reference_load(scene.forcing).value().unit);
    terms +=
        fmt::format("           the amplitude varies from {} to {}\n",
                    seven_digits(analysis.amplitude_from, unit), seven_digits(analysis.amplitude_to, unit));
  }
  if (!kind_of(analysis.type).under_load) return "forcing    nothing periodic\n" + terms;
  const std::string periods =
      analysis.subharmonic == 1 ? "" : fmt::format(", motions of {} periods", analysis.subharmonic);
  const bool terms_alone = scene.forcing.amplitude == 0.0 && !terms.empty();
  const std::string force = fmt::format("{}{} {}, ", seven_digits(scene.forcing.amplitude, "N"),
                                        table_text(scene.forcing.amplitude_table), force_place(scene));
  return fmt::format("forcing    {}{} Hz{}{}\n{}", terms_alone ? "" : force, frequency, periods,
                     analysis.branches ? ", with branches" : "", terms) +
         isolas_line(analysis);
}

std::string chosen_text(const Time& time) {
  const std::string pair = time.trial.empty() ? "pair" : time.trial + ":" + time.weight;
  return fmt::format("time       {}, functions and quadrature points chosen for a relative error of {}\n",
                     pair, short_number(time.tolerance));
}

/// Treatment of the Nyquist coefficient; empty for an odd number of functions.
std::string nyquist_text(const Time& time) {
  if (time.functions % 2 != 0) return "";
  return effective_nyquist(time) == NyquistCoefficient::drop ? " (Nyquist coefficient dropped)"
                                                             : " (Nyquist coefficient kept)";
}

std::string exact_time_line(const Time& time) {
  return fmt::format(
      "time       exact periodic solution to a relative error of {}, started from harmonic balance\n",
      short_number(time.tolerance));
}

std::string time_lines(const Time& time) {
  if (time.tolerance > 0.0) return chosen_text(time);
  const auto products = effective_inner_products(time);
  return fmt::format(
      "time       {}:{}, {} functions{}, {} quadrature points{}, {} form, {} inner products{}\npair       "
      "admissible\n",
      time.trial, time.weight, time.functions, nyquist_text(time), time.quadrature_points,
      time.sample_offset == 0.0 ? "" : " at the middles", name_of(time.formulation), name_of(products),
      products == time.inner_products ? "" : " (connection coefficients)");
}

std::string exact_line(const Scene& scene) {
  const Time& time = scene.time;
  return fmt::format(
      "time       exact periodic solutions, started from {}:{} with {} functions and {} quadrature points\n",
      time.trial, time.weight, time.functions, time.quadrature_points);
}

std::string impacts_line(const Scene& scene) {
  const bool sweep = scene.analysis.type != AnalysisType::forced_response;
  return fmt::format("time       exact periodic solutions with impacts{}\n",
                     sweep ? ", followed by arc length" : ", started from time integration");
}

std::string method_lines(const Scene& scene) {
  if (solves_by_impacts(scene)) return impacts_line(scene);
  if (moves_by_events(scene))
    return "time       exact periodic solutions, started from event-driven time integration\n";
  if (scene.analysis.exact) return exact_line(scene);
  return solves_exactly(scene) ? exact_time_line(scene.time) : time_lines(scene.time);
}

std::string size_line(const Scene& scene) {
  const bool has_no_functions = solves_exactly(scene) || solves_by_impacts(scene) || scene.analysis.exact;
  if (has_no_functions || scene.time.tolerance > 0.0) return "";
  const std::int64_t functions = scene.time.functions;
  return fmt::format("size       {} unknowns after exact dynamic condensation ({} before)\n",
                     contact_count(scene) * functions, reduced_size(scene) * functions);
}

std::string mode_lines(const Scene& scene) {
  const Analysis& analysis = scene.analysis;
  const std::string range =
      analysis.amplitude_ratio > 0.0
          ? "the motion of amplitude ratio " + seven_digits(analysis.amplitude_ratio)
      : is_damped_mode(scene) ? fmt::format("about {} points up to amplitude ratio {}", analysis.points,
                                            seven_digits(analysis.largest_amplitude))
      : analysis.energy_ratio > 0.0
          ? "the motion of energy ratio " + seven_digits(analysis.energy_ratio)
          : fmt::format("{} points up to energy ratio {}", analysis.points,
                        seven_digits(analysis.largest_energy)) +
                (analysis.last_frequency_ratio > 0.0
                     ? " or frequency ratio " + seven_digits(analysis.last_frequency_ratio)
                     : "");
  if (is_elastic_mode(scene) || is_damped_mode(scene)) {
    const Time time = mode_time(scene);
    const std::int64_t functions = time.functions;
    return fmt::format(
        "mode       {}, {}\n{}size       {} unknowns after exact dynamic condensation ({} before)\n",
        analysis.mode, range, time_lines(time), contact_count(scene) * functions,
        reduced_size(scene) * functions);
  }
  return fmt::format(
      "mode       {}, {}\ntime       Fourier series, {} harmonics{}\nsize       {} contact "
      "forces after exact dynamic condensation ({} unknowns before)\n",
      analysis.mode, range, analysis.harmonics, analysis.cosine_only ? " (cosines only)" : "",
      std::int64_t{contact_count(scene)} * analysis.samples,
      std::int64_t{reduced_size(scene)} * (2 * analysis.harmonics + 1));
}

std::string cost_line(const Scene& scene) {
  const CostEstimate cost = estimate_cost(scene);
  const double available = available_memory();
  return "cost       " + cost_text(cost) +
         (cost.bytes > available ? "; MORE THAN the " + memory_text(available) + " that there are" : "") +
         "\n";
}

std::string five_digits(const Eigen::VectorXd& numbers) {
  return short_numbers(std::span(numbers.data(), std::size_t(numbers.size())), 5);
}

std::string ratios_text(const Eigen::VectorXd& ratios) {
  if (ratios.size() == 0 || ratios.cwiseAbs().maxCoeff() == 0.0) return "without damping";
  const bool alike = ratios.maxCoeff() - ratios.minCoeff() <= 1e-9 * ratios.maxCoeff();
  return "damping ratios " + (alike ? five_digits(ratios.head(1)) + " each" : five_digits(ratios));
}

/// A few contacts one by one, many by the least and the largest.
std::string compliance_text(const StructureFacts& facts) {
  constexpr Eigen::Index few = 4;
  const auto at = [&](Eigen::Index contact) {
    return fmt::format("{} at {}", quantity(facts.compliances[contact], "m/N", 5),
                       facts.contacts[static_cast<std::size_t>(contact)]);
  };
  const Eigen::Index count = facts.compliances.size();
  if (count == 0) return "none at rest, since the structure is free to move";
  std::vector<std::string> texts;
  for (Eigen::Index contact = 0; contact < std::min(count, few); ++contact) texts.push_back(at(contact));
  if (count <= few) return fmt::format("{}", fmt::join(texts, "; "));
  Eigen::Index least = 0, most = 0;
  facts.compliances.minCoeff(&least);
  facts.compliances.maxCoeff(&most);
  return "from " + at(least) + " to " + at(most);
}

/// "0 Hz (1 rigid motion); 50.085, 140.33 Hz, without damping"
std::string modes_text(const StructureFacts& facts) {
  std::vector<std::string> texts;
  if (facts.rigid_motions > 0)
    texts.push_back(fmt::format("0 Hz ({})", count_text(facts.rigid_motions, "rigid motion")));
  if (facts.frequencies_hz.size() > 0)
    texts.push_back(five_digits(facts.frequencies_hz) + " Hz, " + ratios_text(facts.damping_ratios));
  return fmt::format("{}", fmt::join(texts, "; "));
}

/// Figures by which wrong units, files or boundary conditions of matrices show.
std::string matrices_lines(const Scene& scene) {
  constexpr std::int64_t most = 200'000;  // beyond which a check would need minutes
  if (scene.structure.type != StructureType::matrices) return "";
  if (structure_dofs(scene) > most)
    return fmt::format("modes      not computed for more than {} degrees of freedom\n", most);
  const StructureFacts facts = structure_facts(scene);
  const std::string at_rest =
      scene.structure.matrices.gyroscopic.empty() ? "" : ", without gyroscopic forces";
  return "modes      " + modes_text(facts) + at_rest + "\n" + whirl_lines(scene) + "compliance " +
         compliance_text(facts) + "\n" + rest_lines(scene);
}

std::string warning_lines(const Scene& scene) {
  if (scene.structure.type != StructureType::matrices) return "";
  std::string text;
  for (const std::string& warning : warnings_of(scene, *structure_files(scene)))
    text += "warning    " + warning + "\n";
  return text;
}

}  // namespace

std::string describe_scene(const Scene& scene) {
  const std::string first_lines = "analysis   " + name_of(scene.analysis.type) + "\n" +
                                  structure_line(scene) + matrices_lines(scene) + contact_line(scene);
  if (scene.analysis.type == AnalysisType::nonlinear_mode)
    return first_lines + mode_lines(scene) + cost_line(scene);
  const auto plan = part_of(scene.analysis.type).plan;
  return first_lines + forcing_line(scene) + outputs_line(scene) +
         (plan != nullptr ? plan(scene) : method_lines(scene) + size_line(scene)) + cost_line(scene) +
         warning_lines(scene);
}

}  // namespace wavebalance::app

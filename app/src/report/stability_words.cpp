#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <map>

#include "files/number_text.hpp"
#include "report/run_words.hpp"
#include "results/quantities.hpp"

namespace wavebalance::app {
namespace {

/// One sentence for each status of stability that a record can have.
std::string status_sentence(const std::string& status) {
  static const std::map<std::string, std::string> known{
      {"stable", "The motion is stable: a small disturbance dies away."},
      {"unstable", "The motion is unstable: a small disturbance grows, and the structure leaves it."},
      {"converged", "Stability is known at every point."},
      {"partly_known", "Stability is known at part of the points."},
      {"no_law_of_impact",
       "Stability is not known: where a rigid obstacle meets contacts with mass, no motion beside the one found is "
       "determined without a law of impact."},
      {"no_finite_stiffness", "Stability is not known: the contact is rigid and has no finite stiffness."},
      {"too_few_samples",
       "Where contact has just begun, its interval lies between two quadrature points. Stability is not known there; "
       "more quadrature_points narrow that part."},
      {"too_few_harmonics",
       "Stability is not known everywhere: contact is stiffer than the functions resolve. More functions help."},
      {"structural_damping",
       "Stability is not known: structural damping has no equation in time. With modal_damping = loss_factor / 2 in "
       "its place it is."},
      {"undamped", "Stability is not asymptotic: the structure has a mode without damping."},
      {"on_unit_circle",
       "Stability is not known: a multiplier lies on the unit circle within its own error, and none outside."},
      {"too_many_phases",
       "Stability is not known: so many contacts change so often that the motion of the structure was not sought."},
      {"coupled_massless",
       "Stability is not known: contacts without mass and damping deflect each other at once."},
      {"no_modes", "Stability is not known: the modes of the structure could not be computed."},
      {"effort_limit",
       "Stability is not known everywhere: the count of multipliers took too many operations."},
      {"no_response", "Stability is not known: there is no motion."},
      {"not_found",
       "Stability is not known where the search by phases found no motion of the structure near the response of the "
       "samples."},
      {"not_computed", "Stability was not computed; analysis.stability = true asks for it."},
      {"interrupted", "The computation of stability was interrupted."},
  };
  const auto found = known.find(status);
  return found == known.end() ? "Stability is not known (" + spaced_words(status) + ")." : found->second;
}

/// "Folds", or the name itself for a type that has no other.
std::string type_in_words(const std::string& type) {
  static const std::map<std::string, std::string> known{
      {"fold", "Folds, where the curve turns back"},
      {"period_doubling", "Period doublings, where motions of two periods begin"},
      {"neimark_sacker", "Neimark-Sacker points, where quasi-periodic motions begin"},
      {"grazing", "Grazing points, where an interval of contact appears, vanishes, splits or joins another"},
      {"branch", "Branch points, where another curve begins"},
      {"slip", "First slip, where all contacts stick up to there or from there on"},
      {"stick",
       "Onsets of sticking, where a contact that slips all along begins to stick in each period, or ceases to"},
      {"krein_collision",
       "Krein collisions, where two pairs of multipliers meet on the unit circle and leave it, so that a small "
       "disturbance begins to oscillate and grow"}};
  const auto found = known.find(type);
  return found == known.end() ? spaced_words(type) : found->second;
}

/// Those of the structure where its whole curve was followed.
void append_special_points(std::vector<std::string>& sentences, const Summary& summary,
                           const SweepAxis& axis) {
  const bool whole = text_in(summary, quantities::structure_curve) == "whole";
  const auto* points = value_in<Table>(
      summary, (whole ? quantities::structure_special_points : quantities::special_points).name);
  if (points == nullptr || points->empty()) return;
  std::map<std::string, std::vector<std::string>> places;
  for (std::size_t i = 0; i < points->rows(); ++i)
    if (const auto* place = std::get_if<double>(&points->at(i, axis.column())))
      places[type_in_words(cell_text(points->at(i, "type")))].push_back(
          fmt::format("{:.7g} {}", *place, axis.unit));
  for (const auto& [type, where] : places)
    sentences.push_back(fmt::format("{}: {}.", type, fmt::join(where, ", ")));
}

/// Why a law of the velocity, or friction, leaves stability unknown: with the number of states where it is
/// known.
std::string too_many_states_sentence(const Summary& summary) {
  // As the solvers have it: of a curve with friction, and otherwise.
  constexpr double most_along_friction = 120.0, most = 400.0;
  const bool friction = find_entry(summary, quantities::friction_work.name) != nullptr ||
                        find_entry(summary, quantities::max_slip_fraction.name) != nullptr;
  const bool curve = find_entry(summary, quantities::points.name) != nullptr;
  const double states = 2.0 * number_in(summary, quantities::reduced_degrees_of_freedom);
  return fmt::format(
      "Stability is not known{}: with {} it takes all {}states of the structure, of which at most {:.0f} are "
      "followed. structure.kept_modes leaves fewer.",
      friction && curve ? " where a multiplier is near the unit circle" : "",
      friction ? "friction" : "a contact law that depends on the velocity",
      std::isfinite(states) ? fmt::format("{:.0f} ", states) : "",
      friction && curve ? most_along_friction : most);
}

std::string sentence_of(const Summary& summary, const std::string& status) {
  return status == "too_many_states" ? too_many_states_sentence(summary) : status_sentence(status);
}

/// At how many points stability is known, and why not at the others.
std::string partly_known_sentence(const Summary& summary) {
  const double points = number_in(summary, quantities::points),
               left = number_in(summary, quantities::points_stability_not_known);
  return fmt::format("Stability is known at {:.0f} of {:.0f} points. {}", points - left, points,
                     sentence_of(summary, text_in(summary, quantities::stability_not_known)));
}

/// "branch 2", "isola 1", or "the curve", of a row of unstable parts.
std::string curve_of_part(const Table& parts, std::size_t row) {
  const std::string branch = cell_text(parts.at(row, "branch")),
                    isola = parts.has_column("isola") ? cell_text(parts.at(row, "isola")) : "0";
  if (isola == "0") return branch == "0" ? "the curve" : "branch " + branch;
  return "isola " + isola + (branch == "0" ? "" : ", branch " + branch + ",");
}

/// The unstable parts of the curve, of each branch and of each isola.
void append_unstable_parts(std::vector<std::string>& sentences, const Summary& summary,
                           const SweepAxis& axis) {
  if (find_entry(summary, quantities::points_stability_not_known.name) == nullptr) return;
  const auto* parts = value_in<Table>(summary, quantities::unstable_parts.name);
  if (parts == nullptr) {
    if (number_in(summary, quantities::points_stability_not_known) < number_in(summary, quantities::points))
      sentences.emplace_back("No motion whose stability is known is unstable.");
    return;
  }
  std::vector<std::pair<std::string, std::vector<std::string>>> places;  // curve by curve, as the rows
  const std::vector<double> begins = parts->numbers("begin_" + axis.suffix),
                            ends = parts->numbers("end_" + axis.suffix);
  for (std::size_t i = 0; i < parts->rows(); ++i) {
    const std::string curve = curve_of_part(*parts, i);
    if (places.empty() || places.back().first != curve)
      places.emplace_back(curve, std::vector<std::string>());
    places.back().second.push_back(begins[i] == ends[i]
                                       ? fmt::format("{:.7g} {}", ends[i], axis.unit)
                                       : fmt::format("{:.7g} to {:.7g} {}", begins[i], ends[i], axis.unit));
  }
  for (const auto& [curve, where] : places)
    sentences.push_back(fmt::format("Along {} motions are unstable at {}.", curve, fmt::join(where, ", ")));
}

}  // namespace

std::vector<std::string> stability_sentences(const Summary& summary, const SweepAxis& axis) {
  const std::string status = text_in(summary, quantities::stability);
  if (status.empty()) {
    const std::string analysis = text_in(summary, quantities::analysis);
    const bool curve = analysis == "frequency_sweep" || analysis == "amplitude_sweep";
    return curve ? std::vector{status_sentence("not_computed")} : std::vector<std::string>{};
  }
  std::vector<std::string> sentences{status == "partly_known" ? partly_known_sentence(summary)
                                                              : sentence_of(summary, status)};
  const double unstable = number_in(summary, quantities::unstable_multipliers);
  const double real = number_in(summary, quantities::leading_multiplier_real),
               imaginary = number_in(summary, quantities::leading_multiplier_imag);
  if (unstable > 0.0)
    sentences.push_back(fmt::format("{:.0f} of its Floquet multipliers {} outside the unit circle.", unstable,
                                    unstable == 1.0 ? "lies" : "lie"));
  // Smaller ones are rounding.
  constexpr double least = 1e-12;
  const double modulus = std::hypot(real, imaginary);
  if (std::isfinite(real))
    sentences.push_back(modulus < least
                            ? "The leading multiplier has an absolute value below 1e-12."
                            : fmt::format("The leading multiplier has the absolute value {:.4g}.", modulus));
  append_unstable_parts(sentences, summary, axis);
  append_special_points(sentences, summary, axis);
  return sentences;
}

}  // namespace wavebalance::app

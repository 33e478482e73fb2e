#include <fmt/format.h>
#include <fmt/ranges.h>

#include "files/number_text.hpp"
#include "report/words.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/files/quantity_text.hpp"

namespace wavebalance::app {
namespace {

/// One sentence for each status of stability that a record can have.
std::string status_sentence(const std::string& status) {
  static const std::map<std::string, std::string> known{
      {"stable", "The motion is stable: small disturbances decay."},
      {"unstable", "The motion is unstable: small disturbances grow."},
      {"converged", "Stability is known at every point."},
      {"partly_known", "Stability is known at some points."},
      {"no_law_of_impact", "Stability is not known: rigid contact with mass requires a law of impact."},
      {"no_finite_stiffness", "Stability is not known: the contact is rigid and has no finite stiffness."},
      {"too_few_samples",
       "Near grazing, contact lasts less than the spacing of the time samples, and stability is "
       "not known. More quadrature_points narrow this range."},
      {"too_few_harmonics",
       "Stability is not known everywhere: the basis functions do not resolve the contact "
       "stiffness. More functions help."},
      {"structural_damping",
       "Stability is not known: structural damping has no equation in time. modal_damping = "
       "loss_factor / 2 is a viscous replacement."},
      {"undamped", "Stability is not asymptotic: the structure has a mode without damping."},
      {"on_unit_circle",
       "Stability is not known: a multiplier is on the unit circle within its error, and none is outside."},
      {"too_many_phases",
       "Stability is not known: there are too many contact intervals for an exact periodic solution."},
      {"coupled_massless",
       "Stability is not known: massless contacts without damping are coupled statically."},
      {"no_modes", "Stability is not known: the modes of the structure could not be computed."},
      {"effort_limit",
       "Stability is not known everywhere: counting the multipliers takes too many operations."},
      {"no_response", "Stability is not known: there is no motion."},
      {"not_found",
       "Stability is not known where no exact periodic solution was found near the computed response."},
      {"not_computed", "Stability was not computed. analysis.stability = true computes it."},
      {"interrupted", "The computation of stability was interrupted."},
  };
  const auto found = known.find(status);
  return found == known.end() ? "Stability is not known (" + spaced_words(status) + ")." : found->second;
}

/// "Folds", or the name itself for a type that has no other, by their importance.
std::pair<std::ptrdiff_t, std::string> type_in_words(const std::string& type) {
  static const std::vector<std::pair<std::string, std::string>> known{
      {"fold", "Folds, where the curve turns back"},
      {"branch", "Branch points, where another branch begins"},
      {"period_doubling", "Period doublings, where motions of two periods begin"},
      {"neimark_sacker", "Neimark-Sacker points, where quasi-periodic motions begin"},
      {"slip", "Slip onset, where the first contact starts to slip or the last one stops"},
      {"stick", "Stick onset, where a contact that always slips starts to stick, or stops sticking"},
      {"krein_collision",
       "Krein collisions, where two pairs of multipliers meet on the unit circle and leave it: "
       "flutter begins"},
      {"grazing", "Grazing points, where a contact interval is created, destroyed, split or merged"}};
  const auto found = std::ranges::find_if(known, [&](const auto& one) { return one.first == type; });
  return {found - known.begin(), found == known.end() ? spaced_words(type) : found->second};
}

/// Exact points if the whole exact curve was followed.
void append_special_points(std::vector<std::string>& sentences, const Summary& summary,
                           const SweepAxis& axis) {
  const bool whole = text_in(summary, quantities::structure_curve) == "whole";
  const auto* points = value_in<Table>(
      summary, (whole ? quantities::structure_special_points : quantities::special_points).name);
  if (points == nullptr || points->empty()) return;
  std::map<std::pair<std::ptrdiff_t, std::string>, std::vector<std::string>> places;
  for (std::size_t i = 0; i < points->rows(); ++i)
    if (const auto* place = std::get_if<double>(&points->at(i, axis.column())))
      places[type_in_words(cell_text(points->at(i, "type")))].push_back(quantity(*place, axis.unit, 7));
  constexpr std::size_t most = 8;
  for (const auto& [type, where] : places)
    sentences.push_back(fmt::format(
        "{}: {}{}.", type.second, fmt::join(std::span(where).first(std::min(most, where.size())), ", "),
        where.size() > most ? fmt::format(" and {} more", where.size() - most) : ""));
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
      "Stability is not known{}: with {} it requires all {}states of the structure, and at "
      "most {:.0f} are supported. structure.kept_modes reduces them.",
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

/// "60 to 80 Hz", "800 µm to 1.2 mm", and one value where both are the same text.
std::string range_text(double begin, double end, const std::string& unit) {
  std::string first = quantity(begin, unit, 7);
  const std::string last = quantity(end, unit, 7);
  if (first == last) return last;
  const std::string shown = last.substr(last.rfind(' '));
  if (first.ends_with(shown)) first.resize(first.size() - shown.size());
  return first + " to " + last;
}

/// The unstable parts of the curve, of each branch and of each isola.
std::vector<std::string> unstable_parts(const Summary& summary, const SweepAxis& axis) {
  if (find_entry(summary, quantities::points_stability_not_known.name) == nullptr) return {};
  const auto* parts = value_in<Table>(summary, quantities::unstable_parts.name);
  if (parts == nullptr) {
    const double left = number_in(summary, quantities::points_stability_not_known);
    if (left == 0.0) return {"All points of the curve are stable."};
    if (left < number_in(summary, quantities::points)) return {"No point of known stability is unstable."};
    return {};
  }
  std::vector<std::pair<std::string, std::vector<std::string>>> places;  // curve by curve, as the rows
  const std::vector<double> begins = parts->numbers("begin_" + axis.suffix),
                            ends = parts->numbers("end_" + axis.suffix);
  for (std::size_t i = 0; i < parts->rows(); ++i) {
    const std::string curve = curve_of_part(*parts, i);
    if (places.empty() || places.back().first != curve)
      places.emplace_back(curve, std::vector<std::string>());
    places.back().second.push_back(range_text(begins[i], ends[i], axis.unit));
  }
  std::vector<std::string> sentences;
  for (const auto& [curve, where] : places)
    sentences.push_back(fmt::format("Along {} motions are unstable at {}.", curve, fmt::join(where, ", ")));
  return sentences;
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
    sentences.front() += fmt::format(" {:.0f} of its Floquet multipliers {} outside the unit circle.",
                                     unstable, unstable == 1.0 ? "is" : "are");
  // Smaller ones are rounding.
  constexpr double least = 1e-12;
  const double modulus = std::hypot(real, imaginary);
  if (std::isfinite(real))
    sentences.front() +=
        modulus < least ? " The leading Floquet multiplier has a modulus below 10⁻¹²."
                        : " The leading Floquet multiplier has the modulus " + short_number(modulus) + ".";
  const std::vector<std::string> parts = unstable_parts(summary, axis);
  if (!parts.empty()) sentences.push_back(parts.front());
  append_special_points(sentences, summary, axis);
  if (!parts.empty()) sentences.insert(sentences.end(), parts.begin() + 1, parts.end());
  return sentences;
}

}  // namespace wavebalance::app

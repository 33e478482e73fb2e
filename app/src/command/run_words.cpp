#include "command/run_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "command/other_motions.hpp"
#include "plot/unit_prefix.hpp"
#include "results/quantities.hpp"

namespace wavebalance::app {
namespace {

std::string spaced(std::string words) {
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string count_of(const Summary& summary, const Quantity& of, const std::string& noun) {
  const double count = number_in(summary, of);
  return fmt::format("{:.0f} {}{}", count, noun, count == 1.0 ? "" : "s");
}

/// A value of the summary with its unit.
std::string with_unit(const Summary& summary, const Quantity& one) {
  return quantity(number_in(summary, one), std::string(one.unit));
}

std::string percent(double share) { return fmt::format("{:.3g} %", 100.0 * share); }

/// Why a response by phases was not found, and what to take instead; empty for other statuses.
std::string phases_sentence(const std::string& status) {
  static const std::map<std::string, std::string> known{
      {"no_start",
       "No balance with up to 511 functions converged, and no integration gave a start: time.method = \"balance\" with "
       "more functions may lead to a motion."},
      {"not_found",
       "The search by phases ended without a motion; whether the structure has one is not known. time.method = "
       "\"balance\" with more functions solves for the samples alone."},
      {"tolerance_missed",
       "The phases do not come as near as time.tolerance demands: a larger one takes the motion found."},
      {"rigid_contact",
       "Phases do not take a rigid contact with mass, or with a structure that is free to move: time.method = "
       "\"balance\" does."},
      {"velocity_and_no_mass",
       "Phases do not take a force of the velocity at a contact without mass: time.method = \"balance\" does."},
      {"resonant",
       "The structure without contact has a motion of this period of its own: another frequency, or damping, takes "
       "it away."},
      {"structural_damping",
       "A loss factor has no equation in time, by which phases are solved: time.method = \"balance\" takes it, and "
       "modal_damping = loss_factor / 2 in its place gives phases."},
      {"chattering",
       "From where it begins impacts follow each other ever faster until the contact stays closed, which is solved for "
       "without rebound alone. Other states may lead to a motion: analysis.type = \"motions\" seeks them. "
       "contact.restitution = 0, or a stiff \"linear\" law, takes it."},
      {"lasting_contact",
       "An impact without rebound leaves the contact closed, and no periodic motion with it was found: a stiff "
       "\"linear\" law may lead to one."},
      {"not_settled",
       "The motion from rest did not repeat within the periods integrated: it is aperiodic, has more than 16 periods of "
       "the load, or has not settled yet. Other motions were not sought."},
      {"grazing", "A contact touches its obstacle so slightly that it cannot be told whether it does."},
      {"too_many_impacts", "There are more than 2000 impacts in a period of the load."},
      {"no_modes",
       "The modes of the structure, by which phases are solved, could not be computed: time.method = \"balance\" needs "
       "none."}};
  const auto found = known.find(status);
  return found == known.end() ? "" : " " + found->second;
}

std::string solution_sentence(const Summary& summary) {
  const bool* converged = value_in<bool>(summary, quantities::converged.name);
  const std::string seconds = with_unit(summary, quantities::wall_seconds);
  const double residual = number_in(summary, quantities::residual);
  const std::string ending =
      std::isfinite(residual)
          ? fmt::format(", in {}; the largest relative residual is {:.2g}.", seconds, residual)
          : fmt::format(", in {}.", seconds);
  if (converged != nullptr && *converged) return "The scene was solved" + ending;
  if (text_in(summary, quantities::status) == "unbalanced")
    return "No periodic motion exists: the structure is free to move, and no contact force balances its static load.";
  const bool shown = std::isfinite(number_in(summary, quantities::max_displacement)) ||
                     number_in(summary, quantities::points) > 0.0;
  return "The scene was not solved (" + spaced(text_in(summary, quantities::status)) + ")" + ending +
         (shown ? " What follows is not a solution." : " There is no motion to show.") +
         phases_sentence(text_in(summary, quantities::status));
}

/// How far a displacement passes the gap; empty where there is none.
std::string beside_gap(double displacement, double gap) {
  if (!(gap > 0.0) || !std::isfinite(displacement)) return "";
  constexpr double rounding = 1e-9;
  const double past = displacement / gap - 1.0;
  if (std::abs(past) <= rounding) return fmt::format(", the gap of {}", quantity(gap, "m"));
  return fmt::format(", {} {} the gap of {}", percent(std::abs(past)), past < 0.0 ? "short of" : "past",
                     quantity(gap, "m"));
}

/// What impacts do in a motion, or at most along a curve.
void append_impacts(std::vector<std::string>& sentences, const Summary& summary) {
  const double impulse = number_in(summary, quantities::max_impulse),
               count = number_in(summary, quantities::impacts),
               share = number_in(summary, quantities::contact_fraction);
  if (impulse == 0.0) {
    sentences.emplace_back("There is no contact.");
    return;
  }
  const std::string largest = quantity(impulse, "N s");
  if (std::isfinite(count))
    sentences.push_back(
        fmt::format("There {} {:.0f} impact{} in the period of the motion, at up to {}; the largest "
                    "impulse is {}, and impacts take {} in a period of the load.",
                    count == 1.0 ? "is" : "are", count, count == 1.0 ? "" : "s",
                    with_unit(summary, quantities::max_impact_velocity), largest,
                    with_unit(summary, quantities::impact_energy)));
  else
    sentences.push_back(fmt::format("The largest impulse of an impact is {}.", largest));
  if (share > 0.0)
    sentences.push_back(fmt::format("Contact lasts for {} of the period; its largest force is {}.",
                                    percent(share), with_unit(summary, quantities::max_contact_force)));
}

/// `limit` is "up to " for a curve, whose shares differ from point to point.
void append_contact(std::vector<std::string>& sentences, const Summary& summary, const char* limit) {
  const double share = number_in(summary, quantities::contact_fraction),
               force = number_in(summary, quantities::max_contact_force);
  if (std::isfinite(number_in(summary, quantities::max_impulse))) {
    append_impacts(sentences, summary);
  } else if (share == 0.0) {
    sentences.emplace_back("There is no contact.");
  } else if (std::isfinite(share)) {
    sentences.push_back(fmt::format("Contact takes {}{} of the period; the largest contact force is {}.",
                                    limit, percent(share), quantity(force, "N")));
  } else if (std::isfinite(force)) {
    sentences.push_back(fmt::format("The largest contact force is {}.", quantity(force, "N")));
  }
}

void append_motion(std::vector<std::string>& sentences, const Summary& summary, double gap) {
  const double highest = number_in(summary, quantities::max_displacement),
               lowest = number_in(summary, quantities::min_displacement);
  if (!std::isfinite(highest)) return;
  sentences.push_back(fmt::format("At {} the displacement lies between {} and {}{}.",
                                  with_unit(summary, quantities::frequency), quantity(lowest, "m"),
                                  quantity(highest, "m"), beside_gap(highest, gap)));
}

/// How far what was solved lies from the motion of the structure itself, where the record says it.
void append_phases(std::vector<std::string>& sentences, const Summary& summary, bool curve) {
  const std::string status = text_in(summary, quantities::phases_status);
  const double error = number_in(summary, quantities::error_of_displacement),
               force = number_in(summary, quantities::error_of_force);
  if (std::isfinite(error)) {
    sentences.push_back(
        fmt::format("{} displacement is {} off that of the structure's own motion, by contact phases{}.",
                    curve ? "At the peak the" : "The", percent(error),
                    std::isfinite(force) ? ", and the contact force " + percent(force) : ""));
  } else if (!status.empty() && status != "not_found" && status != "not_computed") {
    sentences.push_back("How far it is off the structure's own motion is not known (" + spaced(status) +
                        ").");
  }
}

void append_motions(std::vector<std::string>& sentences, const Summary& summary, double gap) {
  const auto* motions = value_in<Table>(summary, quantities::motions.name);
  if (motions == nullptr || motions->rows() == 0) return;
  int stable = 0;
  for (std::size_t i = 0; i < motions->rows(); ++i)
    stable += cell_text(motions->at(i, "stability")) == "stable";
  const std::size_t all = motions->rows();
  sentences.push_back(fmt::format("There {} {} motion{}, of which {} {} stable, from {} and rest.",
                                  all == 1 ? "is" : "are", all, all == 1 ? "" : "s", stable,
                                  stable == 1 ? "is" : "are",
                                  count_of(summary, quantities::random_starts, "random start")));
  append_motion(sentences, summary, gap);
}

void append_curve(std::vector<std::string>& sentences, const Summary& summary, double gap,
                  const SweepAxis& axis) {
  const double highest = number_in(summary, quantities::max_displacement);
  sentences.push_back(fmt::format("The curve has {}.", count_of(summary, quantities::points, "point")));
  if (!std::isfinite(highest)) return;
  sentences.push_back(fmt::format("Its largest displacement is {}, at {}{}{}.", quantity(highest, "m"),
                                  axis.quantity == "frequency" ? "" : "an amplitude of ",
                                  with_unit(summary, quantities::peak_place(axis.unit)),
                                  beside_gap(highest, gap)));
}

void append_damped_mode(std::vector<std::string>& sentences, const Summary& summary) {
  const double most = number_in(summary, quantities::largest_damping_ratio);
  if (std::isfinite(most)) {
    sentences.push_back(fmt::format(
        "Mode {:.0f} was followed over {}. Below an amplitude of {} no contact slips, and its frequency is {}.",
        number_in(summary, quantities::mode), count_of(summary, quantities::points, "point"),
        with_unit(summary, quantities::slip_amplitude), with_unit(summary, quantities::linear_frequency)));
    sentences.push_back(
        fmt::format("Its frequency falls to {:.4g} of that, and its damping ratio is at most {:.4g}.",
                    number_in(summary, quantities::least_frequency_ratio), most));
  } else if (const double ratio = number_in(summary, quantities::damping_ratio); std::isfinite(ratio)) {
    sentences.push_back(
        fmt::format("The free motion of mode {:.0f} has the frequency {} and the damping ratio {:.4g}.",
                    number_in(summary, quantities::mode), with_unit(summary, quantities::frequency), ratio));
  }
}

void append_mode(std::vector<std::string>& sentences, const Summary& summary) {
  append_damped_mode(sentences, summary);
  const double ratio = number_in(summary, quantities::largest_energy_ratio);
  if (!std::isfinite(ratio)) return;
  sentences.push_back(fmt::format(
      "Mode {:.0f} was followed over {} to {:.4g} times the energy at which the linear mode touches.",
      number_in(summary, quantities::mode), count_of(summary, quantities::points, "point"), ratio));
  sentences.push_back(fmt::format("Its frequency rises to {:.4g} times the linear one of {}.",
                                  number_in(summary, quantities::largest_frequency_ratio),
                                  with_unit(summary, quantities::linear_frequency)));
  if (number_in(summary, quantities::points_tongue) > 0.0)
    sentences.emplace_back(
        "A tongue is a part of the curve on an internal resonance, where another mode moves along with this one.");
  if (std::isfinite(number_in(summary, quantities::virial_residual)))
    sentences.push_back(fmt::format(
        "The virial residual, at most {:.2g}, is the relative error of a balance of energies that exact motions "
        "satisfy.",
        number_in(summary, quantities::virial_residual)));
}

/// One sentence for each status of stability that a record can have.
std::string status_sentence(const std::string& status) {
  static const std::map<std::string, std::string> known{
      {"stable", "The motion is stable: a small disturbance dies away."},
      {"unstable", "The motion is unstable: a small disturbance grows, and the structure leaves it."},
      {"converged", "Stability is known at every point."},
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
      {"coupled_massless",
       "Stability is not known: contacts without mass and damping deflect each other at once."},
      {"too_many_states",
       "Stability is not known: with friction or a damped contact law it takes all states of the structure, of which "
       "there are too many. structure.kept_modes reduces them."},
      {"no_modes", "Stability is not known: the modes of the structure could not be computed."},
      {"effort_limit",
       "Stability is not known everywhere: the count of multipliers took too many operations."},
      {"not_confirmed",
       "Stability is not known: contact phases do not take this motion, and the balance with twice the functions has "
       "another number of multipliers outside the unit circle, or no response near. More functions may settle it."},
      {"no_response", "Stability is not known: there is no motion."},
      {"not_found",
       "Stability is not known where the search by phases found no motion of the structure near the response of the "
       "samples."},
      {"not_computed", "Stability was not computed; analysis.stability = true asks for it."},
      {"interrupted", "The computation of stability was interrupted."},
  };
  const auto found = known.find(status);
  return found == known.end() ? "Stability is not known (" + spaced(status) + ")." : found->second;
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
      {"krein_collision",
       "Krein collisions, where two pairs of multipliers meet on the unit circle and leave it, so that a small "
       "disturbance begins to oscillate and grow"}};
  const auto found = known.find(type);
  return found == known.end() ? spaced(type) : found->second;
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

/// Frequencies or amplitudes of the special points at which multipliers pass the unit circle.
std::vector<double> changes_of_stability(const Summary& summary, const std::string& column) {
  std::vector<double> places;
  const auto* points = value_in<Table>(summary, quantities::special_points.name);
  for (std::size_t i = 0; points != nullptr && i < points->rows(); ++i)
    if (const auto* place = std::get_if<double>(&points->at(i, column));
        place != nullptr && cell_text(points->at(i, "type")) != "grazing" &&
        cell_text(points->at(i, "type")) != "slip")
      places.push_back(*place);
  return places;
}

/// Where stability changes between a stable and an unstable point: the special point between them, or the
/// unstable one where there is none.
double end_of_part(const std::vector<double>& changes, double stable, double unstable) {
  const double low = std::min(stable, unstable), high = std::max(stable, unstable);
  const auto between =
      std::find_if(changes.begin(), changes.end(), [&](double at) { return low <= at && at <= high; });
  return between == changes.end() ? unstable : *between;
}

/// The first and last frequency or amplitude of each unstable part of a curve, "1337.7 to 1315 Hz".
std::vector<std::string> unstable_parts(const std::vector<double>& place, const std::vector<double>& unstable,
                                        const std::vector<double>& changes, const std::string& unit) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < unstable.size(); ++i) {
    if (!(unstable[i] > 0.0)) continue;
    const std::size_t first = i;
    while (i + 1 < unstable.size() && unstable[i + 1] > 0.0) ++i;
    const double begin = first == 0 ? place[0] : end_of_part(changes, place[first - 1], place[first]),
                 end = i + 1 == place.size() ? place[i] : end_of_part(changes, place[i + 1], place[i]);
    parts.push_back(begin == end ? fmt::format("{:.6g} {}", end, unit)
                                 : fmt::format("{:.6g} to {:.6g} {}", begin, end, unit));
  }
  return parts;
}

void append_unstable_parts(std::vector<std::string>& sentences, const Summary& summary, const Table& all,
                           const SweepAxis& axis) {
  if (!all.has_column("unstable") || all.has_column("branch")) return;
  const Table curve = all.has_column(quantities::isola.name) ? all.where(quantities::isola.name, "0") : all;
  const std::vector<double> unstable = curve.numbers("unstable");
  const auto not_known =
      std::count_if(unstable.begin(), unstable.end(), [](double n) { return std::isnan(n); });
  if (not_known == static_cast<std::ptrdiff_t>(unstable.size())) return;
  const auto parts = unstable_parts(curve.numbers(axis.column()), unstable,
                                    changes_of_stability(summary, axis.column()), axis.unit);
  sentences.push_back(
      parts.empty() ? "No motion whose stability is known is unstable."
                    : fmt::format("Along the curve motions are unstable at {}.", fmt::join(parts, ", ")));
  if (not_known > 0)
    sentences.push_back(
        fmt::format("Stability is not known at {} of {} points.", not_known, unstable.size()));
}

}  // namespace

std::vector<std::string> outcome_sentences(const Summary& summary, double gap, const SweepAxis& axis) {
  std::vector<std::string> sentences{solution_sentence(summary)};
  const std::string analysis = text_in(summary, quantities::analysis);
  const bool curve = analysis == "frequency_sweep" || analysis == "amplitude_sweep";
  if (curve)
    append_curve(sentences, summary, gap, axis);
  else if (analysis == "nonlinear_mode")
    append_mode(sentences, summary);
  else if (analysis == "motions")
    append_motions(sentences, summary, gap);
  else
    append_motion(sentences, summary, gap);
  append_contact(sentences, summary, curve ? "up to " : "");
  append_phases(sentences, summary, curve);
  if (const std::string others = other_motions_sentence(summary, curve); !others.empty())
    sentences.push_back(others);
  return sentences;
}

std::vector<std::string> stability_sentences(const Summary& summary, const Table& curve,
                                             const SweepAxis& axis) {
  const std::string status = text_in(summary, quantities::stability);
  if (status.empty()) return {};
  std::vector<std::string> sentences{status_sentence(status)};
  const double unstable = number_in(summary, quantities::unstable_multipliers);
  const double real = number_in(summary, quantities::leading_multiplier_real),
               imaginary = number_in(summary, quantities::leading_multiplier_imag);
  if (unstable > 0.0)
    sentences.push_back(fmt::format("Of its Floquet multipliers {:.0f} {} outside the unit circle.", unstable,
                                    unstable == 1.0 ? "lies" : "lie"));
  if (std::isfinite(real))
    sentences.push_back(
        fmt::format("The leading multiplier has the absolute value {:.4g}.", std::hypot(real, imaginary)));
  append_unstable_parts(sentences, summary, curve, axis);
  append_special_points(sentences, summary, axis);
  return sentences;
}

}  // namespace wavebalance::app

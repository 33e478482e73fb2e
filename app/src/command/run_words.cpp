#include "command/run_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace wavebalance::app {
namespace {

template <class Value>
const Value* find(const Summary& summary, const std::string& name) {
  for (const auto& [key, value] : summary)
    if (key == name) return std::get_if<Value>(&value);
  return nullptr;
}

double number(const Summary& summary, const std::string& name) {
  if (const auto* value = find<double>(summary, name)) return *value;
  if (const auto* count = find<std::int64_t>(summary, name)) return static_cast<double>(*count);
  return std::numeric_limits<double>::quiet_NaN();
}

std::string text(const Summary& summary, const std::string& name) {
  const auto* value = find<std::string>(summary, name);
  return value == nullptr ? "" : *value;
}

std::string spaced(std::string words) {
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string count_of(const Summary& summary, const std::string& name, const std::string& noun) {
  const double count = number(summary, name);
  return fmt::format("{:.0f} {}{}", count, noun, count == 1.0 ? "" : "s");
}

std::string percent(double share) { return fmt::format("{:.3g} %", 100.0 * share); }

std::string solution_sentence(const Summary& summary) {
  const bool* converged = find<bool>(summary, "converged");
  const std::string seconds = quantity(number(summary, "wall_seconds"), "s");
  const double residual = number(summary, "residual");
  const std::string ending =
      std::isfinite(residual)
          ? fmt::format(", in {}; the largest relative residual is {:.2g}.", seconds, residual)
          : fmt::format(", in {}.", seconds);
  if (converged != nullptr && *converged) return "The scene was solved" + ending;
  if (text(summary, "status") == "unbalanced")
    return "No periodic motion exists: the structure is free to move, and no contact force balances its static load.";
  const bool shown = std::isfinite(number(summary, "max_displacement_m")) || number(summary, "points") > 0.0;
  return "The scene was not solved (" + spaced(text(summary, "status")) + ")" + ending +
         (shown ? " What follows is not a solution." : " There is no motion to show.");
}

/// How far a displacement passes the gap; empty where there is none.
std::string beside_gap(double displacement, double gap) {
  if (!(gap > 0.0) || !std::isfinite(displacement)) return "";
  const double past = displacement / gap - 1.0;
  return fmt::format(", {} {} the gap of {}", percent(std::abs(past)), past < 0.0 ? "short of" : "past",
                     quantity(gap, "m"));
}

/// `limit` is "up to " for a curve, whose shares differ from point to point.
void append_contact(std::vector<std::string>& sentences, const Summary& summary, const char* limit) {
  const double share = number(summary, "contact_fraction"), force = number(summary, "max_contact_force_N");
  if (share == 0.0) {
    sentences.emplace_back("There is no contact.");
  } else if (std::isfinite(share)) {
    sentences.push_back(fmt::format("Contact takes {}{} of the period; the largest contact force is {}.",
                                    limit, percent(share), quantity(force, "N")));
  } else if (std::isfinite(force)) {
    sentences.push_back(fmt::format("The largest contact force is {}.", quantity(force, "N")));
  }
}

void append_motion(std::vector<std::string>& sentences, const Summary& summary, double gap) {
  const double highest = number(summary, "max_displacement_m"),
               lowest = number(summary, "min_displacement_m");
  if (!std::isfinite(highest)) return;
  sentences.push_back(fmt::format("At {} the displacement lies between {} and {}{}.",
                                  quantity(number(summary, "frequency_Hz"), "Hz"), quantity(lowest, "m"),
                                  quantity(highest, "m"), beside_gap(highest, gap)));
}

/// Ends of the names of columns and units of amplitude sweeps.
constexpr std::pair<const char*, const char*> amplitude_units[] = {
    {"N", "N"}, {"m", "m"}, {"m_per_s2", "m/s^2"}};

/// The column that a sweep varies and its unit; empty for other curves.
std::pair<std::string, std::string> swept_column(const Table& table) {
  if (table.has_column("frequency_Hz")) return {"frequency_Hz", "Hz"};
  for (const auto& [suffix, unit] : amplitude_units)
    if (table.has_column("amplitude_" + std::string(suffix)))
      return {"amplitude_" + std::string(suffix), unit};
  return {};
}

void append_curve(std::vector<std::string>& sentences, const Summary& summary, double gap) {
  const double highest = number(summary, "max_displacement_m");
  sentences.push_back(fmt::format("The curve has {}.", count_of(summary, "points", "point")));
  if (!std::isfinite(highest)) return;
  std::string place = quantity(number(summary, "frequency_at_max_displacement_Hz"), "Hz");
  for (const auto& [suffix, unit] : amplitude_units)
    if (const double amplitude = number(summary, "amplitude_at_max_displacement_" + std::string(suffix));
        std::isfinite(amplitude))
      place = "an amplitude of " + quantity(amplitude, unit);
  sentences.push_back(fmt::format("Its largest displacement is {}, at {}{}.", quantity(highest, "m"), place,
                                  beside_gap(highest, gap)));
}

void append_mode(std::vector<std::string>& sentences, const Summary& summary) {
  const double ratio = number(summary, "largest_energy_ratio");
  if (!std::isfinite(ratio)) return;
  sentences.push_back(fmt::format(
      "Mode {:.0f} was followed over {} to {:.4g} times the energy at which the linear mode touches.",
      number(summary, "mode"), count_of(summary, "points", "point"), ratio));
  sentences.push_back(fmt::format("Its frequency rises to {:.4g} times the linear one of {}.",
                                  number(summary, "largest_frequency_ratio"),
                                  quantity(number(summary, "linear_frequency_Hz"), "Hz")));
  if (number(summary, "points_tongue") > 0.0)
    sentences.emplace_back(
        "A tongue is a part of the curve on an internal resonance, where another mode moves along with this one.");
  if (std::isfinite(number(summary, "virial_residual")))
    sentences.push_back(fmt::format(
        "The virial residual, at most {:.2g}, is the relative error of a balance of energies that exact motions "
        "satisfy.",
        number(summary, "virial_residual")));
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
      {"coupled_massless",
       "Stability is not known: contacts without mass and damping deflect each other at once."},
      {"too_many_states",
       "Stability is not known: with a damped contact law it takes all states of the structure, of which there are "
       "too many."},
      {"no_modes", "Stability is not known: the modes of the structure could not be computed."},
      {"effort_limit",
       "Stability is not known everywhere: the count of multipliers took too many operations."},
      {"no_response", "Stability is not known: there is no motion."},
      {"no_motion_near",
       "Stability is not known: no motion of the structure was found near this response of the samples."},
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
      {"krein_collision",
       "Krein collisions, where two pairs of multipliers meet on the unit circle and leave it, so that a small "
       "disturbance begins to oscillate and grow"}};
  const auto found = known.find(type);
  return found == known.end() ? spaced(type) : found->second;
}

void append_special_points(std::vector<std::string>& sentences, const Summary& summary) {
  const auto* points = find<Table>(summary, "special_points");
  if (points == nullptr || points->empty()) return;
  const auto [column, unit] = swept_column(*points);
  const bool sweep = !column.empty();
  const std::string place = sweep ? column : points->columns().at(1);
  std::map<std::string, std::vector<std::string>> places;
  for (std::size_t i = 0; i < points->rows(); ++i)
    if (const auto* value = std::get_if<double>(&points->at(i, place)))
      places[type_in_words(cell_text(points->at(i, "type")))].push_back(
          sweep ? fmt::format("{:.7g} {}", *value, unit) : fmt::format("{} {:.5g}", spaced(place), *value));
  for (const auto& [type, where] : places)
    sentences.push_back(fmt::format("{}: {}.", type, fmt::join(where, ", ")));
}

/// Frequencies or amplitudes of the special points at which multipliers pass the unit circle.
std::vector<double> changes_of_stability(const Summary& summary, const std::string& column) {
  std::vector<double> places;
  const auto* points = find<Table>(summary, "special_points");
  for (std::size_t i = 0; points != nullptr && i < points->rows(); ++i)
    if (const auto* place = std::get_if<double>(&points->at(i, column));
        place != nullptr && cell_text(points->at(i, "type")) != "grazing")
      places.push_back(*place);
  return places;
}

/// Where stability changes between a stable and an unstable point: the special point between them, or the
/// unstable one where there is none.
double end_of_part(const std::vector<double>& changes, double stable, double unstable) {
  const auto [low, high] = std::minmax(stable, unstable);
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

void append_unstable_parts(std::vector<std::string>& sentences, const Summary& summary, const Table& curve) {
  const auto [column, unit] = swept_column(curve);
  if (!curve.has_column("unstable") || column.empty() || curve.has_column("branch")) return;
  const std::vector<double> unstable = curve.numbers("unstable");
  const auto not_known =
      std::count_if(unstable.begin(), unstable.end(), [](double n) { return std::isnan(n); });
  if (not_known == static_cast<std::ptrdiff_t>(unstable.size())) return;
  const auto parts =
      unstable_parts(curve.numbers(column), unstable, changes_of_stability(summary, column), unit);
  sentences.push_back(
      parts.empty() ? "No motion whose stability is known is unstable."
                    : fmt::format("Along the curve motions are unstable at {}.", fmt::join(parts, ", ")));
  if (not_known > 0)
    sentences.push_back(fmt::format("Stability is not known at {} of {} points.", not_known, unstable.size()));
}

}  // namespace

std::string quantity(double value, const std::string& unit) {
  if (!std::isfinite(value)) return "not known";
  static const std::vector<std::pair<double, const char*>> prefixes{
      {1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1.0, ""}, {1e-3, "m"}, {1e-6, "µ"}, {1e-9, "n"}, {1e-12, "p"}};
  for (const auto& [factor, prefix] : prefixes)
    if (std::abs(value) >= factor && (factor <= 1.0 || unit == "N"))
      return fmt::format("{:.4g} {}{}", value / factor, prefix, unit);
  return fmt::format("{:.4g} {}", value, unit);
}

std::vector<std::string> outcome_sentences(const Summary& summary, double gap) {
  std::vector<std::string> sentences{solution_sentence(summary)};
  const std::string analysis = text(summary, "analysis");
  const bool curve = analysis == "frequency_sweep" || analysis == "amplitude_sweep";
  if (curve)
    append_curve(sentences, summary, gap);
  else if (analysis == "nonlinear_mode")
    append_mode(sentences, summary);
  else
    append_motion(sentences, summary, gap);
  append_contact(sentences, summary, curve ? "up to " : "");
  return sentences;
}

std::vector<std::string> stability_sentences(const Summary& summary, const Table& curve) {
  const std::string status = text(summary, "stability");
  if (status.empty()) return {};
  std::vector<std::string> sentences{status_sentence(status)};
  const double unstable = number(summary, "unstable_multipliers");
  const double real = number(summary, "leading_multiplier_real"),
               imaginary = number(summary, "leading_multiplier_imag");
  if (unstable > 0.0)
    sentences.push_back(fmt::format("Of its Floquet multipliers {:.0f} {} outside the unit circle.", unstable,
                                    unstable == 1.0 ? "lies" : "lie"));
  if (std::isfinite(real))
    sentences.push_back(
        fmt::format("The leading multiplier has the absolute value {:.4g}.", std::hypot(real, imaginary)));
  append_unstable_parts(sentences, summary, curve);
  append_special_points(sentences, summary);
  return sentences;
}

}  // namespace wavebalance::app

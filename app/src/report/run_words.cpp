#include "report/words.hpp"

#include <fmt/format.h>

#include "files/number_text.hpp"
#include "plot/plot_parts.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/compose/outputs.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/scene/scene.hpp"

namespace wavebalance::app {
namespace {

std::string count_of(const Summary& summary, const Quantity& of, const std::string& noun) {
  const double count = number_in(summary, of);
  return fmt::format("{:.0f} {}{}", count, noun, count == 1.0 ? "" : "s");
}

/// A value of the summary with its unit.
std::string with_unit(const Summary& summary, const Quantity& one) {
  return quantity(number_in(summary, one), std::string(one.unit));
}

/// For displacements of contacts.
std::string length_unit(const Summary& summary) {
  const std::string unit = text_in(summary, quantities::displacement_unit);
  return unit.empty() ? "m" : unit;
}

std::string force_unit_in(const Summary& summary) { return force_unit(length_unit(summary)); }

std::string shown_residual(double residual) {
  constexpr double rounding = 1e-12;
  return residual < rounding ? "below 10⁻¹²" : "of " + short_number(residual, 2);
}

std::string solution_sentence(const Summary& summary) {
  const bool* converged = value_in<bool>(summary, quantities::converged.name);
  const std::string seconds = with_unit(summary, quantities::wall_seconds);
  const double residual = number_in(summary, quantities::residual);
  const std::string ending =
      seconds + (std::isfinite(residual) ? ", with a relative residual " + shown_residual(residual) : "") +
      ".";
  if (converged != nullptr && *converged) return "The scene was solved in " + ending;
  if (text_in(summary, quantities::status) == "unbalanced")
    return "No periodic motion exists: the structure is free to move, and no contact force balances its static load.";
  const std::string status = text_in(summary, quantities::status);
  if (number_in(summary, quantities::points) > 0.0)
    return "The curve is not complete (" + spaced_words(status) + ") after " + ending +
           " Its points up to there are solutions.";
  const bool shown = std::isfinite(number_in(summary, quantities::max_displacement));
  if (shown && value_in<Table>(summary, quantities::motions.name) != nullptr)
    return "The search is not complete (" + spaced_words(status) + ") after " + ending +
           " The motions found up to there are solutions.";
  return "The scene was not solved (" + spaced_words(status) + ") after " + ending +
         (shown ? " The motion below is not a solution." : " There is no motion to show.") +
         exact_sentence(status);
}

/// How far a displacement passes the gap; empty where there is none.
std::string beside_gap(double displacement, double gap, const std::string& unit) {
  if (!(gap > 0.0) || !std::isfinite(displacement)) return "";
  constexpr double not_shown = 1e-5;  // with four digits
  const double past = displacement / gap - 1.0;
  if (std::abs(past) <= not_shown) return fmt::format(", the gap of {}", quantity(gap, unit));
  return fmt::format(", {} {} the gap of {}", percentage(std::abs(past)), past < 0.0 ? "short of" : "past",
                     quantity(gap, unit));
}

/// Impacts in a motion, or their maxima along a curve.
void append_impacts(std::vector<std::string>& sentences, const Summary& summary) {
  const double impulse = number_in(summary, quantities::max_impulse),
               count = number_in(summary, quantities::impacts),
               share = number_in(summary, quantities::contact_fraction);
  if (impulse == 0.0) return sentences.push_back("There is no contact.");
  const std::string largest = quantity(impulse, force_unit_in(summary) + " s");
  if (std::isfinite(count))
    sentences.push_back(fmt::format(
        "There {} {:.0f} impact{} in the period of the motion, at up to {}. The largest impulse is {}. "
        "Impacts dissipate {} per forcing period.",
        count == 1.0 ? "is" : "are", count, count == 1.0 ? "" : "s",
        quantity(number_in(summary, quantities::max_impact_velocity), length_unit(summary) + "/s"), largest,
        with_unit(summary, quantities::impact_energy)));
  else
    sentences.push_back(fmt::format(
        "Impacts have speeds of up to {} and impulses of up to {}.",
        quantity(number_in(summary, quantities::max_impact_velocity), length_unit(summary) + "/s"), largest));
  if (share > 0.0)
    sentences.push_back(
        fmt::format("Contact lasts for {} of the period. Its largest force is {}.", percentage(share),
                    quantity(number_in(summary, quantities::max_contact_force), force_unit_in(summary))));
}

/// Friction over a period: each of a few contacts, or sums.
void append_friction(std::vector<std::string>& sentences, const Summary& summary, const Table& contacts) {
  constexpr std::size_t few = 4;
  const std::vector<double> stick = contacts.numbers("stick_fraction"),
                            slip = contacts.numbers("slip_fraction"),
                            open = contacts.numbers("open_fraction");
  const auto any = [](const std::vector<double>& shares) {
    return std::ranges::count_if(shares, [](double share) { return share > 0.0; });
  };
  for (std::size_t i = 0; i < contacts.rows() && contacts.rows() <= few; ++i)
    sentences.push_back(fmt::format("{} sticks for {} of the period, slips for {} and is open for {}.",
                                    contacts.has_column("name")
                                        ? capitalised(cell_text(contacts.at(i, "name")))
                                        : "Contact " + cell_text(contacts.at(i, "contact")),
                                    percentage(stick[i]), percentage(slip[i]), percentage(open[i])));
  if (contacts.rows() > few)
    sentences.push_back(fmt::format("{} of {} contacts with friction slip within the period, and {} open.",
                                    any(slip), contacts.rows(), any(open)));
  sentences.push_back(fmt::format("Friction dissipates {} per period of the motion.",
                                  with_unit(summary, quantities::friction_work)));
}

/// The same along a curve, where a mean over the contacts is known at each point.
void append_friction_along(std::vector<std::string>& sentences, const Summary& summary) {
  const double slip = number_in(summary, quantities::max_slip_fraction),
               open = number_in(summary, quantities::max_open_fraction);
  sentences.push_back(slip > 0.0
                          ? fmt::format("Contacts slip for up to {} of the period (mean over all contacts).",
                                        percentage(slip))
                          : std::string("No contact slips."));
  sentences.push_back(open > 0.0 ? fmt::format("They are open for up to {} of it.", percentage(open))
                                 : std::string("No contact opens."));
}

/// `limit` is "up to " for a curve, whose shares differ from point to point.
void append_contact(std::vector<std::string>& sentences, const Summary& summary, const char* limit) {
  const double share = number_in(summary, quantities::contact_fraction),
               force = number_in(summary, quantities::max_contact_force);
  const auto* friction = value_in<Table>(summary, quantities::friction.name);
  if (std::isfinite(number_in(summary, quantities::max_impulse))) {
    append_impacts(sentences, summary);
  } else if (friction != nullptr && !friction->empty()) {
    append_friction(sentences, summary, *friction);
  } else if (std::isfinite(number_in(summary, quantities::max_slip_fraction))) {
    append_friction_along(sentences, summary);
  } else if (share == 0.0) {
    sentences.emplace_back("There is no contact.");
  } else if (std::isfinite(share)) {
    sentences.push_back(fmt::format("Contact lasts for {}{} of the period. The largest contact force is {}.",
                                    limit, percentage(share), quantity(force, force_unit_in(summary))));
  } else if (std::isfinite(force)) {
    sentences.push_back(
        fmt::format("The largest contact force is {}.", quantity(force, force_unit_in(summary))));
  }
}

void append_motion(std::vector<std::string>& sentences, const Summary& summary, double gap) {
  const double highest = number_in(summary, quantities::max_displacement),
               lowest = number_in(summary, quantities::min_displacement);
  if (!std::isfinite(highest)) return;
  const std::string unit = length_unit(summary);
  constexpr double rounding = 1e-9;
  const auto shown = [&](double value) {
    return quantity(std::abs(value) <= rounding * (highest - lowest) ? 0.0 : value, unit);
  };
  const double contact = number_in(summary, quantities::leading_contact);
  const std::string direction = text_in(summary, quantities::leading_direction),
                    named = text_in(summary, quantities::leading_contact_name);
  const std::string name =
      direction.empty() || !std::isfinite(contact)
          ? ""
          : fmt::format(" of {}, {},", named.empty() ? fmt::format("contact {}", contact) : named, direction);
  sentences.push_back(fmt::format("At {} the displacement{} is between {} and {}{}.",
                                  with_unit(summary, quantities::frequency), name, shown(lowest),
                                  shown(highest), beside_gap(highest, gap, unit)));
}

/// The errors of the vibration of outputs and contacts, "row 19 0.35 %", the output that leads first.
std::vector<std::string> vibration_errors(const Summary& summary, bool curve) {
  constexpr std::size_t most = 4;
  std::vector<std::string> errors;
  const auto* outputs = value_in<Table>(summary, quantities::outputs.name);
  const std::string column = curve ? "error_at_peak" : quantities::error_of_vibration.column();
  const bool known = outputs != nullptr && outputs->has_column(column);  // not along modes
  for (std::size_t i = 0; known && i < outputs->rows() && errors.size() < most; ++i) {
    const std::string name = cell_text(outputs->at(i, "output"));
    const double error = outputs->numbers(column)[i];
    if (!std::isfinite(error) || cell_text(outputs->at(i, "output")).starts_with("contact ")) continue;
    const bool leads = name == text_in(summary, quantities::leading_output);
    errors.insert(leads ? errors.begin() : errors.end(), name + " " + percentage(error));
  }
  const double contacts = number_in(summary, quantities::error_of_vibration);
  if (std::isfinite(contacts)) errors.push_back("contacts " + percentage(contacts));
  return errors;
}

/// Error of the solution against the exact periodic solution near it, if the record has it. An exact curve
/// lies nowhere else.
void append_exact(std::vector<std::string>& sentences, const Summary& summary, bool curve) {
  if (curve && text_in(summary, quantities::solved_by) == name_of(TimeMethod::exact)) return;
  const std::string status = text_in(summary, quantities::phases_status);
  const double error = number_in(summary, quantities::error_of_displacement),
               force = number_in(summary, quantities::error_of_force);
  if (const std::vector<std::string> errors = vibration_errors(summary, curve); !errors.empty())
    sentences.push_back(
        fmt::format("Error of the vibration{} against the nearest exact periodic solution found: {}.",
                    curve ? " at the peak" : "", fmt::join(errors, ", ")));
  if (std::isfinite(error)) {
    sentences.push_back(
        fmt::format("Over the period and all contacts{} the relative rms error is {} for the displacement{}.",
                    curve ? ", at the peak," : "", percentage(error),
                    std::isfinite(force) ? " and " + percentage(force) + " for the contact force" : ""));
    const double functions = number_in(summary, quantities::functions),
                 points = number_in(summary, quantities::quadrature_points);
    if (std::max(error, force) > 1e-2 && std::isfinite(functions + points))
      sentences.back() += fmt::format(
          " More time.quadrature_points (now {:.0f}) and more time.functions ({:.0f}) reduce these errors.",
          points, functions);
  } else if (!status.empty() && status != "not_found" && status != "not_computed") {
    sentences.push_back("The error against the exact periodic solution is not known (" +
                        (status == "too_many_phases" ? "too many contact intervals" : spaced_words(status)) +
                        ").");
  }
}

void append_motions(std::vector<std::string>& sentences, const Summary& summary, double gap) {
  const auto* motions = value_in<Table>(summary, quantities::motions.name);
  if (motions == nullptr || motions->rows() == 0) return;
  int stable = 0;
  for (std::size_t i = 0; i < motions->rows(); ++i)
    stable += cell_text(motions->at(i, "stability")) == "stable";
  sentences.push_back(fmt::format("From rest and {} {} motion{} {} found, and {} of them {} stable.",
                                  count_of(summary, quantities::random_starts, "random start"),
                                  motions->rows(), motions->rows() == 1 ? "" : "s",
                                  motions->rows() == 1 ? "was" : "were", stable, stable == 1 ? "is" : "are"));
  append_motion(sentences, summary, gap);
}

void append_leading_output(std::vector<std::string>& sentences, const Summary& summary,
                           const SweepAxis& axis) {
  const auto* outputs = value_in<Table>(summary, quantities::outputs.name);
  const std::string leading = text_in(summary, quantities::leading_output);
  for (std::size_t i = 0; outputs != nullptr && i < outputs->rows(); ++i) {
    if (cell_text(outputs->at(i, "output")) != leading) continue;
    append_output(sentences, *outputs, i, axis);
    append_digits(sentences, *outputs, i,
                  text_in(summary, quantities::solved_by) == name_of(TimeMethod::exact));
  }
}

void append_curve(std::vector<std::string>& sentences, const Summary& summary, double gap,
                  const SweepAxis& axis) {
  const double highest = number_in(summary, quantities::max_displacement),
               vibration = number_in(summary, quantities::vibration);
  const double value_resolution = number_in(summary, quantities::peak_value_resolution),
               place_resolution = number_in(summary, quantities::peak_place_resolution);
  const std::string unit = length_unit(summary);
  append_leading_output(sentences, summary, axis);
  sentences.push_back(fmt::format("The curve has {}.", count_of(summary, quantities::points, "point")));
  if (std::isfinite(vibration))
    sentences.back() += fmt::format(
        " The largest vibration of a contact is {}.",
        peak_text(vibration, unit, value_resolution,
                  number_in(summary, quantities::in_unit(quantities::vibration_places, axis.unit)),
                  place_resolution, axis));
  // Without a gap the vibration is enough, and a rigid obstacle holds the displacement at its gap.
  constexpr double rounding = 1e-9;
  if (!std::isfinite(highest) || !std::isfinite(gap) ||
      std::abs(highest - gap) <= rounding * std::max(std::abs(gap), vibration))
    return;
  sentences.push_back(
      fmt::format("The largest displacement is {}, {}{}.", rounded_quantity(highest, unit, value_resolution),
                  place_text(number_in(summary, quantities::in_unit(quantities::peak_places, axis.unit)),
                             place_resolution, axis),
                  beside_gap(highest, gap, unit)));
}

void append_damped_mode(std::vector<std::string>& sentences, const Summary& summary) {
  const double most = number_in(summary, quantities::largest_damping_ratio);
  if (std::isfinite(most)) {
    sentences.push_back(fmt::format(
        "Mode {:.0f} was followed over {}. Below an amplitude of {} no contact slips, opens or closes, and "
        "the frequency is {}.",
        number_in(summary, quantities::mode), count_of(summary, quantities::points, "point"),
        quantity(number_in(summary, quantities::slip_amplitude), length_unit(summary)),
        with_unit(summary, quantities::linear_frequency)));
    sentences.push_back(fmt::format(
        "The frequency is {} to {} times this value. The damping ratio is at most {}.",
        short_number(number_in(summary, quantities::least_frequency_ratio)),
        short_number(number_in(summary, quantities::largest_frequency_ratio)), short_number(most)));
  } else if (const double ratio = number_in(summary, quantities::damping_ratio); std::isfinite(ratio)) {
    sentences.push_back(
        fmt::format("The free motion of mode {:.0f} has the frequency {} and the damping ratio {}.",
                    number_in(summary, quantities::mode), with_unit(summary, quantities::frequency),
                    short_number(ratio)));
  }
}

/// The energy that ratios refer to: that at which the linear mode reaches a gap, or a reference length.
std::string reference_energy(const Summary& summary) {
  const bool gap = std::isfinite(number_in(summary, quantities::max_penetration_over_gap));
  return gap ? "grazing energy of the linear mode" : "energy of the linear mode at reference_length";
}

/// A single motion of a mode.
void append_mode_at_energy(std::vector<std::string>& sentences, const Summary& summary) {
  const double energy = number_in(summary, quantities::energy_ratio),
               ratio = number_in(summary, quantities::frequency_ratio);
  if (!std::isfinite(energy) || !std::isfinite(ratio)) return;
  sentences.push_back(
      fmt::format("At {} times the {}, mode {:.0f} has the frequency {}, {} times the linear one.",
                  short_number(energy), reference_energy(summary), number_in(summary, quantities::mode),
                  with_unit(summary, quantities::frequency), short_number(ratio)));
}

void append_mode(std::vector<std::string>& sentences, const Summary& summary) {
  append_damped_mode(sentences, summary);
  const double ratio = number_in(summary, quantities::largest_energy_ratio);
  if (!std::isfinite(ratio)) return append_mode_at_energy(sentences, summary);
  sentences.push_back(fmt::format(
      "Mode {:.0f} was followed over {}, up to {} times the {}.", number_in(summary, quantities::mode),
      count_of(summary, quantities::points, "point"), short_number(ratio), reference_energy(summary)));
  sentences.push_back(fmt::format("The frequency rises to {} times the linear one of {}.",
                                  short_number(number_in(summary, quantities::largest_frequency_ratio)),
                                  with_unit(summary, quantities::linear_frequency)));
  if (number_in(summary, quantities::points_tongue) > 0.0)
    sentences.emplace_back(
        "Points with the status tongue are on an internal resonance, where a second mode responds.");
  if (std::isfinite(number_in(summary, quantities::virial_residual)))
    sentences.push_back(fmt::format(
        "The virial residual, the relative error of an energy identity of exact motions, is at most {}.",
        short_number(number_in(summary, quantities::virial_residual), 2)));
}

bool is_curve(const Summary& summary) {
  const std::string analysis = text_in(summary, quantities::analysis);
  return analysis == "frequency_sweep" || analysis == "amplitude_sweep";
}

/// Then what was found of them is a finding, else a limit.
bool others_were_sought(const Summary& summary) {
  return text_in(summary, quantities::other_motions) == "sought";
}

bool is_solved(const Summary& summary) {
  const bool* converged = value_in<bool>(summary, quantities::converged.name);
  return converged != nullptr && *converged;
}

}  // namespace

std::vector<std::string> output_sentences(const Summary& summary, const SweepAxis& axis) {
  constexpr std::size_t most = 12;
  const auto* outputs = value_in<Table>(summary, quantities::outputs.name);
  const std::string leading = text_in(summary, quantities::leading_output);
  std::vector<std::string> sentences;
  for (std::size_t i = 0; outputs != nullptr && i < std::min(most, outputs->rows()); ++i)
    if (cell_text(outputs->at(i, "output")) != leading) append_output(sentences, *outputs, i, axis);
  return sentences;
}

std::vector<std::string> finding_sentences(const Summary& summary, double gap, const SweepAxis& axis) {
  std::vector<std::string> sentences;
  if (!is_solved(summary)) sentences.push_back(solution_sentence(summary));
  const std::string analysis = text_in(summary, quantities::analysis);
  const bool curve = is_curve(summary);
  if (!curve) append_leading_output(sentences, summary, axis);
  if (curve)
    append_curve(sentences, summary, gap, axis);
  else if (analysis == "nonlinear_mode")
    append_mode(sentences, summary);
  else if (analysis == "motions")
    append_motions(sentences, summary, gap);
  else
    append_motion(sentences, summary, gap);
  append_contact(sentences, summary, curve ? "up to " : "");
  if (others_were_sought(summary)) sentences.push_back(other_motions_sentence(summary, curve));
  return sentences;
}

std::vector<std::string> accuracy_sentences(const Summary& summary) {
  std::vector<std::string> sentences;
  if (is_solved(summary)) sentences.push_back(solution_sentence(summary));
  append_exact(sentences, summary, is_curve(summary));
  if (const std::string others = other_motions_sentence(summary, is_curve(summary));
      !others.empty() && !others_were_sought(summary))
    sentences.push_back(others);
  return sentences;
}

std::vector<std::string> outcome_sentences(const Summary& summary, double gap, const SweepAxis& axis) {
  std::vector<std::string> sentences = accuracy_sentences(summary);
  const std::vector<std::string> found = finding_sentences(summary, gap, axis);
  sentences.insert(sentences.begin() + (is_solved(summary) ? 1 : 0), found.begin(), found.end());
  return sentences;
}

}  // namespace wavebalance::app

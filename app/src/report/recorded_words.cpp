#include "report/recorded_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plot/unit_prefix.hpp"
#include "results/quantities.hpp"

namespace wavebalance::app {
namespace {

/// "1.234 mm ± 0.012 mm".
std::string with_error(const Summary& summary, const Quantity& value, const Quantity& error) {
  const std::string unit(value.unit);
  return quantity(number_in(summary, value), unit) + " ± " + quantity(number_in(summary, error), unit);
}

std::string kind_sentence(const Summary& summary) {
  const std::string kind = text_in(summary, quantities::motion_kind);
  const double exponent = number_in(summary, quantities::lyapunov_exponent),
               error = number_in(summary, quantities::lyapunov_exponent_error);
  const std::string before = fmt::format("Within {:.0f} periods of the load the motion did not repeat. ",
                                         number_in(summary, quantities::transient_periods));
  const std::string measured =
      std::isfinite(exponent)
          ? fmt::format("the largest Lyapunov exponent is {:.3g} ± {:.2g} per period of the load", exponent,
                        error)
          : std::string("the largest Lyapunov exponent was not found");
  if (kind == "chaotic") return before + "It is chaotic: " + measured + ".";
  if (kind == "quasi_periodic")
    return before + "It is quasi-periodic: it keeps its size, and " + measured +
           ", which is zero within what " + "so many periods tell.";
  if (kind == "periodic")
    return before +
           fmt::format("It repeats after {:.0f} of them.", number_in(summary, quantities::section_period));
  if (kind == "settling")
    return before + "It still settles, or has a long period, since perturbations decay: " + measured + ".";
  return before + "Whether it is aperiodic or has not settled yet is not known: " + measured + ".";
}

void append_forces(std::vector<std::string>& sentences, const Summary& summary) {
  if (std::isfinite(number_in(summary, quantities::mean_contact_force)))
    sentences.push_back(fmt::format(
        "Its contact force has a mean of {}{}.",
        with_error(summary, quantities::mean_contact_force, quantities::mean_contact_force_error),
        std::isfinite(number_in(summary, quantities::max_contact_force))
            ? " and a largest value of " + quantity(number_in(summary, quantities::max_contact_force), "N")
            : ""));
  if (std::isfinite(number_in(summary, quantities::impacts)))
    sentences.push_back(fmt::format(
        "There are {:.4g} ± {:.2g} impacts in a period of the load, at up to {}, and they dissipate {}.",
        number_in(summary, quantities::impacts), number_in(summary, quantities::impacts_error),
        quantity(number_in(summary, quantities::max_impact_velocity), "m/s"),
        with_error(summary, quantities::impact_energy, quantities::impact_energy_error)));
  if (std::isfinite(number_in(summary, quantities::friction_work)))
    sentences.push_back(
        fmt::format("Friction dissipates {} in a period of the load.",
                    with_error(summary, quantities::friction_work, quantities::friction_work_error)));
  if (std::isfinite(number_in(summary, quantities::wear)))
    sentences.push_back(fmt::format("It wears off {:.4g} ± {:.2g} m^3 in a period of the load.",
                                    number_in(summary, quantities::wear),
                                    number_in(summary, quantities::wear_error)));
}

/// "12 to 19.5 N", or one value.
std::string interval_text(const Table& table, std::size_t row, const SweepAxis& axis) {
  const double from = table.numbers("from")[row], to = table.numbers("to")[row];
  return from == to ? fmt::format("at {:.6g} {}", from, axis.unit)
                    : fmt::format("from {:.6g} to {:.6g} {}", from, to, axis.unit);
}

std::string period_words(double period) {
  if (std::isnan(period)) return "no section";
  if (period == 0.0) return "none";
  return fmt::format("{:.0f}", period);
}

std::string way_sentence(const Table& intervals, const std::string& way, const SweepAxis& axis) {
  constexpr std::size_t most = 12;
  std::vector<std::string> parts;
  const std::vector<double> periods = intervals.numbers("period");
  std::size_t all = 0;
  for (std::size_t i = 0; i < intervals.rows(); ++i) {
    if (cell_text(intervals.at(i, "way")) != way || ++all > most) continue;
    parts.push_back(interval_text(intervals, i, axis) + " " + period_words(periods[i]));
  }
  if (parts.empty()) return "";
  return fmt::format("On the way {} the motion repeats after these periods of the load: {}{}.", way,
                     fmt::join(parts, "; "), all > most ? fmt::format("; and {} more", all - most) : "");
}

std::string hysteresis_sentence(const Summary& summary, const SweepAxis& axis) {
  const auto* table = value_in<Table>(summary, quantities::hysteresis.name);
  const auto* intervals = value_in<Table>(summary, quantities::period_intervals.name);
  if (table == nullptr || intervals == nullptr) return "";
  const std::vector<std::string> ways = intervals->texts("way");
  if (std::find(ways.begin(), ways.end(), "back") == ways.end())
    return "The values were passed one way alone.";
  if (table->empty()) return "Both ways lead to the same motions.";
  constexpr std::size_t most = 6;
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min(most, table->rows()); ++i)
    parts.push_back(interval_text(*table, i, axis));
  return fmt::format("Both ways lead to different motions {}{}.", fmt::join(parts, "; "),
                     table->rows() > most ? "; and elsewhere" : "");
}

std::string exact_sentence(const Summary& summary) {
  const std::string status = text_in(summary, quantities::exact_curve);
  if (status == "reached_end" || status == "closed")
    return "Lines are exact periodic solutions, dashed where they are unstable.";
  if (status == "not_sought" || status.empty()) return "";
  if (status == "refused") return "There is no exact curve of this scene.";
  return "The exact curve is not complete (" + status + ").";
}

}  // namespace

std::vector<std::string> recorded_sentences(const Summary& summary) {
  if (text_in(summary, quantities::motion_kind).empty()) return {};
  std::vector<std::string> sentences{kind_sentence(summary)};
  sentences.push_back(fmt::format(
      "Over the next {:.0f} periods the leading contact has a vibration of {} (rms about its mean), and lies "
      "between {} and {}.",
      number_in(summary, quantities::recorded_periods),
      with_error(summary, quantities::rms_vibration, quantities::rms_vibration_error),
      quantity(number_in(summary, quantities::min_displacement), "m"),
      quantity(number_in(summary, quantities::max_displacement), "m")));
  append_forces(sentences, summary);
  sentences.emplace_back("Errors are halves of 95 % confidence intervals, by the means of 20 batches.");
  return sentences;
}

std::vector<std::string> diagram_sentences(const Summary& summary, const SweepAxis& axis) {
  const auto* intervals = value_in<Table>(summary, quantities::period_intervals.name);
  if (intervals == nullptr) return {};
  std::vector<std::string> sentences{
      fmt::format("The section of {} was recorded at {:.0f} values of the {}, in {}.",
                  text_in(summary, quantities::section_of), number_in(summary, quantities::diagram_values),
                  axis.quantity, quantity(number_in(summary, quantities::wall_seconds), "s"))};
  for (const char* way : {"there", "back"})
    if (std::string one = way_sentence(*intervals, way, axis); !one.empty())
      sentences.push_back(std::move(one));
  for (std::string one : {hysteresis_sentence(summary, axis), exact_sentence(summary)})
    if (!one.empty()) sentences.push_back(std::move(one));
  return sentences;
}

}  // namespace wavebalance::app

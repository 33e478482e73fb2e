#include "report/recorded_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "files/number_text.hpp"
#include "plot/unit_prefix.hpp"
#include "report/run_words.hpp"
#include "results/quantities.hpp"

namespace wavebalance::app {
namespace {

/// "1.680 ± 0.004 mm": the error with two digits, and the value with as many decimals.
std::string with_error(const Summary& summary, const Quantity& of, const Quantity& error_of) {
  const double value = number_in(summary, of), error = number_in(summary, error_of);
  const Scale scale = axis_scale(std::abs(value));
  const double shown = scale.factor * error;
  const int decimals = shown > 0.0 ? std::clamp(1 - int(std::floor(std::log10(shown))), 0, 6) : 6;
  return fmt::format("{:.{}f} ± {:.{}f} {}{}", scale.factor * value, decimals, shown, decimals, scale.prefix,
                     of.unit);
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
    return before + fmt::format("In the record it repeats after {:.0f} of them.",
                                number_in(summary, quantities::section_period));
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

/// "12 to 19.5", or one value.
std::string interval_text(const Table& table, std::size_t row) {
  const double from = table.numbers("from")[row], to = table.numbers("to")[row];
  return from == to ? fmt::format("{:.6g}", from) : fmt::format("{:.6g} to {:.6g}", from, to);
}

/// "12 to 19.5, 22 and 4 more" of the rows.
std::string list_text(const Table& table, const std::vector<std::size_t>& rows) {
  constexpr std::size_t most = 4;
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < std::min(most, rows.size()); ++i)
    parts.push_back(interval_text(table, rows[i]));
  return fmt::format("{}", fmt::join(parts, ", ")) +
         (rows.size() > most ? fmt::format(" and {} more", rows.size() - most) : "");
}

/// Where motions of few periods are on a way, where others, and where none.
std::string way_sentence(const Table& intervals, const std::string& way, const SweepAxis& axis) {
  constexpr std::array words{"period 1 at ",      "period 2 at ",  "period 4 at ",
                             "other periods at ", "aperiodic at ", "not known at "};
  std::array<std::vector<std::size_t>, words.size()> rows;
  const std::vector<double> periods = intervals.numbers("period");
  for (std::size_t i = 0; i < intervals.rows(); ++i) {
    if (cell_text(intervals.at(i, "way")) != way) continue;
    const double period = periods[i];
    const std::size_t kind = std::isnan(period) ? 5
                             : period == 0.0    ? 4
                             : period == 1.0    ? 0
                             : period == 2.0    ? 1
                             : period == 4.0    ? 2
                                                : 3;
    rows[kind].push_back(i);
  }
  std::vector<std::string> parts;
  for (std::size_t kind = 0; kind < words.size(); ++kind)
    if (!rows[kind].empty()) parts.push_back(words[kind] + list_text(intervals, rows[kind]));
  if (parts.empty()) return "";
  return fmt::format("On the way {} ({}): {}.", way, axis.unit, fmt::join(parts, "; "));
}

std::string hysteresis_sentence(const Summary& summary, const SweepAxis& axis) {
  const auto* table = value_in<Table>(summary, quantities::hysteresis.name);
  const auto* intervals = value_in<Table>(summary, quantities::period_intervals.name);
  if (table == nullptr || intervals == nullptr) return "";
  const std::vector<std::string> ways = intervals->texts("way");
  if (std::find(ways.begin(), ways.end(), "back") == ways.end())
    return "The values were passed one way alone.";
  if (table->empty()) return "Both ways lead to the same motions.";
  std::vector<std::size_t> rows(table->rows());
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return fmt::format("Both ways lead to different motions at {} {}.", list_text(*table, rows), axis.unit);
}

std::string exact_sentence(const Summary& summary) {
  const std::string status = text_in(summary, quantities::exact_curve);
  if (status == "reached_end" || status == "closed")
    return "Lines are exact periodic solutions, dashed where they are unstable.";
  if (status == "not_sought" || status.empty()) return "";
  if (status == "refused") return "There is no exact curve of this scene.";
  const std::string back = text_in(summary, quantities::exact_curve_back);
  return "Lines are exact periodic solutions, dashed where they are unstable, from one end of the interval (" +
         spaced_words(status) + ")" +
         (back.empty() ? "." : " and from the other (" + spaced_words(back) + "). Others may be missing.");
}

}  // namespace

std::vector<std::string> recorded_sentences(const Summary& summary) {
  if (text_in(summary, quantities::motion_kind).empty()) return {};
  std::vector<std::string> sentences{kind_sentence(summary)};
  const std::string rotation = text_in(summary, quantities::displacement_unit),
                    unit = rotation.empty() ? "m" : rotation;
  sentences.push_back(fmt::format(
      "Over the next {:.0f} periods the leading contact has a vibration of {} (rms about its mean), and lies "
      "between {} and {}.",
      number_in(summary, quantities::recorded_periods),
      with_error(summary, quantities::rms_vibration, quantities::rms_vibration_error),
      quantity(number_in(summary, quantities::min_displacement), unit),
      quantity(number_in(summary, quantities::max_displacement), unit)));
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

#include "report/words.hpp"

#include <fmt/format.h>

#include "files/missing.hpp"
#include "files/number_text.hpp"
#include "results/quantities.hpp"
#include "wavebalance/app/files/quantity_text.hpp"

namespace wavebalance::app {
namespace {

/// So many digits of a number as the points of a curve determine: at least two, at most `most`.
int digits_of(double value, double resolution, int most) {
  if (!(resolution > 0.0)) return most;
  return std::clamp(static_cast<int>(std::ceil(std::log10(std::abs(value) / resolution))), 2, most);
}

/// "The vibration of row 19", "The velocity of row 3".
std::string named_output(const std::string& name) {
  return (name.find(" of ") == std::string::npos ? "The vibration of " : "The ") + name;
}

/// Along a nonlinear mode: where contacts begin to act, at the largest damping, and at most.
void append_output_of_mode(std::vector<std::string>& sentences, const Table& outputs, std::size_t row) {
  const auto number = [&](std::string_view column) { return std::get<double>(outputs.at(row, column)); };
  const std::string unit = cell_text(outputs.at(row, "unit"));
  std::string places;
  if (const double onset = number("at_onset"); std::isfinite(onset))
    places += fmt::format("{} where contacts begin to act, ", quantity(onset, unit));
  if (outputs.has_column("at_largest_damping") && std::isfinite(number("at_largest_damping")))
    places +=
        fmt::format("{} where the damping ratio is largest, ", quantity(number("at_largest_damping"), unit));
  sentences.push_back(fmt::format("{} (half peak to peak) is {}{}at most {}, at {}.",
                                  named_output(cell_text(outputs.at(row, "output"))), places,
                                  places.empty() ? "" : "and ", quantity(number("half_peak_to_peak"), unit),
                                  quantity(number("at_frequency_Hz"), "Hz")));
}

}  // namespace

std::string rounded_quantity(double value, const std::string& unit, double resolution) {
  constexpr int most = 4;
  return quantity(rounded(value, digits_of(1.0, resolution, most)), unit);
}

std::string place_text(double place, double resolution, const SweepAxis& axis) {
  constexpr int most = 5;
  const double at = rounded(place, digits_of(place, resolution, most));
  return (axis.quantity == "frequency" ? "at " : "at an amplitude of ") + quantity(at, axis.unit, most);
}

std::string peak_text(double vibration, const std::string& unit, double resolution, double place,
                      double place_resolution, const SweepAxis& axis) {
  return rounded_quantity(vibration, unit, resolution) + " (half peak to peak), " +
         place_text(place, place_resolution, axis);
}

void append_output(std::vector<std::string>& sentences, const Table& outputs, std::size_t row,
                   const SweepAxis& axis) {
  const auto number = [&](std::string_view column) { return std::get<double>(outputs.at(row, column)); };
  const double vibration = number("half_peak_to_peak"), mean = number("mean");
  if (!std::isfinite(vibration)) return;
  if (outputs.has_column("at_onset")) return append_output_of_mode(sentences, outputs, row);
  const std::string unit = cell_text(outputs.at(row, "unit")), name = cell_text(outputs.at(row, "output"));
  const bool curve = outputs.has_column(axis.column()), solved = curve && outputs.has_column("digits");
  double resolution = curve ? number(quantities::peak_value_resolution.name) : missing;
  if (solved) resolution = std::fmax(resolution, number("error_at_peak"));
  const std::string size = curve
                               ? "at most " + peak_text(vibration, unit, resolution, number(axis.column()),
                                                        number(quantities::peak_place_resolution.name), axis)
                               : quantity(vibration, unit) + " (half peak to peak)";
  constexpr double rounding = 1e-7;  // of what a balance and its peak resolve
  sentences.push_back(fmt::format("{} is {}, about a mean of {}.", named_output(name),
                                  vibration <= rounding * std::abs(mean) ? "zero" : size,
                                  std::abs(mean) <= rounding * vibration ? "zero" : quantity(mean, unit)));
}

void append_digits(std::vector<std::string>& sentences, const Table& outputs, std::size_t row,
                   bool exact_curve) {
  if (!outputs.has_column("digits")) return;
  const double digits = std::get<double>(outputs.at(row, "digits"));
  if (!std::isfinite(digits)) return;
  const bool compared = std::isfinite(std::get<double>(outputs.at(row, "error_at_peak")));
  const std::string count = fmt::format("{:.0f} digit{}", digits, digits == 1.0 ? "" : "s");
  const std::string verb = digits == 1.0 ? "is" : "are";
  std::string words =
      fmt::format("The curve determines {} of it, which {} not compared with an exact periodic solution.",
                  count, digits == 1.0 ? "was" : "were");
  if (exact_curve) words = fmt::format("It is resolved to {}.", count);
  if (compared)
    words = fmt::format("It has {} that {} confirmed by the nearest exact periodic solution.", count, verb);
  sentences.push_back("The peak was solved for between the points of the curve. " + words);
}

}  // namespace wavebalance::app

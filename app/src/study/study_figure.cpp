#include <fmt/format.h>

#include <set>

#include "files/contains.hpp"
#include "files/missing.hpp"
#include "files/number_text.hpp"
#include "plot/plot_parts.hpp"
#include "results/quantities.hpp"
#include "study/quantile.hpp"
#include "wavebalance/app/files/quantity_text.hpp"
#include "wavebalance/app/scene/output_words.hpp"
#include "wavebalance/app/scene/scene_keys.hpp"
#include "wavebalance/app/study/study.hpp"

namespace wavebalance::app {
namespace {

constexpr std::size_t most_curves = 8, most_scatters = 5;

/// A column as pictures show it: "max_displacement_m" as "max displacement (mm)", whatever its size.
struct Shown {
  std::string label;
  double factor = 1.0;
};

/// "row_19_half_peak_to_peak_m" as "row 19 half peak to peak (µm)", by the largest of its values.
Shown output_shown(const std::string& column, const OutputUnit& unit, double largest) {
  std::string words = spaced_words(column.substr(0, column.size() - unit.suffix.size() - 1));
  if (words.starts_with("minus ")) words.replace(0, 6, "-");
  const std::string name(unit.name);
  const Scale scale = axis_scale(largest, name);
  return {fmt::format("{} ({}{})", capitalised(words), scale.prefix, name == "um" ? "µm" : name),
          scale.factor};
}

Shown shown_as(const std::string& column, double largest) {
  const Quantity* known = quantities::find_in_words(column);
  const OutputUnit* unit = known == nullptr && column.find("_half_peak_to_peak_") != std::string::npos
                               ? unit_at_end(column)
                               : nullptr;
  if (unit != nullptr) return output_shown(column, *unit, largest);
  if (known == nullptr) return {plain(column), 1.0};
  constexpr double usual_length = 1e-3;  // m
  const Scale scale = known->unit == "m" ? axis_scale(usual_length) : Scale();
  return {fmt::format("{} ({}{})", known->words, scale.prefix, known->unit), scale.factor};
}

double number_of(const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) return *number;
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return static_cast<double>(*count);
  return missing;
}

/// The quantity in rows that converged, NaN in others.
std::vector<double> drawn_values(const Table& table, const std::string& quantity) {
  std::vector<double> values;
  for (std::size_t i = 0; i < table.rows(); ++i)
    values.push_back(std::get<bool>(table.at(i, "converged")) ? number_of(table.at(i, quantity)) : missing);
  return values;
}

/// How it is shown, in whose unit the values are then.
Shown take_to_shown(const std::string& quantity, std::vector<double>& values) {
  double largest = 0.0;
  for (const double value : values) largest = std::fmax(largest, std::abs(value));
  Shown shown = shown_as(quantity, largest);
  for (double& value : values) value *= shown.factor;
  return shown;
}

/// Text of a picture for each run in addition to its value.
enum class Outcome { solved, unstable, not_converged };

std::vector<Outcome> outcomes_of(const Table& table) {
  const std::string unstable = quantities::unstable_multipliers.column();
  std::vector<Outcome> outcomes;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const bool moves = table.has_column(unstable) && number_of(table.at(i, unstable)) > 0.0;
    outcomes.push_back(!std::get<bool>(table.at(i, "converged")) ? Outcome::not_converged
                       : moves                                   ? Outcome::unstable
                                                                 : Outcome::solved);
  }
  return outcomes;
}

/// Marks of the runs of one outcome; none where there are none.
void add_marks(Panel& panel, const std::vector<double>& x, const std::vector<double>& y,
               const std::vector<Outcome>& outcomes, Outcome outcome) {
  Series series(outcome == Outcome::unstable ? "unstable" : "did not converge", SeriesStyle::points);
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    if (outcomes[i] == outcome && std::isfinite(x[i]) && std::isfinite(y[i])) series.append(x[i], y[i]);
  if (series.x.empty()) return;
  series.colour = outcome == Outcome::unstable ? Colour::vermillion : Colour::grey;
  series.marker = outcome == Outcome::unstable ? 2 : 4;
  panel.add(std::move(series));
}

/// A parameter that varies, in the unit of its label: its numbers in all rows, and its distinct ones in
/// order.
struct Varying {
  std::string key;
  bool numeric = true;
  bool logarithmic = false;
  std::vector<double> numbers;
  std::vector<double> distinct;
  std::string label = {};
};

/// Takes a parameter's values to a readable multiple of its unit, and labels it.
void set_unit(Varying& one) {
  const SceneKey* known = find_scene_key(one.key);
  const std::string unit(known == nullptr ? "" : known->unit);
  const bool scales = one.numeric && (unit == "m" || unit == "N");
  const double largest = std::fmax(std::abs(one.distinct.front()), std::abs(one.distinct.back()));
  const Scale scale = scales ? axis_scale(largest) : Scale();
  for (auto* values : {&one.numbers, &one.distinct})
    for (double& value : *values) value *= scale.factor;
  one.label = plain(one.key) + (unit.empty() ? "" : fmt::format(" ({}{})", scale.prefix, unit));
}

std::vector<Varying> varying_parameters(const Study& study, const Table& table) {
  std::vector<Varying> found;
  for (const StudyParameter& parameter : study.parameters) {
    Varying one{parameter.key, true, parameter.logarithmic, {}, {}};
    std::set<std::string> texts;
    for (std::size_t i = 0; i < table.rows(); ++i) {
      const Cell& cell = table.at(i, parameter.key);
      one.numbers.push_back(number_of(cell));
      one.numeric = one.numeric && std::isfinite(one.numbers.back());
      texts.insert(cell_text(cell));
    }
    if (texts.size() < 2) continue;
    one.distinct = one.numbers;
    std::ranges::sort(one.distinct);
    one.distinct.erase(std::unique(one.distinct.begin(), one.distinct.end()), one.distinct.end());
    set_unit(one);
    found.push_back(std::move(one));
  }
  return found;
}

bool is_uniform(const std::vector<double>& values) {
  if (values.size() < 2) return false;
  const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
  constexpr double tolerance = 1e-6;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (std::abs(values[i] - values[i - 1] - step) > tolerance * std::abs(step)) return false;
  return true;
}

std::vector<double> in_decades(std::vector<double> values) {
  for (double& one : values) one = std::log10(one);
  return values;
}

/// Where a map has the values of a parameter: at their decadic logarithms where only those are uniform.
std::vector<double> places_in_map(const Varying& one, const std::vector<double>& values) {
  return is_uniform(one.distinct) ? values : in_decades(values);
}

/// Half a step beyond its first and last value.
Axis axis_of_map(const Varying& one) {
  const std::vector<double> places = places_in_map(one, one.distinct);
  const double half = 0.5 * (places[1] - places[0]);
  Axis result;
  result.label = one.label;
  result.lower = places.front() - half;
  result.upper = places.back() + half;
  if (is_uniform(one.distinct)) {
    result.ticks = few_ticks(*result.lower, *result.upper);
    return result;
  }
  for (const double value : logarithmic_ticks(std::pow(10.0, *result.lower), std::pow(10.0, *result.upper))) {
    result.ticks.push_back(std::log10(value));
    result.tick_texts.push_back(tick_text(value));
  }
  return result;
}

bool draws_map(const Study& study, const std::vector<Varying>& varying) {
  return study.sampling == Sampling::grid && varying.size() == 2 &&
         std::ranges::all_of(varying, [](const Varying& one) {
           return one.numeric && (is_uniform(one.distinct) ||
                                  (one.distinct.front() > 0.0 && is_uniform(in_decades(one.distinct))));
         });
}

std::size_t place_in(const std::vector<double>& ordered, double value) {
  return static_cast<std::size_t>(std::lower_bound(ordered.begin(), ordered.end(), value) - ordered.begin());
}

void add_map(Figure& figure, const Table& table, const std::vector<Varying>& varying,
             const std::vector<double>& values, const std::vector<Outcome>& outcomes, const Shown& shown) {
  const Varying &x = varying[0], &y = varying[1];
  HeatMap map;
  map.x = places_in_map(x, x.distinct);
  map.y = places_in_map(y, y.distinct);
  map.values.assign(map.x.size() * map.y.size(), missing);
  map.label = shown.label;
  map.told_heads = {"run", x.label, y.label, map.label};
  map.told_rows.resize(map.values.size());
  double least = std::numeric_limits<double>::infinity(), largest = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t place =
        place_in(y.distinct, y.numbers[i]) * map.x.size() + place_in(x.distinct, x.numbers[i]);
    map.values[place] = values[i];
    map.told_rows[place] = {number_of(table.at(i, "run")), x.numbers[i], y.numbers[i], values[i]};
    least = std::fmin(least, values[i]);
    largest = std::fmax(largest, std::abs(values[i]));
  }
  if (!(largest > 0.0)) return;
  map.largest = largest;
  map.from_zero = least >= 0.0;
  // Close values use all colours; white is for missing values.
  constexpr double near = 0.5, pale = 0.15;
  if (least > near * largest) map.least = least - pale * (largest - least);
  Panel& panel = figure.add_panel();
  panel.x = axis_of_map(x);
  panel.y = axis_of_map(y);
  panel.heat_map = std::move(map);
  for (const Outcome outcome : {Outcome::unstable, Outcome::not_converged})
    add_marks(panel, places_in_map(x, x.numbers), places_in_map(y, y.numbers), outcomes, outcome);
}

/// Over one parameter, what the other ones make of each of its values.
void add_quantile_curves(Panel& panel, const Varying& x, const std::vector<double>& values) {
  std::map<double, std::vector<double>> columns;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i])) columns[x.numbers[i]].push_back(values[i]);
  for (auto& [at, column] : columns) std::ranges::sort(column);
  for (const double share : {0.05, 0.5, 0.95}) {
    Series series(percentage(share) + " of the runs are below", SeriesStyle::line);
    for (const auto& [at, column] : columns) series.append(at, quantile_of(column, share));
    panel.add(std::move(series));
  }
}

/// All parameters of a row except the abscissa.
std::string others_text(const Study& study, const Table& table, std::size_t row, const std::string& abscissa,
                        const std::set<std::string>& shown) {
  std::string text;
  for (const StudyParameter& one : study.parameters)
    if (one.key != abscissa && shown.contains(one.key))
      text += (text.empty() ? "" : ", ") + one.key + " = " + cell_text(table.at(row, one.key));
  return text;
}

void add_curves(Figure& figure, const Study& study, const Table& table, const std::vector<Varying>& varying,
                const std::vector<double>& values, const std::vector<Outcome>& outcomes, const Shown& shown) {
  const auto most = [](const Varying& a, const Varying& b) {
    return (a.numeric ? a.distinct.size() : 0) < (b.numeric ? b.distinct.size() : 0);
  };
  const Varying& x = *std::ranges::max_element(varying, most);
  if (!x.numeric) return;
  Panel& panel = figure.add_panel("", x.label, shown.label);
  panel.x.logarithmic = x.logarithmic && x.distinct.front() > 0.0;
  panel.legend = varying.size() > 1;
  std::set<std::string> keys;
  for (const Varying& one : varying) keys.insert(one.key);
  std::map<std::string, std::map<double, double>> curves;
  for (std::size_t i = 0; i < values.size(); ++i)
    curves[others_text(study, table, i, x.key, keys)][x.numbers[i]] = values[i];
  if (curves.size() > most_curves) return add_quantile_curves(panel, x, values);
  for (const auto& [text, curve] : curves) {
    Series series(plain(text), SeriesStyle::line_points);
    for (const auto& [at, value] : curve) series.append(at, value);
    panel.add(std::move(series));
  }
  add_marks(panel, x.numbers, values, outcomes, Outcome::unstable);
  if (contains(outcomes, Outcome::unstable)) panel.legend = true;
}

void add_distribution(Figure& figure, std::vector<double> values, const Shown& shown) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  if (values.size() < 2) return;
  std::ranges::sort(values);
  std::vector<double> shares;
  for (std::size_t i = 0; i < values.size(); ++i)
    shares.push_back(100.0 * static_cast<double>(i + 1) / static_cast<double>(values.size()));
  Panel& panel = figure.add_panel("Distribution", shown.label, "Runs with at most this value (%)");
  panel.y.lower = 0.0;
  panel.add({"", values, shares, SeriesStyle::steps});
}

/// Limits a little beyond the values, so that no symbol is cut.
void set_limits(Axis& axis, double lowest, double highest) {
  constexpr double margin = 0.03;  // of the range
  if (axis.logarithmic) {
    const double factor = std::pow(highest / lowest, margin);
    axis.lower = lowest / factor;
    axis.upper = highest * factor;
    return;
  }
  axis.lower = lowest - margin * (highest - lowest);
  axis.upper = highest + margin * (highest - lowest);
  axis.ticks = few_ticks(*axis.lower, *axis.upper);
}

/// The values of the runs of one outcome, NaN in others; of those that did not converge their place below
/// all.
std::vector<double> values_of(const std::vector<double>& values, const std::vector<Outcome>& outcomes,
                              Outcome outcome) {
  double lowest = missing, highest = missing;
  for (const double value : values) lowest = std::fmin(lowest, value), highest = std::fmax(highest, value);
  constexpr double below = 0.06;
  std::vector<double> shown = values;
  for (std::size_t i = 0; i < shown.size(); ++i)
    if (outcomes[i] != outcome)
      shown[i] = missing;
    else if (outcome == Outcome::not_converged)
      shown[i] = lowest - below * (highest - lowest);
  return shown;
}

void add_scatters(Figure& figure, const std::vector<Varying>& varying, const std::vector<double>& values,
                  const std::vector<Outcome>& outcomes, const Shown& shown) {
  constexpr std::size_t most_points = 4000;
  const std::size_t step = values.size() / most_points + 1;
  std::size_t drawn = 0;
  const std::vector<double> solved = values_of(values, outcomes, Outcome::solved);
  for (const Varying& one : varying) {
    if (!one.numeric || drawn++ == most_scatters) continue;
    Series series = Series("", SeriesStyle::points).in(Colour::blue);
    for (std::size_t i = 0; i < values.size(); i += step) series.append(one.numbers[i], solved[i]);
    series.marker = 1;
    Panel& panel = figure.add_panel("Over " + plain(one.key), one.label, shown.label);
    panel.x.logarithmic = one.logarithmic && one.distinct.front() > 0.0;
    set_limits(panel.x, one.distinct.front(), one.distinct.back());
    panel.add(std::move(series));
    for (const Outcome outcome : {Outcome::unstable, Outcome::not_converged})
      add_marks(panel, one.numbers, values_of(values, outcomes, outcome), outcomes, outcome);
    double lowest = missing, highest = missing;
    for (const Series& marks : panel.series)
      for (const double value : marks.y)
        lowest = std::fmin(lowest, value), highest = std::fmax(highest, value);
    if (lowest < highest) set_limits(panel.y, lowest, highest);
  }
}

/// plot.log of the scene.
bool draws_logarithms(const Study& study, const StudyRuns& runs) {
  try {
    return scene_of_run(study, runs, 0).plot.log;
  } catch (const std::exception&) {
    return false;  // the first run was refused, too
  }
}

}  // namespace

Figure study_figure(const Study& study, const StudyRuns& runs, const Table& table,
                    const std::string& quantity) {
  Figure figure;
  figure.panel_width = 640;
  figure.panel_height = 420;
  if (quantity.empty()) return figure;
  std::vector<double> values = drawn_values(table, quantity);
  const Shown shown = take_to_shown(quantity, values);
  const std::vector<Varying> varying = varying_parameters(study, table);
  const std::vector<Outcome> outcomes = outcomes_of(table);
  if (varying.empty() || std::ranges::none_of(values, [](double value) { return std::isfinite(value); }))
    return figure;
  figure.title = fmt::format("{} runs", runs.size());
  const bool map = draws_map(study, varying);
  if (map) {
    add_map(figure, table, varying, values, outcomes, shown);
  } else if (study.sampling == Sampling::grid) {
    add_curves(figure, study, table, varying, values, outcomes, shown);
  } else {
    add_distribution(figure, values, shown);
    add_scatters(figure, varying, values, outcomes, shown);
    figure.columns = 2;  // of half the width, so that letters keep their size
    figure.panel_width = 480;
    figure.panel_height = 340;
  }
  if (!map && study.sampling == Sampling::grid && draws_logarithms(study, runs))
    take_logarithmic_ordinates(figure);
  return figure;
}

}  // namespace wavebalance::app

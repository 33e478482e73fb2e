#include "convergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/analysis/nyquist_resonances.hpp"

namespace wavebalance::jl14 {

std::vector<int> sizes() { return {8, 16, 32, 64, 128}; }

Convergence::Convergence(report::Artefact& artefact, std::string column, bool whole_structure,
                         const Measure& measure)
    : column_(std::move(column)), table_({"case", "trial", "weight", "functions", column_, "converged"}) {
  for (const int number : {1, 2}) {
    Case study(artefact, number);
    for (const Pair& pair : pairs())
      for (const int functions : sizes()) {
        const auto response = study.solve(pair, functions, whole_structure);
        const double value =
            response.converged ? measure(study, response) : std::numeric_limits<double>::quiet_NaN();
        table_.append_row({std::int64_t{number}, pair.trial, pair.weight, std::int64_t{functions}, value,
                           response.converged});
      }
  }
}

double Convergence::at(int case_number, const Pair& pair, int functions) const {
  const Table found = table_.where("case", std::to_string(case_number))
                          .where("trial", pair.trial)
                          .where("weight", pair.weight)
                          .where("functions", std::to_string(functions));
  return found.numbers(column_).at(0);
}

std::vector<double> Convergence::at(int case_number, const std::vector<Pair>& chosen, int functions) const {
  std::vector<double> values;
  for (const Pair& pair : chosen) values.push_back(at(case_number, pair, functions));
  return values;
}

std::vector<double> Convergence::of(int case_number, const std::string& pair_name) const {
  std::vector<double> values;
  for (const int functions : sizes()) values.push_back(at(case_number, pair(pair_name), functions));
  return values;
}

double Convergence::mean(int case_number, const std::vector<Pair>& chosen,
                         const std::vector<int>& functions) const {
  double sum = 0.0;
  for (const int number : functions)
    for (const double value : at(case_number, chosen, number)) sum += value;
  return sum / static_cast<double>(chosen.size() * functions.size());
}

double Convergence::largest(int case_number, const std::vector<Pair>& chosen, int functions) const {
  const auto values = at(case_number, chosen, functions);
  return *std::max_element(values.begin(), values.end());
}

double Convergence::order(int case_number, const std::string& pair_name, int smallest) const {
  std::vector<double> numbers, values;
  for (const int functions : sizes()) {
    if (functions < smallest) continue;
    numbers.push_back(functions);
    values.push_back(at(case_number, pair(pair_name), functions));
  }
  return app::observed_order(numbers, values);
}

std::string Convergence::text(int case_number, const std::string& pair_name) const {
  std::string text;
  for (const int functions : sizes())
    text += (text.empty() ? "" : ", ") + std::to_string(functions) + ": " +
            report::percent(at(case_number, pair(pair_name), functions));
  return text;
}

Convergence Convergence::mapped(const std::function<double(double)>& change) const {
  Convergence result = *this;
  result.table_ = Table(table_.columns());
  for (std::size_t i = 0; i < table_.rows(); ++i) {
    auto row = table_.row(i);
    row[4] = change(std::get<double>(row[4]));
    result.table_.append_row(std::move(row));
  }
  return result;
}

using app::Legend;

app::Figure Convergence::figure(const std::string& label, bool logarithmic) const {
  app::Figure figure;
  figure.columns = 2;
  figure.panel_width = 560;
  figure.panel_height = 400;
  for (const int number : {1, 2}) {
    app::Panel& panel = figure.add_panel(number == 1 ? "150 Hz" : "1275 Hz");
    const Table of_case = table_.where("case", std::to_string(number));
    for (const Pair& pair : pairs()) {
      const Table rows = of_case.where("trial", pair.trial).where("weight", pair.weight);
      Series series(pair.label, rows, "functions", column_, app::SeriesStyle::line_points);
      series.colour = pair.colour;
      series.marker = pair.marker;
      panel.add(std::move(series));
    }
    panel.x = axis("Number of basis functions", 7.0, 147.0);
    panel.x.logarithmic = true;
    panel.x.ticks = {8, 16, 32, 64, 128};
    panel.x.tick_format = "%g";
    panel.y.label = label;
    panel.y.logarithmic = logarithmic;
    panel.legend = number == 1 ? Legend::none : logarithmic ? Legend::bottom_left : Legend::top_right;
  }
  return figure;
}

void note_nyquist_resonances(report::Artefact& artefact) {
  for (const int number : {1, 2}) {
    Case study(artefact, number);
    const double forcing = study.scene().forcing.frequency;
    double nearest = std::numeric_limits<double>::infinity();
    std::string where;
    for (const Pair& one : pairs())
      for (const int functions : sizes())
        for (const double frequency :
             app::nyquist_resonances(study.scene_for(one, functions), 0.5 * forcing, 2.0 * forcing)) {
          if (std::abs(frequency - forcing) >= std::abs(nearest - forcing)) continue;
          nearest = frequency;
          where = one.label + " with " + std::to_string(functions) + " functions";
        }
    artefact.note(fmt::format(
        "At {}: the Nyquist coefficient of an even number of functions is undamped in every pair; of "
        "its resonances the nearest to the forcing is that of {}, at {} Hz.",
        study.frequency_text(), where, report::number(nearest, 6)));
  }
}

}  // namespace wavebalance::jl14

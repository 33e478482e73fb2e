#include "convergence.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "curve_measures.hpp"
#include "nyquist_resonances.hpp"
#include "wavebalance/app/analysis/measures.hpp"

namespace wavebalance::jl14 {
namespace {

std::string case_file(int case_number) { return "case" + std::to_string(case_number) + ".toml"; }

Measures measures_of(const Case& study, const app::Response& response, int functions, bool energies) {
  Measures m{.converged = response.converged};
  if (!response.converged) return m;
  const Eigen::VectorXd u = response.displacement(), exact = study.reference().displacement();
  const Eigen::VectorXd middle = cell_midpoints(u, functions),
                        exact_middle = cell_midpoints(exact, functions);
  const double range = exact.maxCoeff() - exact.minCoeff();
  m.rms = app::relative_rms_error(u, exact);
  m.mean = relative_mean_error(u, exact);
  m.largest = (u - exact).cwiseAbs().maxCoeff() / range;
  m.midpoint_rms = app::relative_rms_error(middle, exact_middle);
  m.midpoint_mean = relative_mean_error(middle, exact_middle);
  m.midpoint_largest = (middle - exact_middle).cwiseAbs().maxCoeff() / range;
  if (!energies) return m;
  m.energy_ratio = app::energy_norm(study.scene(), response.structure) / app::rms(study.reference_energy());
  m.energy_deviation = std::abs(m.energy_ratio - 1.0);
  return m;
}

/// A history at uniform points of the period at the samples of sums: the value of the last point before.
Eigen::VectorXd start_from(const Eigen::VectorXd& history, const Sums& sums) {
  return Eigen::VectorXd::NullaryExpr(sums.samples, [&](Eigen::Index l) {
    const double time = (double(l) + sums.offset) / sums.samples;
    return history[static_cast<Eigen::Index>(std::floor(time * double(history.size())))];
  });
}

}  // namespace

std::vector<int> sizes() { return {8, 16, 32, 64, 128}; }

const std::vector<Sums>& convergence_sums() {
  static const std::vector<Sums> all{
      {256, 0.0, false, true}, {256, 0.5, false, true},  {256, 0.0, false, false}, {256, 0.0, true, true},
      {512, 0.0, false, true}, {1024, 0.0, false, true}, {1024, 0.5, true, true}};
  return all;
}

Convergence::Convergence(report::Artefact& artefact, bool energies, const Sums& sums,
                         const Convergence* start)
    : sums_(sums) {
  for (const int number : {1, 2}) {
    Case study(artefact, number);
    if (start) artefact.scene(case_file(number), sums.overrides(pairs().front()));
    for (const Pair& pair : pairs())
      for (const int functions : sizes()) {
        const Key key{number, pair.name(), functions};
        const auto response = start ? start->solved_again(study, pair, functions, energies, sums)
                                    : study.solve(pair, functions, energies);
        measures_[key] = measures_of(study, response, functions, energies);
        if (response.converged) displacements_[key] = response.displacement();
      }
  }
}

app::Response Convergence::solved_again(const Case& study, const Pair& pair, int functions, bool energies,
                                        const Sums& sums) const {
  const app::Scene scene = study.scene_under(pair, functions, sums.overrides(pair));
  app::ResponseOptions options;
  if (energies) options.structure_points = scene.analysis.output_points;
  const auto start = displacements_.find({study.number(), pair.name(), functions});
  if (start != displacements_.end()) options.guess = start_from(start->second, sums);
  return app::weighted_residual_response(scene, options);
}

double Convergence::at(Measure measure, int case_number, const std::string& pair_name, int functions) const {
  return measures_.at({case_number, pair_name, functions}).*measure;
}

std::vector<double> Convergence::of(Measure measure, int case_number, const std::string& pair_name,
                                    const std::vector<int>& functions) const {
  std::vector<double> values;
  for (const int number : functions) values.push_back(at(measure, case_number, pair_name, number));
  return values;
}

std::vector<double> Convergence::extreme(const double& (*better)(const double&, const double&),
                                         Measure measure, int case_number,
                                         const std::vector<std::string>& names,
                                         const std::vector<int>& functions) const {
  std::vector<double> values;
  for (const int number : functions) {
    double& value = values.emplace_back(at(measure, case_number, names.front(), number));
    for (const auto& name : names) {
      const double other = at(measure, case_number, name, number);
      value = std::isnan(other) || std::isnan(value) ? solvers::missing : better(value, other);
    }
  }
  return values;
}

std::string Convergence::text(Measure measure, int case_number, const std::string& pair_name,
                              const std::vector<int>& functions) const {
  std::string text;
  for (const int number : functions) {
    const double value = at(measure, case_number, pair_name, number);
    text += (text.empty() ? "" : ", ") + std::to_string(number) + ": " +
            (std::isnan(value) ? "no solution found" : report::percent(value));
  }
  return text;
}

double Convergence::order(Measure measure, int case_number, const std::string& pair_name) const {
  std::vector<double> numbers, values = of(measure, case_number, pair_name);
  for (const int functions : sizes()) numbers.push_back(functions);
  const bool known = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  return known ? app::observed_order(numbers, values) : solvers::missing;
}

Table Convergence::table(Measure measure, const std::string& column) const {
  Table table({"case", "trial", "weight", "functions", column, "converged"});
  for (const int number : {1, 2})
    for (const Pair& pair : pairs())
      for (const int functions : sizes()) {
        const Measures& m = measures_.at({number, pair.name(), functions});
        table.append_row({std::int64_t{number}, pair.trial, pair.weight, std::int64_t{functions}, m.*measure,
                          m.converged});
      }
  return table;
}

std::vector<app::Panel> Convergence::panels(Measure measure, const std::string& label,
                                            bool logarithmic) const {
  constexpr double aside = 0.035;  // octaves between two curves, so that none hides another
  double lower = std::numeric_limits<double>::infinity(), upper = -lower;
  std::vector<app::Panel> panels;
  for (const int number : {1, 2}) {
    app::Panel& panel = panels.emplace_back();
    panel.title = number == 1 ? "150 Hz" : "1275 Hz";
    for (std::size_t i = 0; i < pairs().size(); ++i) {
      const Pair& pair = pairs()[i];
      const auto y = of(measure, number, pair.name());
      std::vector<double> x;
      for (const int functions : sizes())
        x.push_back(functions * std::exp2(aside * (double(i) - 0.5 * double(pairs().size() - 1))));
      for (const double value : y) {
        if (!std::isfinite(value)) continue;
        lower = std::min(lower, value);
        upper = std::max(upper, value);
      }
      Series series(pair.label, x, y, app::SeriesStyle::line_points);
      const auto functions = sizes();
      series.told_x.assign(functions.begin(), functions.end());
      series.colour = pair.colour;
      series.marker = pair.marker;
      panel.add(std::move(series));
    }
    panel.x = axis("Number of basis functions", 7.0, 147.0);
    panel.x.logarithmic = true;
    panel.x.ticks = {8, 16, 32, 64, 128};
    panel.x.tick_format = "%g";
  }
  for (app::Panel& panel : panels) {
    const double margin = 0.05 * (upper - lower);
    constexpr double factor = 1.5;  // beyond the curves; whole decades would leave one of them empty
    panel.y = logarithmic ? axis(label, lower / factor, factor * upper)
                          : axis(label, lower - margin, upper + margin);
    panel.y.logarithmic = logarithmic;
  }
  return panels;
}

std::vector<Convergence> under_all_sums(report::Artefact& artefact, bool energies) {
  std::vector<Convergence> all;
  all.reserve(convergence_sums().size());  // each may start from another one
  for (const Sums& sums : convergence_sums())
    all.emplace_back(artefact, energies, sums, all.empty() ? nullptr : &all[sums.samples == 256 ? 0 : 1]);
  return all;
}

void judge_under_all(report::Artefact& artefact, report::Statement statement,
                     const std::vector<Convergence>& all,
                     const std::function<Finding(const Convergence&)>& judge, const std::string& because) {
  std::vector<report::Reading> readings;
  for (const Convergence& results : all) {
    const Finding outcome = judge(results);
    readings.push_back({results.sums().name(), outcome.verdict, outcome.measured, results.sums().of_text()});
  }
  statement.because = because.empty() ? "Drawn: " + readings.front().measured + "." : because;
  artefact.statement(concluded(std::move(statement), std::move(readings)));
}

std::string range_over(const std::vector<Convergence>& all,
                       const std::function<double(const Convergence&)>& figure, bool as_percent) {
  const Convergence *least = nullptr, *most = nullptr;
  for (const Convergence& results : all) {
    if (!results.sums().of_text() || !std::isfinite(figure(results))) continue;
    if (!least || figure(results) < figure(*least)) least = &results;
    if (!most || figure(results) > figure(*most)) most = &results;
  }
  if (!least) return "not known";
  const auto text = [&](double value) { return as_percent ? report::percent(value) : report::number(value); };
  const std::string from = text(figure(*least)), to = text(figure(*most));
  return from == to ? from : from + " to " + to;
}

std::string range_over(const std::vector<Convergence>& all, Measure measure, int case_number,
                       const std::string& pair_name, int functions) {
  return range_over(
      all, [&](const Convergence& one) { return one.at(measure, case_number, pair_name, functions); });
}

report::Verdict lower_where_known(const std::vector<double>& first, const std::vector<double>& second) {
  std::vector<double> a, b;
  for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i) {
    if (!std::isfinite(first[i]) || !std::isfinite(second[i])) continue;
    a.push_back(first[i]);
    b.push_back(second[i]);
  }
  return a.empty() ? report::Verdict::differs : report::lower(a, b);
}

report::Verdict by_rms_and_mean(const std::function<report::Verdict(Measure)>& part) {
  return report::together({part(&Measures::rms), part(&Measures::mean)});
}

void note_convergence_sums(report::Artefact& artefact) {
  std::string names;
  for (const Sums& one : convergence_sums())
    if (!one.of_text()) names += (names.empty() ? "" : "; ") + one.name();
  artefact.note(fmt::format(
      "The text allows 256 points at left ends, which are drawn, and at mid-points. Other ways to form the sums, each "
      "started from the solution drawn: {}. With exact products the force is still summed over the points.",
      names));
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
             nyquist_resonances(study.scene_for(one, functions), 0.5 * forcing, 2.0 * forcing)) {
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

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "curves.hpp"
#include "figures.hpp"
#include "wavebalance/app/analysis/measures.hpp"

namespace wavebalance::ll10 {
namespace {

struct Row {
  int harmonics, elements;
  double lumped;
  Distance distance;
  double linear_error;  ///< of the linear frequency
  double accepted;      ///< share of the points
  double frequency;     ///< Hz, at energy ratio 1.8
  double in_space;      ///< of that frequency against the finest mesh with the same N; NaN elsewhere
};

constexpr int finest_elements = 160;
constexpr const char* rod_file = "rod.toml";
constexpr const char* remedy_file = "rod_half_lumped.toml";

Row row_of(report::Artefact& artefact, const char* file, int harmonics, int elements) {
  const auto scene = artefact.scene(file, {"analysis.harmonics=" + std::to_string(harmonics),
                                           "analysis.samples=" + std::to_string(2 * harmonics),
                                           "structure.elements=" + std::to_string(elements)});
  const app::ModeStudy study(scene);
  const auto curve = study.backbone();
  const double exact = ExactBarMode::linear_frequency(exact_bar(scene), 1);
  return {harmonics,
          elements,
          scene.structure.lumped_mass_fraction,
          exact_distance(study, curve),
          std::abs(study.linear_frequency() / exact - 1.0),
          curve.count(solvers::ModeStatus::converged) / static_cast<double>(curve.points.size()),
          study.at_energy(curve, 1.8).omega / (2.0 * std::numbers::pi),
          std::nan("")};
}

Table table_of(const std::vector<Row>& rows) {
  Table table({"harmonics", "samples", "elements", "lumped_mass_fraction", "median_frequency_error",
               "largest_frequency_error", "points_compared", "accepted_share", "linear_frequency_error",
               "frequency_at_1.8_against_160_elements"});
  for (const Row& row : rows)
    table.append_row({std::int64_t{row.harmonics}, std::int64_t{2 * row.harmonics},
                      std::int64_t{row.elements}, row.lumped, row.distance.median, row.distance.largest,
                      std::int64_t{row.distance.points}, row.accepted, row.linear_error, row.in_space});
  return table;
}

std::vector<double> column(const std::vector<Row>& rows, double (*value)(const Row&)) {
  std::vector<double> values;
  for (const Row& row : rows) values.push_back(value(row));
  return values;
}

double median(const Row& row) { return row.distance.median; }
double largest(const Row& row) { return row.distance.largest; }
double harmonics(const Row& row) { return row.harmonics; }
double elements(const Row& row) { return row.elements; }
double in_space(const Row& row) { return row.in_space; }
double linear_error(const Row& row) { return row.linear_error; }

void add_panel(app::Figure& figure, const std::string& title, const std::vector<Row>& rows,
               bool over_elements) {
  const auto size = over_elements ? elements : harmonics;
  auto& panel = figure.add_panel(title);
  panel.x.label = over_elements ? "Elements, N = 5" : "Harmonics N, 80 elements";
  panel.x.logarithmic = panel.y.logarithmic = true;
  panel.x.ticks = column(rows, size);
  panel.x.lower = 0.8 * panel.x.ticks.front();
  panel.x.upper = 1.25 * panel.x.ticks.back();
  panel.x.tick_format = "%g";
  panel.y.label = "Relative error of ω";
  panel.y.lower = over_elements ? 1e-10 : 1e-3;
  panel.y.upper = over_elements ? 1.0 : 1e-1;
  using enum app::SeriesStyle;
  panel.add({"largest", column(rows, size), column(rows, largest), line_points});
  panel.add({"median", column(rows, size), column(rows, median), line_points});
  if (!over_elements) return;
  panel.add({"finest mesh", column(rows, size), column(rows, in_space), line_points});
  panel.add({"linear ω", column(rows, size), column(rows, linear_error), line_points});
}

double order(const std::vector<Row>& rows, double (*size)(const Row&), double (*error)(const Row&)) {
  return app::observed_order(column(rows, size), column(rows, error));
}

struct Rows {
  std::vector<Row> over_harmonics, over_elements;
};

void note_orders(report::Artefact& artefact, const std::string& name, const Rows& rows) {
  const auto& harmonic_rows = rows.over_harmonics;
  artefact.note(fmt::format(
      "{}, observed orders (least squares). In N: median {}, largest {}, which stands at the edges of internal "
      "resonances and goes from {} to {}. In the elements: {} against the finest mesh and {} of the linear "
      "frequency; against the exact curve N = {} sets a floor of {}.",
      name, report::number(order(harmonic_rows, harmonics, median), 2),
      report::number(order(harmonic_rows, harmonics, largest), 2),
      report::percent(harmonic_rows.front().distance.largest, 2),
      report::percent(harmonic_rows.back().distance.largest, 2),
      report::number(order(rows.over_elements, elements, in_space), 3),
      report::number(order(rows.over_elements, elements, linear_error), 3),
      rows.over_elements.back().harmonics, report::percent(rows.over_elements.back().distance.median, 2)));
}

}  // namespace

void fig03_convergence(report::Artefact& artefact) {
  std::map<std::string, Rows> found;
  std::vector<Row> all;
  for (const char* file : {rod_file, remedy_file}) {
    Rows& rows = found[file];
    // Nothing is gained beyond a quarter of the elements.
    for (const int n : {2, 3, 5, 8, 12, 18}) rows.over_harmonics.push_back(row_of(artefact, file, n, 80));
    for (const int n : {5, 10, 20, 40, 80}) rows.over_elements.push_back(row_of(artefact, file, 5, n));
    const Row finest = row_of(artefact, file, 5, finest_elements);
    for (Row& row : rows.over_elements) row.in_space = std::abs(row.frequency / finest.frequency - 1.0);
    for (const auto* some : {&rows.over_harmonics, &rows.over_elements})
      all.insert(all.end(), some->begin(), some->end());
  }
  artefact.data(table_of(all), "errors relative to the exact frequency at the same energy ratio");
  app::Figure figure;
  figure.columns = 2;
  figure.panel_width = 350;
  figure.panel_height = 330;
  add_panel(figure, "eq. (28)", found[rod_file].over_harmonics, false);
  add_panel(figure, "eq. (28)", found[rod_file].over_elements, true);
  add_panel(figure, "half-lumped", found[remedy_file].over_harmonics, false);
  add_panel(figure, "half-lumped", found[remedy_file].over_elements, true);
  artefact.picture(figure);
  artefact.caption(fmt::format(
      "Errors of ω against the exact curve over the accepted points at energy ratios 1.2 to 10, of {} frequencies: "
      "their median and the largest. Finest mesh: ω at energy 1.8 against that with {} elements and the same N. "
      "Linear ω: the first linear frequency. m = 2N samples.",
      artefact.scene(rod_file).analysis.points, finest_elements));
  for (const char* file : {rod_file, remedy_file})
    note_orders(artefact, file == rod_file ? "Eq. (28)" : "Half-lumped", found[file]);
}

}  // namespace wavebalance::ll10

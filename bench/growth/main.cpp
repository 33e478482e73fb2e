#include <cmath>
#include <cstdio>
#include <limits>

#include "data_file.hpp"
#include "memory.hpp"
#include "program.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/compare/solve_point.hpp"
#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/plot/plot.hpp"
#include "wavebalance/solvers/response/forced_response.hpp"

// Time and memory of one solve over the number of functions and of elements: growth.csv and its picture.
namespace wavebalance::bench {
namespace {

constexpr double longest = 4.0;  // s; longer solves are not run
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// A scene over functions or elements.
struct SizeSeries {
  std::string name, label;
  std::string variable;  ///< "functions" or "elements"
  std::vector<int> sizes;
  app::Scene scene;
  app::Colour colour;
  int marker;
};

struct Measured {
  double construction_seconds = unknown, condensation_seconds = unknown, seconds = unknown, bytes = unknown;
  int active_samples = 0, iterations = 0;
  bool converged = false, run = false;
};

solvers::CondensedProblem condensed_problem(const app::Scene& scene) {
  return {app::make_pair(scene.time), app::make_structure(scene), Eigen::Vector2cd(0.0, 1.0)};
}

// Complementarity paths would hide the cost of Newton's method.
solvers::ForcedResponseOptions newton_only() {
  solvers::ForcedResponseOptions options;
  options.fallbacks = false;
  return options;
}

void solve_once(const app::Scene& scene) {
  solvers::CondensedProblem problem = condensed_problem(scene);
  problem.set_frequency(scene.forcing.frequency);
  solvers::forced_response(problem, app::make_law(scene.contact), newton_only());
}

app::Scene smallest(app::Scene scene) {
  scene.structure.elements = 5;
  scene.time.functions = 16;
  scene.time.quadrature_points = 64;
  return scene;
}

Measured measure(const app::Scene& scene) {
  Measured measured;
  measured.run = true;
  const solvers::AnyContactLaw law = app::make_law(scene.contact);
  measured.bytes = peak_bytes([&] { solve_once(smallest(scene)); }, [&] { solve_once(scene); });
  measured.construction_seconds = app::least_seconds([&] { condensed_problem(scene); });
  solvers::CondensedProblem problem = condensed_problem(scene);
  measured.condensation_seconds = app::least_seconds([&] {
    problem.forget_condensation();
    problem.set_frequency(scene.forcing.frequency);
  });
  solvers::PeriodicResponse response;
  measured.seconds = app::least_seconds(
      [&] {
        problem.forget_condensation();
        problem.set_frequency(scene.forcing.frequency);
        response = solvers::forced_response(problem, law, newton_only());
      },
      {.least = 3});
  measured.converged = response.converged();
  measured.iterations = response.iterations;
  measured.active_samples = static_cast<int>((response.contact_force.array() != 0.0).count());
  return measured;
}

app::Scene sized(const SizeSeries& series, int size) {
  app::Scene scene = series.scene;
  if (series.variable == "elements") {
    scene.structure.elements = size;
    scene.time.functions = 63;
    return scene;
  }
  scene.time.functions = scene.time.trial == "fourier" ? size - 1 : size;
  scene.time.quadrature_points = 4 * size;
  return scene;
}

SizeSeries size_series(const std::string& name, const std::string& label, const std::string& variable,
                       std::vector<int> sizes, int case_number, const std::string& basis, app::Colour colour,
                       int marker) {
  const std::vector<std::string> overrides{"time.trial=" + basis, "time.weight=" + basis,
                                           "time.inner_products=exact", "time.functions=64"};
  return {
      name,
      label,
      variable,
      std::move(sizes),
      app::load_scene(WAVEBALANCE_SCENES "/jones_legrand_2014/case" + std::to_string(case_number) + ".toml",
                      overrides),
      colour,
      marker};
}

std::vector<SizeSeries> all_series(bool quick) {
  using app::Colour;
  std::vector<int> functions, elements{25, 100};
  for (int size = 64; size <= (quick ? 128 : 16384); size *= 2) functions.push_back(size);
  if (!quick) elements = {25, 50, 100, 250, 500, 1000, 2500, 5000, 10000, 25000, 50000, 100000};
  return {
      size_series("fourier_case1", "Fourier, case 1", "functions", functions, 1, "fourier", Colour::blue, 1),
      size_series("fourier_case2", "Fourier, case 2", "functions", functions, 2, "fourier",
                  Colour::vermillion, 2),
      size_series("bspline_case2", "B-spline, case 2", "functions", functions, 2, "bspline", Colour::green,
                  3),
      size_series("daubechies6_case2", "DB6, case 2", "functions", functions, 2, "daubechies6",
                  Colour::orange, 4),
      size_series("elements_case1", "case 1", "elements", elements, 1, "fourier", Colour::blue, 1),
      size_series("elements_case2", "case 2", "elements", elements, 2, "fourier", Colour::vermillion, 2),
  };
}

// Slope of ln(quantity) over ln(size) from the upper half of the sizes; for functions M also over M log M.
double slope(const std::vector<double>& sizes, const std::vector<double>& values) {
  std::vector<double> x, y;
  for (std::size_t i = sizes.size() / 2; i < sizes.size(); ++i)
    if (values[i] > 0.0) {
      x.push_back(sizes[i]);
      y.push_back(values[i]);
    }
  return x.size() < 2 ? unknown : -app::observed_order(x, y);
}

struct Results {
  app::Table points{std::vector<std::string>{
      "ladder", "variable", "trial", "functions", "points", "elements", "construction_seconds",
      "condensation_seconds", "seconds", "peak_bytes", "iterations", "active_samples", "converged", "run"}};
  app::Table slopes{std::vector<std::string>{"ladder", "variable", "quantity", "from", "to", "slope",
                                             "slope_over_expected"}};
};

void append(Results& results, const SizeSeries& one, const app::Scene& scene, const Measured& m) {
  results.points.append_row({one.name, one.variable, scene.time.trial, std::int64_t{scene.time.functions},
                             std::int64_t{scene.time.quadrature_points},
                             std::int64_t{scene.structure.elements}, m.construction_seconds,
                             m.condensation_seconds, m.seconds, m.bytes, std::int64_t{m.iterations},
                             std::int64_t{m.active_samples}, m.converged, m.run});
}

// Expected: M log M for the time over functions, else proportional to the size.
void fit(Results& results, const SizeSeries& one) {
  const app::Table rows = results.points.where("ladder", one.name).where("converged", "true");
  if (rows.rows() < 3) return;
  const std::vector<double> sizes = rows.numbers(one.variable);
  for (const char* quantity : {"construction_seconds", "condensation_seconds", "seconds", "peak_bytes"}) {
    std::vector<double> values = rows.numbers(quantity);
    const double plain = slope(sizes, values);
    const bool logarithm = one.variable == "functions" && std::string(quantity) != "peak_bytes";
    for (std::size_t i = 0; i < values.size(); ++i) values[i] /= logarithm ? std::log(sizes[i]) : 1.0;
    results.slopes.append_row({one.name, one.variable, std::string(quantity), sizes[sizes.size() / 2],
                               sizes.back(), plain, slope(sizes, values) - 1.0});
  }
}

void measure_all(Results& results, const SizeSeries& one) {
  Measured last;
  app::TimeLimit limit(longest);
  for (std::size_t i = 0; i < one.sizes.size(); ++i) {
    const app::Scene scene = sized(one, one.sizes[i]);
    const double growth = i == 0 ? 1.0 : double(one.sizes[i]) / one.sizes[i - 1];
    if (!limit.allows(growth)) {
      append(results, one, scene, {});
      continue;
    }
    last = measure(scene);
    limit.took(last.seconds);
    append(results, one, scene, last);
  }
  fit(results, one);
  std::printf("%-20s up to %6d %s: %.3g s, %.3g MB\n", one.name.c_str(), one.sizes.back(),
              one.variable.c_str(), last.seconds, 1e-6 * last.bytes);
  std::fflush(stdout);
}

void draw(app::Panel& panel, const std::vector<SizeSeries>& all, const Results& results,
          const std::string& variable, const std::string& quantity, const std::string& label) {
  panel.x.label = variable == "functions" ? "Functions M, 4M points" : "Elements, 63 functions, 256 points";
  panel.y.label = label;
  panel.x.logarithmic = panel.y.logarithmic = true;
  for (const SizeSeries& one : all) {
    if (one.variable != variable) continue;
    const auto rows = results.points.where("ladder", one.name).where("converged", "true");
    const auto fitted = results.slopes.where("ladder", one.name).where("quantity", quantity);
    char text[32] = "";
    if (!fitted.empty()) std::snprintf(text, sizeof text, ", slope %.2f", fitted.numbers("slope")[0]);
    app::Series series(one.label + text, rows, variable, quantity, app::SeriesStyle::line_points);
    series.colour = one.colour;
    series.marker = one.marker;
    panel.add(std::move(series));
  }
}

constexpr const char* about =
    "Measures time and memory of one solve of the bar of JL14 over the number of functions and of elements.\n"
    "Writes growth.csv, growth_slopes.csv and a picture.";

void run(const Program& program) {
  Results results;
  const std::vector<SizeSeries> all = all_series(program.quick);
  for (const SizeSeries& one : all) measure_all(results, one);
  app::Figure figure;
  figure.title = "Growth of one solve";
  figure.columns = 2;
  for (const char* variable : {"functions", "elements"}) {
    draw(figure.add_panel("Time"), all, results, variable, "seconds", "Solve time (processor seconds)");
    draw(figure.add_panel("Memory"), all, results, variable, "peak_bytes", "Peak memory (bytes)");
  }
  write_data(program.output, "growth", results.points,
             {"Time and memory of one solve over functions and elements",
              "SI; a column's name ends in its unit",
              "reproduce/scenes/jones_legrand_2014",
              {"seconds: from the contact-free response, condensation included, plans made before",
               "peak_bytes: resident memory that construction and solve add"}});
  write_data(
      program.output, "growth_slopes", results.slopes,
      {"Slopes of growth.csv on logarithmic axes, upper half of each series",
       {},
       {},
       {"slope_over_expected: beyond M log M for times over functions, beyond proportional elsewhere"}});
  write_pictures(program.output / "growth", figure);
}

}  // namespace
}  // namespace wavebalance::bench

int main(int argc, char** argv) {
  return wavebalance::bench::run_program(argc, argv, wavebalance::bench::about, wavebalance::bench::run);
}

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "data_file.hpp"
#include "program.hpp"
#include "study.hpp"
#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/plot/plot.hpp"

// Error and cost for a tolerance, compared with the cheapest fixed choice of the same error: tolerance.csv
// and its picture.
namespace wavebalance::bench {
namespace {

using app::Series;
using app::SeriesStyle;

constexpr double allowed = 3.0;  // true error over tolerance, and cost over the cheapest fixed choice
// Errors of the reference and of rounding: below it one error is as good as another.
constexpr double reference_error = 1e-10;

app::Table empty_table() {
  return app::Table({"motion", "tolerance", "status", "estimated_error", "true_error", "error_over_tolerance",
                     "functions", "quadrature_points", "rungs", "seconds", "fixed_trial", "fixed_weight",
                     "fixed_functions", "fixed_points", "fixed_error", "fixed_seconds", "cost_ratio"});
}

double error_to_match(const Asked& asked) { return std::max(asked.error, reference_error); }

void append(app::Table& table, const std::string& motion, const Asked& asked, const ToleranceStudy& study,
            const std::vector<FixedChoice>& choices) {
  const FixedChoice* found = cheapest(choices, error_to_match(asked));
  const FixedChoice fixed = found == nullptr ? FixedChoice{.error = std::nan("")} : *found;
  const Beside seconds = study.time_beside(asked, fixed);
  const std::string none = found == nullptr ? "none" : "";
  table.append_row({motion, asked.tolerance, asked.status, asked.estimated_error, asked.error,
                    asked.error / asked.tolerance, std::int64_t{asked.functions}, std::int64_t{asked.points},
                    std::int64_t{asked.levels}, seconds.asked, none + fixed.trial, none + fixed.weight,
                    std::int64_t{fixed.functions}, std::int64_t{fixed.points}, fixed.error, seconds.fixed,
                    seconds.asked / seconds.fixed});
}

void append_motion(app::Table& table, const tolerance::Motion& motion, const StudySizes& sizes,
                   const std::vector<double>& tolerances) {
  const ToleranceStudy study(motion, WAVEBALANCE_SCENES, sizes);
  std::vector<Asked> asked;
  double goal = std::numeric_limits<double>::infinity();
  for (const double tolerance : tolerances) {
    asked.push_back(study.ask(tolerance));
    goal = std::min(goal, error_to_match(asked.back()));
  }
  const auto choices = study.fixed_choices(goal);
  for (const Asked& one : asked) append(table, motion.name, one, study, choices);
  std::printf("%s: %zu fixed choices\n", motion.name, choices.size());
  std::fflush(stdout);
}

app::Panel& add_panel(app::Figure& figure, const std::string& title, const std::string& label) {
  app::Panel& panel = figure.add_panel(title);
  panel.x = {.label = "Tolerance",
             .lower = 3e-9,
             .upper = 0.3,
             .logarithmic = true,
             .ticks = {},
             .tick_format = "10^{%L}"};
  panel.y.label = label;
  panel.y.logarithmic = true;
  return panel;
}

Series line(const std::string& label, double at_least, double at_most, bool proportional, double factor) {
  const std::vector<double> x{at_least, at_most};
  const std::vector<double> y{factor * (proportional ? at_least : 1.0),
                              factor * (proportional ? at_most : 1.0)};
  Series one(label, x, y);
  one.colour = app::Colour::grey;
  one.dash = factor == 1.0 ? app::Dash::solid : app::Dash::dashed;
  return one;
}

Series marks(const std::string& label, const app::Table& rows, const std::string& column, app::Colour colour,
             int marker) {
  Series one(label, rows, "tolerance", column, SeriesStyle::points);
  one.colour = colour;
  one.marker = marker;
  return one;
}

app::Figure picture(const app::Table& table) {
  const app::Table met = table.where("status", "converged");
  app::Figure figure;
  figure.columns = 2;
  figure.title = "Scenes with a tolerance: " + std::to_string(table.rows()) + " runs";
  app::Panel& errors = add_panel(figure, "True error", "Relative rms error of the tip displacement");
  errors.y.tick_format = "10^{%L}";
  errors.y.lower = 1e-15;
  errors.add(line("three times the tolerance", 1e-8, 1e-1, true, allowed));
  errors.add(line("tolerance", 1e-8, 1e-1, true, 1.0));
  errors.add(marks("true", met, "true_error", app::Colour::blue, 1));
  app::Panel& costs = add_panel(figure, "Cost", "Cost over the cheapest fixed choice");
  costs.add(line("", 1e-8, 1e-1, false, allowed));
  costs.add(line("", 1e-8, 1e-1, false, 1.0));
  costs.add(marks("", met, "cost_ratio", app::Colour::vermillion, 1));
  return figure;
}

double largest(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end(),
                           [](double a, double b) { return a < b || std::isnan(a); });
}

double median(std::vector<double> values) {
  std::erase_if(values, [](double value) { return std::isnan(value); });
  if (values.empty()) return std::nan("");
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void report(const app::Table& table) {
  std::printf("%-10s %9s %9s %22s %12s %12s\n", "tolerance", "runs", "met", "largest error/tolerance",
              "median cost", "largest cost");
  std::vector<std::string> seen;
  for (const std::string& tolerance : table.texts("tolerance")) {
    if (std::find(seen.begin(), seen.end(), tolerance) != seen.end()) continue;
    seen.push_back(tolerance);
    const app::Table rows = table.where("tolerance", tolerance);
    const app::Table met = rows.where("status", "converged");
    if (met.empty()) continue;
    const auto costs = met.numbers("cost_ratio");
    std::printf("%-10s %9zu %9zu %22.3g %12.3g %12.3g\n", tolerance.c_str(), rows.rows(), met.rows(),
                largest(met.numbers("error_over_tolerance")), median(costs), largest(costs));
  }
}

constexpr const char* about =
    "Measures what a scene with a tolerance costs beside the cheapest fixed choice of the same error.\n"
    "Writes tolerance.csv and a picture.";

void run(const Program& program) {
  StudySizes sizes;
  std::vector<double> tolerances{1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8};
  auto motions = tolerance::motions();
  if (program.quick) {
    sizes = {64, 256, 0.05};
    tolerances = {1e-1, 1e-2};
    motions.resize(2);
  }
  app::Table table = empty_table();
  for (const auto& motion : motions) append_motion(table, motion, sizes, tolerances);
  write_data(program.output, "tolerance", table,
             {"Scenes with a tolerance beside the cheapest fixed choice of the same true error",
              "s of processor time; errors are relative rms of the contact displacement",
              "reproduce/scenes/tolerance",
              {"Composition of the problem is part of every time."}});
  app::write_pictures(program.output / "tolerance", picture(table));
  report(table);
}

}  // namespace
}  // namespace wavebalance::bench

int main(int argc, char** argv) {
  return wavebalance::bench::run_program(argc, argv, wavebalance::bench::about, wavebalance::bench::run);
}

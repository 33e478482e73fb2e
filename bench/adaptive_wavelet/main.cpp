// How many unknowns adaptive wavelet balance needs for a given error, beside the uniform one: both cases of
// [JL14] and a rigid obstacle. Writes adaptive_wavelet.csv, .svg, .png and adaptive_wavelet_selection.csv.
#include "data_file.hpp"
#include "program.hpp"
#include "study.hpp"
#include "wavebalance/app/plot/plot.hpp"

using namespace wavebalance;
using app::Colour;
using app::Panel;
using app::Series;
using app::SeriesStyle;

namespace {

struct Curve {
  const char *basis, *method, *label;
  Colour colour;
  app::Dash dash;
  int marker;
};

constexpr Curve wavelet_curves[] = {
    {"daubechies6", "uniform", "DB6, uniform", Colour::orange, app::Dash::dashed, 4},
    {"daubechies6", "adaptive_residual", "DB6, adaptive", Colour::orange, app::Dash::solid, 5},
    {"bspline", "uniform", "B-spline, uniform", Colour::blue, app::Dash::dashed, 6},
    {"bspline", "whole_levels", "B-spline, whole levels", Colour::sky_blue, app::Dash::dotted, 2},
    {"bspline", "adaptive_residual", "B-spline, adaptive", Colour::blue, app::Dash::solid, 7},
    {"bspline", "stiffness_section", "B-spline, selected first", Colour::grey, app::Dash::dash_dotted, 1}};

constexpr Curve rigid_curves[] = {
    {"daubechies6", "uniform", "DB6, uniform", Colour::orange, app::Dash::dashed, 4},
    {"bspline", "uniform", "B-spline, uniform", Colour::blue, app::Dash::dashed, 6},
    {"force_cells", "uniform", "force cells, uniform", Colour::green, app::Dash::dashed, 8},
    {"force_cells", "adaptive", "force cells, adaptive", Colour::green, app::Dash::solid, 9}};

template <std::size_t Count>
void add_error_panel(app::Figure& figure, const std::string& title, const app::Table& table,
                     const std::string& study, const Curve (&curves)[Count]) {
  Panel& panel = figure.add_panel(title);
  const auto of_study = table.where("study", study).where("converged", "true");
  for (const Curve& curve : curves) {
    const auto rows = of_study.where("basis", curve.basis).where("method", curve.method);
    Series series(curve.label, rows, "unknowns", "rms_relative_error", SeriesStyle::line_points);
    series.colour = curve.colour;
    series.dash = curve.dash;
    series.marker = curve.marker;
    panel.add(std::move(series));
  }
  panel.x.label = "Unknowns";
  panel.x.logarithmic = true;
  panel.x.ticks = {16, 32, 64, 128, 256, 512};
  panel.x.lower = 14;
  panel.x.upper = 600;
  panel.x.tick_format = "%g";
  panel.y.label = "Relative rms error";
  panel.y.logarithmic = true;
  panel.y.tick_format = "10^{%L}";
}

void mark_instants(Panel& panel, const bench::Study& study) {
  for (const double instant : study.instants) panel.mark_x(instant);
  panel.x.label = "Time (fraction of a period); dotted: contact closes, opens";
  panel.x.lower = 0.0;
  panel.x.upper = 1.0;
}

void add_selection_panel(app::Figure& figure, const bench::Study& study, const app::Table& selection) {
  Panel& panel = figure.add_panel("case 2: the " + std::to_string(selection.rows()) +
                                  " B-spline functions of error 10^{-5}");
  Series series("", selection, "time_fraction", "block", SeriesStyle::points);
  series.colour = Colour::blue;
  series.marker = 7;
  panel.add(std::move(series));
  mark_instants(panel, study);
  panel.y.label = "Block (0: scaling functions)";
  panel.y.lower = -0.5;
  panel.y.upper = 6.5;
  panel.y.ticks = {0, 1, 2, 3, 4, 5, 6};
}

void add_cell_panel(app::Figure& figure, const bench::Study& study, const solvers::CellResponse& response) {
  Panel& panel = figure.add_panel("case 2, rigid: the " + std::to_string(response.cells.size()) +
                                  " cells of error 10^{-4}");
  std::vector<double> times, widths;
  for (std::size_t i = 0; i < response.cells.size(); ++i) {
    const int end = i + 1 < response.cells.size() ? response.cells[i + 1] : study.sizes.points;
    times.push_back(double(response.cells[i]) / study.sizes.points);
    widths.push_back(double(end - response.cells[i]) / study.sizes.points);
  }
  times.push_back(1.0);
  widths.push_back(widths.back());
  Series series("", times, widths, SeriesStyle::steps);
  series.colour = Colour::green;
  panel.add(std::move(series));
  mark_instants(panel, study);
  panel.y.label = "Width (fraction of a period)";
  panel.y.logarithmic = true;
  panel.y.tick_format = "10^{%L}";
}

// The smallest round that meets an error, for the pictures of what was selected.
template <class Rounds, class Error>
const auto& first_below(const Rounds& rounds, double bound, const Error& error) {
  for (const auto& round : rounds)
    if (round.response.converged() && error(round.response.displacement) <= bound) return round.response;
  return rounds.back().response;
}

void write(const std::filesystem::path& folder, const app::Table& table, const app::Table& selection,
           const app::Figure& figure) {
  const std::string units = "study, basis, method; functions, cells; errors relative to the rms displacement";
  bench::write_data(folder, "adaptive_wavelet", table,
                    {"Error of the tip displacement over the number of unknowns, adaptive and uniform",
                     units,
                     "jones_legrand_2014/case1.toml, case2.toml, case1_rigid.toml, case2_rigid.toml",
                     {"cpu_ms: processor time, for adaptive methods of all rounds up to this one"}});
  bench::write_data(folder, "adaptive_wavelet_selection", selection,
                    {"Where the functions that were selected lie, and of which block they are",
                     "fractions of the period",
                     "jones_legrand_2014/case2.toml",
                     {}});
  app::write_pictures(folder / "adaptive_wavelet", figure);
}

constexpr const char* about =
    "Measures the error of adaptive and of uniform wavelet balance over the number of unknowns.\n"
    "Writes adaptive_wavelet.csv, adaptive_wavelet_selection.csv and a picture.";

void run(const bench::Program& program) {
  const bench::Sizes sizes = program.quick ? bench::Sizes{1024, 128, 255, 48} : bench::Sizes{};
  const auto study = [&](const char* name) { return bench::make_study(name, sizes); };
  const bench::Study case1 = study("case1"), case2 = study("case2"), rigid1 = study("case1_rigid"),
                     rigid2 = study("case2_rigid");
  app::Table table = bench::result_table();
  bench::wavelet_study(case1, "daubechies6", table);
  bench::wavelet_study(case1, "bspline", table);
  bench::wavelet_study(case2, "daubechies6", table);
  const auto adapted = bench::wavelet_study(case2, "bspline", table);
  bench::rigid_study(rigid1, table);
  const auto cells = bench::rigid_study(rigid2, table);
  const auto& chosen = first_below(adapted.rounds, 1e-5, [&](const auto& u) { return case2.error(u); });
  const auto selection = bench::selection_table(case2, "bspline", chosen.selection);
  app::Figure figure;
  figure.columns = 2;
  figure.panel_width = 520;
  figure.panel_height = 380;
  figure.title = "Adaptive wavelet balance: error over unknowns";
  add_error_panel(figure, "case 1, exponential law", table, "case1", wavelet_curves);
  add_error_panel(figure, "case 2, exponential law", table, "case2", wavelet_curves);
  add_error_panel(figure, "case 1, rigid", table, "case1_rigid", rigid_curves);
  add_error_panel(figure, "case 2, rigid", table, "case2_rigid", rigid_curves);
  add_selection_panel(figure, case2, selection);
  add_cell_panel(figure, rigid2,
                 first_below(cells.rounds, 1e-4, [&](const auto& u) { return rigid2.error(u); }));
  write(program.output, table, selection, figure);
}

}  // namespace

int main(int argc, char** argv) { return bench::run_program(argc, argv, about, run); }

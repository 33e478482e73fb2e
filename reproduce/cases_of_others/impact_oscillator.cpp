#include <cmath>
#include <numbers>
#include <vector>

#include "comparison.hpp"
#include "figures.hpp"
#include "wavebalance/app/drawing/stability_figure.hpp"
#include "wavebalance/app/results/tables.hpp"

namespace wavebalance::cases {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

/// The angular frequencies at which the motion without contact of x'' + c x' + x = cos w t reaches the gap.
std::vector<references::KnownPoint> grazing_points(double damping, double gap) {
  const double middle = 1.0 - 0.5 * damping * damping;
  const double width = std::sqrt(middle * middle - 1.0 + 1.0 / (gap * gap));
  return {{references::Type::grazing, std::sqrt(middle + width)}};
}

std::vector<Row> impact_rows(const Curve& curve) {
  app::Scene scene = curve.scene;
  scene.analysis.type = app::AnalysisType::forced_response;
  scene.forcing.frequency = 1.0 / turn;
  const app::Response found = app::impacts_response(scene, curve.model);
  if (!found.converged || found.impacts->motion.impacts.size() != 1)
    throw report::NotConverged("1 rad/s: " + found.status);
  const solvers::Impact& impact = found.impacts->motion.impacts.front();
  const auto row = [](const char* quantity, double computed, double reference) {
    return Row{std::string(quantity) + " at 1 rad/s", computed, reference, 1e-8, references::coco, 9};
  };
  return {row("phase of the impact (rad)", turn * impact.time, 0.07595216),
          row("velocity before", impact.velocity_before, 1.69573294),
          row("velocity after", impact.velocity_after, -1.35658635),
          row("impulse", impact.impulse, 3.05231929)};
}

/// The largest displacement is the gap wherever there is an impact, so that the impulse is drawn.
app::Panel impulse_panel(const Curve& curve) {
  const auto& points = curve.sweep.curve.points;
  std::vector<double> x, y;
  for (std::size_t i = 0; i < points.size(); ++i) {
    x.push_back(curve.unit * points[i].frequency);
    y.push_back(curve.sweep.impacts.front()[i].largest_impulse);
  }
  std::vector<app::PlacedPoint> marks;
  for (const auto& point : curve.sweep.stability.special_points) {
    const double place = curve.unit * point.frequency;
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (y[i] > 0.0 && std::abs(x[i] - place) < std::abs(x[nearest] - place)) nearest = i;
    // At a grazing the impact has no impulse.
    marks.push_back({point.type, place, point.type == solvers::SpecialPointType::grazing ? 0.0 : y[nearest]});
  }
  app::Panel panel;
  panel.x.label = std::string("Frequency (") + curve.unit_name() + ")";
  panel.y.label = "Impulse of the impact";
  app::Series series("impacts", x, y);
  series.colour = app::Colour::blue;
  app::draw_by_stability(panel, series, curve.sweep.stability.points, marks);
  app::draw_special_points(panel, marks);
  return panel;
}

}  // namespace

void impact_oscillator(report::Artefact& artefact) {
  Curve curve{artefact.scene("impact_oscillator.toml"), {}, {}, turn};
  curve.model = app::make_model(curve.scene);
  curve.sweep = app::impact_sweep(curve.scene, curve.model);
  if (!curve.sweep.converged()) throw report::NotConverged(curve.sweep.status());
  auto rows = compare(curve, grazing_points(0.1, 1.0), 1e-10, references::closed_form);
  for (Row& row : impact_rows(curve)) rows.push_back(std::move(row));
  auto table = curve_table(curve);
  std::vector<double> impulses;
  for (const auto& impacts : curve.sweep.impacts.front()) impulses.push_back(impacts.largest_impulse);
  table.add_column("impulse", impulses);
  artefact.data(table, "rad/s; displacements and impulses without unit");
  artefact.more_data("special_points", special_points_table(curve), "rad/s, without unit");
  app::Figure figure;
  figure.panel_width = 640;
  figure.panel_height = 500;
  figure.panels.push_back(impulse_panel(curve));
  artefact.picture(std::move(figure));
  artefact.caption(
      "An oscillator before a rigid stop with a restitution of 0.8, from 2.2 rad/s down. The curve is exact: its unknowns "
      "are the instants and impulses of its impacts. Before the grazing there are none.");
  report_rows(artefact, rows);
}

}  // namespace wavebalance::cases

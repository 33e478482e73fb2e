#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "comparison.hpp"
#include "figures.hpp"
#include "wavebalance/app/analysis/damped_modes.hpp"
#include "wavebalance/app/analysis/friction_measures.hpp"

namespace wavebalance::cases {
namespace {

constexpr double rad_per_turn = 2.0 * std::numbers::pi;
// What is asked of 63 functions and 1024 points, relative: of displacements, of the work of friction and of
// multipliers.
constexpr double of_displacement = 1e-5, of_work = 1e-4, of_multiplier = 1e-4;

double highest(const Eigen::VectorXd& samples) { return samples.maxCoeff(); }

/// Above this angular frequency the slider sticks: there the linear response has the force 1 in the slider,
/// (2 - w^2)^2 + (c w)^2 = 4.
std::vector<references::KnownPoint> slip_points(double damping) {
  return {{references::Type::slip, std::sqrt(4.0 - damping * damping)}};
}

void append_motion(std::vector<Row>& rows, const Curve& curve, const references::KnownSlip& known) {
  const auto found = response_near(curve, known.frequency, highest, known.displacement, curve.scene.time);
  const auto row = [&](const char* quantity, double computed, double reference, double tolerance) {
    rows.push_back({fmt::format("{} at {} rad/s", quantity, report::number(known.frequency)), computed,
                    reference, tolerance * reference, references::shooting, 9});
  };
  const double work = app::friction_shares(app::friction_measures(curve.scene, found.contacts)).work;
  row("largest displacement", found.displacement().maxCoeff(), known.displacement, of_displacement);
  row("first harmonic", harmonics(found.displacement(), 1)[1], known.harmonic, of_displacement);
  row("work of friction per period", work, known.work, of_work);
  row("modulus of the leading multiplier", std::abs(found.stability->leading), known.multiplier,
      of_multiplier);
}

/// The last motion of the mode, whose amplitude is that of the exact motion.
std::vector<Row> mode_rows(const app::DampedStudy& study, const solvers::DampedBackbone& mode) {
  const solvers::DampedPoint& last = mode.points.back();
  const auto& known = references::slider_mode;
  const double work =
      app::friction_shares(app::friction_measures(study.scene(), study.contact_motion(last))).work;
  const auto row = [](const char* quantity, double computed, double reference, double tolerance,
                      const char* source) {
    return Row{std::string(quantity) + " of the mode that turns at 2",
               computed,
               reference,
               tolerance * reference,
               source,
               9};
  };
  return {row("angular frequency", last.omega, known.omega, of_displacement, references::shooting),
          row("damping ratio", last.damping_ratio(), known.damping_ratio, of_work, references::shooting),
          row("work of friction per period", work, 4.0, of_work, references::closed_form)};
}

app::Panel damping_panel(const app::DampedStudy& study, const solvers::DampedBackbone& mode) {
  std::vector<double> amplitude, damping;
  for (const auto& point : mode.points) {
    amplitude.push_back(point.amplitude / study.slip_amplitude());
    damping.push_back(100.0 * point.damping_ratio());
  }
  app::Panel panel;
  panel.title = "free";
  panel.x.label = "Amplitude over that of first slip";
  panel.y.label = "Damping ratio (%)";
  app::Series series("damped mode", amplitude, damping);
  series.colour = app::Colour::blue;
  panel.add(std::move(series));
  panel.add(published_points("exact", {references::slider_mode.amplitude},
                             {100.0 * references::slider_mode.damping_ratio}));
  return panel;
}

}  // namespace

void slider(report::Artefact& artefact) {
  const Curve curve = followed(artefact, "slider.toml", rad_per_turn);
  const app::Scene scene = artefact.scene("slider_mode.toml");
  const app::DampedStudy study(scene, app::make_model(scene));
  const auto mode = study.curve(scene.analysis.largest_amplitude, {});
  if (mode.status != solvers::DampedBackboneStatus::reached_amplitude)
    throw report::NotConverged("slider_mode.toml: " + std::string(to_string(mode.status)));
  auto rows = compare(curve, slip_points(0.05), 1e-9, references::closed_form);
  for (const auto& known : references::slider_motions) append_motion(rows, curve, known);
  for (Row& row : mode_rows(study, mode)) rows.push_back(std::move(row));
  artefact.data(curve_table(curve), "rad/s; displacements without unit");
  artefact.more_data("special_points", special_points_table(curve), "rad/s, without unit");
  artefact.more_data("mode", app::damped_table(study, mode), "without unit");
  app::Figure figure;
  figure.columns = 2;
  figure.panel_width = 520;
  figure.panel_height = 460;
  figure.panels.push_back(curve_panel(curve, "63 functions", 1.0));
  figure.panels.back().title = "driven";
  figure.panels.back().y.label = "Largest displacement";
  figure.panels.push_back(damping_panel(study, mode));
  artefact.picture(std::move(figure));
  artefact.caption(
      "A mass that an elastic slider holds up to its limit. Left: from 2.2 rad/s down; the slider sticks above 2 rad/s. "
      "Right: damping of the free mass, which friction alone takes.");
  report_rows(artefact, rows);
}

}  // namespace wavebalance::cases

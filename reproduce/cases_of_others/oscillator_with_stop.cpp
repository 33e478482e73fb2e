#include <complex>
#include <numbers>
#include <vector>

#include "comparison.hpp"
#include "figures.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/results/tables.hpp"

namespace wavebalance::cases {
namespace {

double largest(const Eigen::VectorXd& samples) { return samples.maxCoeff(); }

std::vector<Row> motion_rows(const Curve& curve) {
  std::vector<Row> rows;
  for (const references::KnownMotion& motion : references::oscillator_motions) {
    const auto found = response_near(curve, motion.frequency, largest, 0.0, curve.scene.time);
    const auto multiplier = found.stability->leading;
    const std::string at = " at " + report::number(motion.frequency) + " rad/s";
    rows.push_back({"leading multiplier, real part" + at, multiplier.real(), motion.multiplier.real(), 1e-4,
                    references::shooting, 8});
    if (motion.multiplier.imag() != 0.0)
      rows.push_back({"its imaginary part" + at, multiplier.imag(), motion.multiplier.imag(), 1e-4,
                      references::shooting, 8});
    rows.push_back({"share of contact" + at, app::contact_fraction(found.leading()), motion.contact,
                    1.0 / curve.scene.analysis.output_points, references::shooting, 5});
  }
  return rows;
}

}  // namespace

void oscillator_with_stop(report::Artefact& artefact) {
  const Curve curve = followed(artefact, "oscillator_with_stop.toml", 2.0 * std::numbers::pi);
  auto rows = compare(curve, references::oscillator_points, references::oscillator_point_tolerance,
                      references::shooting);
  for (Row& row : motion_rows(curve)) rows.push_back(std::move(row));
  artefact.data(curve_table(curve), "rad/s; displacements without unit");
  artefact.more_data("special_points", special_points_table(curve), "rad/s, without unit");
  app::Figure figure;
  figure.panel_width = 640;
  figure.panel_height = 500;
  figure.panels.push_back(curve_panel(curve, "63 harmonics", 1.0));
  figure.panels.back().y.label = "Largest displacement";
  figure.panels.back().mark_y(curve.scene.contact.gap, "gap");
  artefact.picture(std::move(figure));
  artefact.caption(
      "An oscillator with a stop ten times as stiff as its spring, from 3.2 rad/s down. Between the period "
      "doublings its motion of one period is unstable; the branches are motions of two and four periods.");
  report_rows(artefact, rows);
  artefact.more_data("branches", app::sweep_table(curve.sweep, true),
                     "Hz; displacements without unit; branch 0 is the curve itself");
  artefact.note(branches_text(curve));
  claim_count(artefact, curve, 2.97373, 2.2062, 1, "unstable between the period doublings",
              references::shooting);
}

}  // namespace wavebalance::cases

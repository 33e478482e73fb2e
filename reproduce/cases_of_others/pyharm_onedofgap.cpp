#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "comparison.hpp"
#include "figures.hpp"

namespace wavebalance::cases {
namespace {

/// The norm of all harmonics, the mean included, over the gap: what pyHarm's test compares.
double norm_over_gap(const Eigen::VectorXd& samples) {
  constexpr double gap = 10.0;
  const double mean = samples.mean();
  return std::sqrt(2.0 * samples.array().square().mean() - mean * mean) / gap;
}

std::vector<Row> pyharm_rows(const Curve& curve) {
  app::Time seven = curve.scene.time;
  seven.functions = 15;
  seven.quadrature_points = 1024;
  std::vector<Row> rows;
  for (const auto& [frequency, given] : references::pyharm_amplitudes) {
    const auto found = response_near(curve, frequency, norm_over_gap, given, seven);
    rows.push_back({"amplitude at " + report::number(frequency, 6) + " rad/s",
                    norm_over_gap(found.displacement()), given, references::pyharm_tolerance,
                    references::pyharm, 5});
  }
  rows.push_back({"amplitude at 2 rad/s, first point", rows[0].computed, references::pyharm_first, 1e-9,
                  references::pyharm, 10});
  return rows;
}

app::Figure pyharm_figure(const Curve& curve) {
  app::Panel panel = curve_panel(curve, "63 harmonics", 1.0, norm_over_gap);
  std::vector<double> x, y;
  for (const auto& [frequency, value] : references::pyharm_amplitudes) {
    x.push_back(frequency);
    y.push_back(value);
  }
  panel.add(published_points("pyHarm, 7 harmonics", x, y));
  panel.y.label = "Norm of all harmonics over the gap";
  return with_enlargement(std::move(panel), {5.4, 0.96, 7.2, 1.06});
}

}  // namespace

void pyharm_onedofgap(report::Artefact& artefact) {
  const Curve curve = followed(artefact, "pyharm_onedofgap.toml", 2.0 * std::numbers::pi);
  auto rows = pyharm_rows(curve);
  for (Row& row :
       compare(curve, references::pyharm_points, references::pyharm_point_tolerance, references::shooting))
    rows.push_back(std::move(row));
  artefact.data(curve_table(curve, norm_over_gap),
                "rad/s; displacements without unit; ordinate: norm of all harmonics over the gap");
  artefact.more_data("special_points", special_points_table(curve), "rad/s, without unit");
  artefact.picture(pyharm_figure(curve));
  artefact.caption(
      "An oscillator that meets a spring. Line: 63 harmonics, solid where stable; circles: pyHarm's reference "
      "solution of 7 harmonics, compared with 7 harmonics of this project.");
  report_rows(artefact, rows);
  artefact.note(
      "The damping is not legible in pyHarm's files. The first amplitude of its solution, which is not "
      "interpolated, is that of 5 % of critical damping to ten digits.");
  claim_count(artefact, curve, 5.55672, 5.7079, 1, "unstable between the period doublings",
              references::shooting);
}

}  // namespace wavebalance::cases

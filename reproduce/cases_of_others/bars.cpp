#include <vector>

#include "comparison.hpp"
#include "figures.hpp"
#include "wavebalance/app/results/tables.hpp"

namespace wavebalance::cases {
namespace {

void report_curve(report::Artefact& artefact, const Curve& curve, const std::vector<Row>& rows) {
  artefact.data(curve_table(curve), "Hz, m");
  artefact.more_data("special_points", special_points_table(curve), "Hz, m");
  app::Figure figure;
  figure.panel_width = 640;
  figure.panel_height = 460;
  figure.panels.push_back(curve_panel(curve, "63 harmonics", 1e3));
  figure.panels.back().y.label = "Largest tip displacement (mm)";
  figure.panels.back().mark_y(1e3 * curve.scene.contact.gap, "gap");
  artefact.picture(std::move(figure));
  report_rows(artefact, rows);
  if (curve.sweep.branches.empty()) return;
  artefact.more_data("branches", app::sweep_table(curve.sweep, true), "Hz, m; branch 0 is the curve itself");
  artefact.note(branches_text(curve));
}

}  // namespace

void small_gap_bar(report::Artefact& artefact) {
  const Curve curve = followed(artefact, "small_gap_bar.toml", 1.0);
  artefact.caption(
      "The bar of JL14 with the load of case 2, a quarter of its damping and a gap of 0.1 mm. The motion of one "
      "period loses its stability just after contact begins and has it between "
      "two period doublings. Branches are motions of two periods that begin at period doublings.");
  report_curve(artefact, curve,
               compare(curve, references::small_gap_points, references::bar_point_tolerance,
                       references::modal_shooting));
  claim_count(artefact, curve, 2840.48, 2988.74, 0, "stable between the period doublings",
              references::modal_shooting);
}

void lightly_damped_bar(report::Artefact& artefact) {
  const Curve curve = followed(artefact, "lightly_damped_bar.toml", 1.0);
  artefact.caption(
      "Case 2 of JL14 with a tenth of its damping. Beyond case 2's own folds there are two more where a second "
      "contact per period begins, and a pair of multipliers is outside the unit circle between two "
      "Neimark-Sacker points.");
  report_curve(artefact, curve,
               compare(curve, references::lightly_damped_points, references::bar_point_tolerance,
                       references::modal_shooting));
  claim_count(artefact, curve, 1312.443, 1378.5, 2, "a pair outside the unit circle between them",
              references::modal_shooting);
}

}  // namespace wavebalance::cases

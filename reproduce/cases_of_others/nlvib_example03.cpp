#include <fmt/format.h>

#include <numbers>
#include <vector>

#include "comparison.hpp"
#include "figures.hpp"

namespace wavebalance::cases {
namespace {

double fundamental(const Eigen::VectorXd& samples) { return harmonics(samples, 1)[1]; }

void append_harmonics(std::vector<Row>& rows, const Eigen::VectorXd& displacement, int functions,
                      const std::vector<references::KnownHarmonic>& known, const char* source) {
  const Eigen::VectorXd amplitudes = harmonics(displacement, 5);
  for (const auto& one : known)
    rows.push_back({fmt::format("harmonic {} of u1 at 0.7541 rad/s, {} functions", one.number, functions),
                    amplitudes[one.number], one.amplitude, one.tolerance, source, 7});
}

/// The displacements with NLvib's functions and points at its frequency, where a curve from the part in
/// contact ends. Newton's method alone does not find them, as the curve zigzags.
Eigen::VectorXd published_motion(report::Artefact& artefact) {
  const double end = references::nlvib_frequency / (2.0 * std::numbers::pi);
  const auto sweep = app::frequency_sweep(
      artefact.scene("nlvib_example03.toml",
                     {"time.functions=43", "time.quadrature_points=1024", "analysis.frequency_from=0.1",
                      fmt::format("analysis.frequency_to={:.17g}", end)}));
  if (!sweep.converged()) throw report::NotConverged("21 harmonics: " + sweep.status());
  return sweep.curve.points.back().unknown;
}

std::vector<Row> harmonic_rows(report::Artefact& artefact, const Curve& curve) {
  const auto& time = curve.scene.time;
  const auto exact = response_near(curve, references::nlvib_frequency, fundamental,
                                   references::nlvib_exact_harmonics[0].amplitude, time);
  std::vector<Row> rows;
  append_harmonics(rows, published_motion(artefact), 43, references::nlvib_harmonics, references::nlvib);
  append_harmonics(rows, exact.displacement(), time.functions, references::nlvib_exact_harmonics,
                   references::shooting);
  return rows;
}

app::Figure nlvib_figure(const Curve& curve) {
  app::Panel panel = curve_panel(curve, "127 harmonics", 1.0, fundamental);
  panel.add(published_points("NLvib, 21 harmonics", {references::nlvib_frequency},
                             {references::nlvib_harmonics[0].amplitude}));
  panel.y.label = "Fundamental harmonic of u1";
  return with_enlargement(std::move(panel), {0.735, 1.2, 0.757, 1.36});
}

}  // namespace

void nlvib_example03(report::Artefact& artefact) {
  const Curve curve = followed(artefact, "nlvib_example03.toml", 2.0 * std::numbers::pi);
  auto rows = harmonic_rows(artefact, curve);
  for (Row& row :
       compare(curve, references::nlvib_points, references::nlvib_point_tolerance, references::shooting))
    rows.push_back(std::move(row));
  artefact.data(curve_table(curve, fundamental),
                "rad/s; displacements without unit; ordinate: fundamental harmonic of u1");
  artefact.more_data("special_points", special_points_table(curve), "rad/s, without unit");
  artefact.picture(nlvib_figure(curve));
  artefact.caption(
      "Two masses, of which the first meets a spring. Line: 127 harmonics, solid where stable; square: a point "
      "of NLvib's curve. Motions of one period are unstable between the Neimark-Sacker points, between the "
      "first period doubling and the fold, and on the way back from there.");
  report_rows(artefact, rows);
  artefact.note(
      "With 1024 points, as NLvib takes, the curve zigzags, so that several motions have one frequency; the "
      "tolerance of NLvib's harmonics allows for that and for the four digits of its frequency. Its 21 harmonics "
      "are too few for the special points, for which 127 are taken here.");
  claim_count(artefact, curve, 0.6186, 0.5820, 2,
              "a pair is outside the unit circle between the Neimark-Sacker points", references::shooting);
}

}  // namespace wavebalance::cases

#include "curve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "wavebalance/app/drawing/stability_figure.hpp"
#include "wavebalance/app/results/tables.hpp"

namespace wavebalance::cases {
namespace {

/// Contact that lies between two samples has no force yet, so that its stability is not known.
bool is_counted(const solvers::PointStability& point) {
  return point.status == solvers::StabilityStatus::converged ||
         point.status == solvers::StabilityStatus::too_few_samples;
}

std::string frequency_column(const Curve& curve, const char* name) {
  return std::string(name) + (curve.unit == 1.0 ? "_Hz" : "_rad_per_s");
}

/// The samples at `frequency` (Hz) between two points of a curve; where it passes several times, those whose
/// ordinate is nearest to `value`. Empty where it does not pass.
Eigen::VectorXd interpolated(const std::vector<solvers::SweepPoint>& points, double frequency,
                             const Ordinate& ordinate, double value) {
  Eigen::VectorXd best;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const double before = points[i].frequency, after = points[i + 1].frequency;
    if (before == after || (before - frequency) * (after - frequency) > 0.0) continue;
    const double share = (frequency - before) / (after - before);
    Eigen::VectorXd samples = (1.0 - share) * points[i].unknown + share * points[i + 1].unknown;
    if (best.size() == 0 || std::abs(ordinate(samples) - value) < std::abs(ordinate(best) - value))
      best = std::move(samples);
  }
  return best;
}

/// The samples at every n-th point of a finer set.
Eigen::VectorXd thinned(const Eigen::VectorXd& samples, Eigen::Index points) {
  const Eigen::Index stride = samples.size() / points;
  return samples(Eigen::seqN(0, points, stride));
}

}  // namespace

Curve followed(report::Artefact& artefact, const std::string& file, double unit,
               const std::vector<std::string>& overrides) {
  Curve curve{artefact.scene(file, overrides), {}, {}, unit};
  curve.model = app::make_model(curve.scene);
  curve.sweep = app::frequency_sweep(curve.scene, curve.model);
  app::add_stability(curve.scene, curve.model, curve.sweep);
  const auto& points = curve.sweep.stability.points;
  const bool counted = std::all_of(points.begin(), points.end(), is_counted);
  if (!curve.sweep.converged() || !counted)
    throw report::NotConverged(
        file + ": " +
        (counted ? curve.sweep.status() : std::string(to_string(curve.sweep.stability.status()))));
  return curve;
}

Eigen::VectorXd harmonics(const Eigen::VectorXd& samples, int count) {
  const Eigen::Index points = samples.size();
  Eigen::VectorXd amplitudes(count + 1);
  for (int n = 0; n <= count; ++n) {
    const auto step = std::polar(1.0, -2.0 * std::numbers::pi * n / static_cast<double>(points));
    std::complex<double> sum = 0.0, turn = 1.0;
    for (Eigen::Index k = 0; k < points; ++k, turn *= step) sum += samples[k] * turn;
    amplitudes[n] = (n == 0 ? 1.0 : 2.0) * std::abs(sum) / static_cast<double>(points);
  }
  return amplitudes;
}

app::Response response_near(const Curve& curve, double frequency, const Ordinate& ordinate, double value,
                            const app::Time& time) {
  const double sought = frequency / curve.unit;
  const Eigen::VectorXd start = interpolated(curve.sweep.curve.points, sought, ordinate, value);
  const std::string place = report::number(frequency, 6) + " " + curve.unit_name();
  if (start.size() == 0) throw report::NotConverged("the curve does not pass " + place);
  app::Scene scene = curve.scene;
  scene.analysis.type = app::AnalysisType::forced_response;
  scene.forcing.frequency = sought;
  scene.time = time;
  app::ResponseOptions options;
  options.stability = true;
  options.structure_points = 1;
  options.guess = thinned(start, time.quadrature_points);
  app::Response response = app::weighted_residual_response(scene, curve.model, options);
  if (!response.converged) throw report::NotConverged(place + ": " + response.status);
  return response;
}

std::set<int> counts_between(const Curve& curve, double from, double to) {
  const double direction = to > from ? 1.0 : -1.0;
  const auto beyond = [&](const solvers::SweepPoint& point, double frequency) {
    return direction * (curve.unit * point.frequency - frequency) > 0.0;
  };
  const auto& points = curve.sweep.curve.points;
  std::set<int> counts;
  std::size_t i = 0;
  while (i < points.size() && !beyond(points[i], from)) ++i;
  for (; i < points.size() && !beyond(points[i], to); ++i)
    counts.insert(curve.sweep.stability.points[i].unstable);
  return counts;
}

app::Table curve_table(const Curve& curve, const Ordinate& ordinate) {
  const app::Table whole = app::sweep_table(curve.sweep);
  std::vector<double> frequency, value;
  for (const auto& point : curve.sweep.curve.points) {
    frequency.push_back(curve.unit * point.frequency);
    if (ordinate) value.push_back(ordinate(point.unknown));
  }
  app::Table table;
  table.add_column(frequency_column(curve, "frequency"), frequency)
      .add_column("max_displacement", whole.numbers("max_displacement_m"));
  if (ordinate) table.add_column("ordinate", value);
  return table.add_column("unstable", whole.numbers("unstable"))
      .add_column("contacts", whole.numbers("contacts"));
}

app::Table special_points_table(const Curve& curve) {
  app::Table table({"type", frequency_column(curve, "frequency"), frequency_column(curve, "bracket"),
                    "multiplier_real", "multiplier_imag", "max_displacement"});
  for (const auto& point : curve.sweep.stability.special_points)
    table.append_row({std::string(to_string(point.type)), curve.unit * point.frequency,
                      curve.unit * point.bracket, point.multiplier.real(), point.multiplier.imag(),
                      point.max_displacement});
  return table;
}

std::string branches_text(const Curve& curve) {
  std::string text;
  int number = 0;
  for (const auto& branch : curve.sweep.branches) {
    const auto& parent = branch.parent == 0
                             ? curve.sweep.stability
                             : curve.sweep.branches[static_cast<std::size_t>(branch.parent) - 1].stability;
    const auto& start = parent.special_points[static_cast<std::size_t>(branch.special_point)];
    const auto& points = branch.curve.points;
    if (points.empty()) continue;
    const auto [low, high] = std::minmax_element(
        points.begin(), points.end(), [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
    text += fmt::format(
        "{}Branch {} has motions of {} periods; it begins at {} {} and lies between {} and {}.",
        text.empty() ? "" : " ", ++number, branch.periods * curve.sweep.periods,
        report::number(curve.unit * start.frequency, 6), curve.unit_name(),
        report::number(curve.unit * low->frequency, 6), report::number(curve.unit * high->frequency, 6));
  }
  return text;
}

app::Panel curve_panel(const Curve& curve, const std::string& label, double scale, const Ordinate& ordinate) {
  app::Panel panel;
  panel.x.label = std::string("Frequency (") + curve.unit_name() + ")";
  std::vector<double> x, y;
  for (const auto& point : curve.sweep.curve.points) {
    x.push_back(curve.unit * point.frequency);
    y.push_back(scale * (ordinate ? ordinate(point.unknown) : point.max_displacement));
  }
  app::Series series(label, x, y);
  series.colour = app::Colour::blue;
  std::vector<app::PlacedPoint> marks;
  for (const auto& point : curve.sweep.stability.special_points)
    marks.push_back({point.type, curve.unit * point.frequency,
                     scale * (ordinate ? ordinate(point.unknown) : point.max_displacement)});
  app::draw_by_stability(panel, series, curve.sweep.stability.points, marks);
  if (!ordinate) app::draw_branches(panel, curve.sweep, curve.unit, scale);
  for (const auto& branch : curve.sweep.branches)
    for (const auto& point : branch.stability.special_points)
      if (!ordinate)
        marks.push_back({point.type, curve.unit * point.frequency, scale * point.max_displacement});
  app::draw_special_points(panel, marks);
  return panel;
}

app::Series published_points(const std::string& label, const std::vector<double>& x,
                             const std::vector<double>& y) {
  app::Series points(label, x, y, app::SeriesStyle::points);
  points.colour = app::Colour::vermillion;
  return points;
}

app::Figure with_enlargement(app::Panel panel, const app::Rectangle& part) {
  app::Figure figure;
  figure.columns = 2;
  figure.panel_width = 520;
  figure.panel_height = 460;
  panel.title = "response";
  app::Panel enlarged = panel;
  enlarged.title = "enlarged";
  enlarged.x.lower = part.x1;
  enlarged.x.upper = part.x2;
  enlarged.y.lower = part.y1;
  enlarged.y.upper = part.y2;
  figure.panels = {std::move(panel), std::move(enlarged)};
  return figure;
}

}  // namespace wavebalance::cases

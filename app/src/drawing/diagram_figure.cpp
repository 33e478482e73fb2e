#include "drawing/figures.hpp"

#include "wavebalance/app/files/quantity_text.hpp"

namespace wavebalance::app {
namespace {

constexpr double dot_size = 0.25;

Series dots(const std::string& label, Colour colour) {
  Series series = Series(label, SeriesStyle::points).in(colour);
  series.marker = 1;
  series.marker_size = dot_size;
  return series;
}

double reach_of(const Diagram& diagram) {
  double reach = 0.0;
  for (const DiagramValue& one : diagram.values)
    if (one.displacement.cols() > 0)
      reach = std::max(reach, one.displacement.row(diagram.place).cwiseAbs().maxCoeff());
  return reach;
}

/// A line of the exact curve, its unstable or its other parts.
Series exact_series(const ExactLine& line, bool unstable, double factor) {
  Series series = Series(unstable ? "exact, unstable" : "exact, stable", SeriesStyle::line)
                      .in(Colour::black, unstable ? Dash::dashed : Dash::solid);
  series.width = 1.2;
  const auto is_unstable = [&](std::size_t i) { return line.unstable[i] > 0; };
  for (std::size_t i = 0; i < line.value.size(); ++i) {
    const bool before = i > 0 && is_unstable(i - 1), after = i + 1 < line.value.size() && is_unstable(i + 1);
    const bool belongs = unstable ? is_unstable(i) || before || after : !is_unstable(i);
    series.append(line.value[i], belongs ? factor * line.displacement[i] : std::nan(""));
  }
  return series;
}

void add_section(Figure& figure, const Diagram& diagram) {
  const Scale scale = axis_scale(reach_of(diagram));
  const MotionPlace& place = diagram.places[std::size_t(diagram.place)];
  Panel& panel = figure.add_panel("Poincaré section of " + plain(place.name), diagram.axis.label(),
                                  "Displacement (" + scale.prefix + place.unit + ")");
  Series there = dots("forward", Colour::blue), back = dots("backward", Colour::orange);
  for (const DiagramValue& one : diagram.values)
    for (int k = 0; k < points_shown(one); ++k)
      (one.forwards ? there : back).append(one.value, scale.factor * one.displacement(diagram.place, k));
  panel.add(std::move(back));
  panel.add(std::move(there));
  for (const ExactLine& line : diagram.exact)
    for (const bool unstable : {false, true}) panel.add(exact_series(line, unstable, scale.factor));
}

void add_periods(Figure& figure, const Diagram& diagram) {
  Panel& panel =
      figure.add_panel("Period of the motion in forcing periods (0: none)", diagram.axis.label(), "Periods");
  panel.y.lower = -0.5;
  Series there = dots("forward", Colour::blue), back = dots("backward", Colour::orange);
  int most = 1;
  for (const DiagramValue& one : diagram.values) {
    if (!one.failure.empty()) continue;
    (one.forwards ? there : back).append(one.value, one.period);
    most = std::max(most, one.period);
  }
  panel.y.upper = most + 0.5;
  for (Series* series : {&back, &there}) {
    series->marker_size = 2.0 * dot_size;
    panel.add(std::move(*series));
  }
}

/// The invariant curve in the section of the leading place.
Series curve_series(const RecordedMotion& motion, double length, double speed) {
  constexpr int parts = 400;
  Series series = Series("invariant curve", SeriesStyle::line).in(Colour::orange);
  for (int k = 0; k <= parts; ++k) {
    const Eigen::VectorXd point = motion.curve.at(double(k) / parts);
    series.append(length * point[motion.leading],
                  speed * point[Eigen::Index(motion.places.size()) + motion.leading]);
  }
  return series;
}

/// The largest and the least displacement over all recorded periods.
void add_envelope(Figure& figure, const Diagram& diagram) {
  const MotionPlace& place = diagram.places[std::size_t(diagram.place)];
  double reach = 0.0;
  for (const DiagramValue& one : diagram.values)
    if (one.failure.empty())
      reach = std::max({reach, std::abs(one.highest[diagram.place]), std::abs(one.lowest[diagram.place])});
  const Scale scale = axis_scale(reach);
  Panel& panel = figure.add_panel("Largest and least displacement of " + plain(place.name),
                                  diagram.axis.label(), "Displacement (" + scale.prefix + place.unit + ")");
  Series repeats = dots("periodic", Colour::black), turns = dots("quasi-periodic", Colour::green),
         others = dots("other", Colour::vermillion);
  for (const DiagramValue& one : diagram.values) {
    if (!one.failure.empty()) continue;
    Series& series = one.period > 0 ? repeats : one.is_quasi_periodic() ? turns : others;
    series.append(one.value, scale.factor * one.highest[diagram.place]);
    series.append(one.value, scale.factor * one.lowest[diagram.place]);
  }
  for (Series* series : {&repeats, &turns, &others})
    if (!series->x.empty()) {
      series->marker_size = 2.0 * dot_size;
      panel.add(std::move(*series));
    }
}

}  // namespace

Figure diagram_figure(const Diagram& diagram) {
  Figure figure;
  if (diagram.values.empty()) return figure;
  figure.title = "bifurcation diagram";
  if (diagram.status == "interrupted" || diagram.status == "incomplete")
    figure.title += " (INCOMPLETE: " + diagram.status + ")";
  figure.panel_width = 660;
  figure.panel_height = 380;
  add_section(figure, diagram);
  add_envelope(figure, diagram);
  add_periods(figure, diagram);
  return figure;
}

std::vector<Panel> recorded_panels(const RecordedMotion& motion) {
  const MotionPlace& place = motion.places[std::size_t(motion.leading)];
  const Eigen::RowVectorXd u = motion.displacement.row(motion.leading),
                           v = motion.velocity.row(motion.leading);
  const Scale length = axis_scale(u.cwiseAbs().maxCoeff()), speed = axis_scale(v.cwiseAbs().maxCoeff());
  Figure figure;
  Panel& section = figure.add_panel("Poincaré section of " + plain(place.name),
                                    "Displacement (" + length.prefix + place.unit + ")",
                                    "Velocity (" + speed.prefix + place.unit + "/s)");
  Series points = dots("", Colour::blue);
  for (Eigen::Index k = 0; k < u.size(); ++k) points.append(length.factor * u[k], speed.factor * v[k]);
  if (motion.kind == MotionKind::quasi_periodic) {
    points.label = "points";
    section.add(curve_series(motion, length.factor, speed.factor));
  }
  section.add(std::move(points));
  Panel& spectrum = figure.add_panel("Power spectral density of " + plain(place.name), "Frequency (Hz)",
                                     "Density (" + place.unit + "^2/Hz)");
  spectrum.y.logarithmic = true;
  if (motion.leading < motion.spectrum.density.rows())
    spectrum.add({"", motion.spectrum.frequency,
                  Eigen::VectorXd(motion.spectrum.density.row(motion.leading).transpose())});
  return std::move(figure.panels);
}

}  // namespace wavebalance::app

#include "drawing/output_figure.hpp"

#include <algorithm>
#include <cmath>

#include "drawing/sweep_lines.hpp"
#include "plot/unit_prefix.hpp"

namespace wavebalance::app {
namespace {

double largest_of(const std::vector<double>& values, double so_far) {
  for (const double value : values) so_far = std::fmax(so_far, value);
  return so_far;
}

/// The vibration of an output along one curve.
void add_line(Panel& panel, const SweepLine& line, std::size_t output, double factor) {
  if (line.curve.points.empty()) return;
  const bool unstable = line.is_unstable();
  Series series = line.series(line.name, line.vibration(output), factor);
  if (line.name.empty() && unstable) series.label = "stable";
  if (!unstable || series.x.size() < 2) {
    panel.add(std::move(series));
    return;
  }
  std::vector<bool> marks;
  for (const auto& point : line.stability.points) marks.push_back(point.unstable > 0);
  auto [solid, dashed] = parts_by_stability(series, marks);
  if (line.name.empty()) dashed.label = "unstable";
  panel.add(std::move(solid));
  if (!dashed.x.empty()) panel.add(std::move(dashed));
}

/// The multiple of the unit in which the vibration along all curves is readable.
Scale scale_of(const std::vector<SweepLine>& lines, std::optional<std::size_t> output) {
  double largest = 0.0;
  for (const SweepLine& line : lines) largest = largest_of(line.vibration(output), largest);
  return axis_scale(largest);
}

/// Special points of a curve that is drawn: those of outputs between its points beside them.
std::vector<PlacedPoint> placed_on(const Series& drawn, const SweepLine& line, bool of_output,
                                   double factor) {
  return line.placed([&](const solvers::SpecialPoint& one) {
    const std::size_t next = std::min(one.next_point, drawn.y.size() - 1), before = next == 0 ? 0 : next - 1;
    return of_output ? 0.5 * (drawn.y[before] + drawn.y[next]) : factor * one.vibration;
  });
}

void draw_vibrations(Panel& panel, const std::vector<SweepLine>& lines, std::optional<std::size_t> output,
                     double factor) {
  std::vector<PlacedPoint> marks;
  for (const SweepLine& line : lines) {
    if (line.curve.points.empty()) continue;
    const bool main = line.name.empty();
    const Series drawn = line.series(main ? "half peak to peak" : line.name, line.vibration(output), factor);
    const std::vector<PlacedPoint> special = placed_on(drawn, line, output.has_value(), factor);
    draw_by_stability(panel, drawn, line.stability.points, special);
    marks.insert(marks.end(), special.begin(), special.end());
    if (!main) continue;
    Series rms = line.series("rms without mean", line.vibration(output, true), factor);
    rms.colour = Colour::orange;
    draw_by_stability(panel, rms, line.stability.points, {});
  }
  draw_special_points(panel, marks);
}

Figure empty_figure(const std::string& title, std::size_t outputs) {
  Figure figure;
  figure.title = title;
  figure.panel_width = 600;
  figure.panel_height = 250;
  if (outputs > most_drawn_outputs)
    figure.title += ", the first " + std::to_string(most_drawn_outputs) + " of " + std::to_string(outputs);
  return figure;
}

}  // namespace

void scale_amplitudes(Figure& figure, const SweepAxis& axis) {
  if (axis.quantity == "frequency" || (axis.unit != "N" && axis.unit != "m")) return;
  double largest = 0.0;
  for (const Panel& panel : figure.panels)
    for (const Series& series : panel.series) largest = largest_of(series.x, largest);
  const Scale scale = axis_scale(largest);
  SweepAxis scaled = axis;
  scaled.unit = scale.prefix + axis.unit;
  for (Panel& panel : figure.panels) {
    panel.x.label = scaled.label();
    for (Series& series : panel.series)
      for (double& x : series.x) x *= scale.factor;
  }
}

Panel vibration_panel(const Sweep& sweep, const SweepOutputs& outputs, std::optional<std::size_t> output) {
  const std::vector<SweepLine> lines = lines_of(sweep, outputs);
  const Scale scale = scale_of(lines, output);
  Panel panel;
  panel.title =
      "Vibration of " + (output ? plain(outputs.outputs[*output].title) : std::string("the contacts"));
  panel.x.label = sweep_axis(sweep).label();
  panel.y.label =
      "Vibration (" + scale.prefix + (output ? outputs.outputs[*output].unit : std::string("m")) + ")";
  panel.y.lower = 0.0;
  draw_vibrations(panel, lines, output, scale.factor);
  return panel;
}

Figure outputs_figure(const Sweep& sweep, const SweepOutputs& outputs) {
  Figure figure =
      empty_figure("Vibration of each output, half its peak-to-peak value", outputs.outputs.size());
  const std::vector<SweepLine> lines = lines_of(sweep, outputs);
  for (std::size_t i = 0; i < std::min(outputs.outputs.size(), most_drawn_outputs); ++i) {
    const Scale scale = scale_of(lines, i);
    Panel& panel = figure.add_panel(plain(outputs.outputs[i].title));
    panel.x.label = sweep_axis(sweep).label();
    panel.y.label = "Vibration (" + scale.prefix + outputs.outputs[i].unit + ")";
    panel.y.lower = 0.0;
    for (const SweepLine& line : lines) add_line(panel, line, i, scale.factor);
  }
  scale_amplitudes(figure, sweep_axis(sweep));
  return figure;
}

Figure outputs_figure(const std::vector<Output>& outputs, const Eigen::MatrixXd& motion,
                      const PeriodWindow& window) {
  Figure figure = empty_figure("Motion of each output", outputs.size());
  for (std::size_t i = 0; i < std::min(outputs.size(), most_drawn_outputs); ++i) {
    const auto row = motion.row(Eigen::Index(i));
    const Scale scale = axis_scale(row.cwiseAbs().maxCoeff());
    Panel& panel = figure.add_panel(plain(outputs[i].title));
    panel.x = window.axis();
    panel.y.label = "Displacement (" + scale.prefix + outputs[i].unit + ")";
    Series series = window.curve(scale.factor * row.transpose());
    series.colour = Colour::blue;
    panel.add(std::move(series));
  }
  return figure;
}

}  // namespace wavebalance::app

#include "drawing/output_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/sweep_axis.hpp"
#include "plot/unit_prefix.hpp"
#include "wavebalance/app/analysis/measures.hpp"
#include "wavebalance/app/drawing/stability_figure.hpp"

namespace wavebalance::app {
namespace {

std::vector<double> vibrations(const std::vector<MeasuredPoint>& points, std::size_t output) {
  std::vector<double> values;
  for (const MeasuredPoint& point : points)
    values.push_back(point.empty() ? std::nan("") : point[output].half_peak_to_peak());
  return values;
}

double largest_of(const std::vector<double>& values, double so_far) {
  for (const double value : values) so_far = std::fmax(so_far, value);
  return so_far;
}

/// One curve of one output in its panel.
struct Line {
  std::string label;
  const solvers::FrequencySweep* curve;
  StabilityAlong stability;
  std::vector<double> values;
  Colour colour;
};

std::vector<Line> lines_of(const Sweep& sweep, const SweepOutputs& outputs, std::size_t output) {
  constexpr std::array colours{Colour::green, Colour::vermillion, Colour::purple, Colour::sky_blue};
  std::vector<Line> lines{
      {"", &sweep.curve, sweep.stability_of(0), vibrations(outputs.curves[0], output), Colour::blue}};
  for (std::size_t i = 0; i < sweep.branches.size(); ++i)
    lines.push_back({"branch " + std::to_string(i + 1), &sweep.branches[i].curve, sweep.stability_of(i + 1),
                     vibrations(outputs.curves[i + 1], output), colours[i % colours.size()]});
  for (std::size_t i = 0; i < sweep.isolas.size(); ++i)
    lines.push_back({"isola " + std::to_string(i + 1), &sweep.isolas[i].curve,
                     sweep.isolas[i].stability_of(0), vibrations(outputs.isolas[i], output),
                     colours[(sweep.branches.size() + i) % colours.size()]});
  return lines;
}

void add_line(Panel& panel, const Line& line, double factor) {
  if (line.curve->points.empty()) return;
  Series series;
  series.label = line.label;
  series.colour = line.colour;
  for (std::size_t i = 0; i < line.values.size(); ++i) {
    series.x.push_back(parameter_of(line.curve->points[i], line.curve->parameter));
    series.y.push_back(factor * line.values[i]);
  }
  const bool unstable = std::any_of(line.stability.points.begin(), line.stability.points.end(),
                                    [](const auto& point) { return point.unstable > 0; });
  if (series.label.empty() && unstable) series.label = "stable";
  if (!unstable || series.x.size() < 2) {
    panel.add(std::move(series));
    return;
  }
  std::vector<bool> marks;
  for (const auto& point : line.stability.points) marks.push_back(point.unstable > 0);
  auto [solid, dashed] = parts_by_stability(series, marks);
  if (line.label.empty()) dashed.label = "unstable";
  panel.add(std::move(solid));
  if (!dashed.x.empty()) panel.add(std::move(dashed));
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

Figure outputs_figure(const Sweep& sweep, const SweepOutputs& outputs) {
  Figure figure =
      empty_figure("Vibration of each output, half its peak-to-peak value", outputs.outputs.size());
  for (std::size_t i = 0; i < std::min(outputs.outputs.size(), most_drawn_outputs); ++i) {
    const std::vector<Line> lines = lines_of(sweep, outputs, i);
    double largest = 0.0;
    for (const Line& line : lines) largest = largest_of(line.values, largest);
    const Scale scale = axis_scale(largest);
    Panel& panel = figure.add_panel(plain(outputs.outputs[i].title));
    panel.x.label = sweep_axis(sweep).label();
    panel.y.label = "Vibration (" + scale.prefix + outputs.outputs[i].unit + ")";
    panel.y.lower = 0.0;
    for (const Line& line : lines) add_line(panel, line, scale.factor);
  }
  return figure;
}

Figure outputs_figure(const std::vector<Output>& outputs, const Eigen::MatrixXd& motion, int periods) {
  Figure figure = empty_figure("Motion of each output", outputs.size());
  const auto points = motion.cols();
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(points + 1, 0.0, 1.0);
  for (std::size_t i = 0; i < std::min(outputs.size(), most_drawn_outputs); ++i) {
    const auto row = motion.row(Eigen::Index(i));
    const Scale scale = axis_scale(row.cwiseAbs().maxCoeff());
    Eigen::VectorXd values(points + 1);
    values << scale.factor * row.transpose(), scale.factor * row[0];
    Panel& panel = figure.add_panel(plain(outputs[i].title));
    panel.x = {.label = periods == 1
                            ? "Time (fraction of a period)"
                            : "Time (fraction of " + std::to_string(periods) + " periods of the load)",
               .lower = 0.0,
               .upper = 1.0,
               .ticks = {},
               .tick_format = "%.1f"};
    panel.y.label = "Displacement (" + scale.prefix + outputs[i].unit + ")";
    Series series("", time, values);
    series.colour = Colour::blue;
    panel.add(std::move(series));
  }
  return figure;
}

}  // namespace wavebalance::app

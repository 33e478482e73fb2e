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

/// The curves of a sweep, of an output or of its contacts.
class VibrationCurves {
 public:
  VibrationCurves(const Sweep& sweep, const SweepOutputs& outputs, std::optional<std::size_t> output)
      : sweep_(sweep), outputs_(outputs), output_(output) {
    double largest = 0.0;
    for (std::size_t number = 0; number <= sweep.branches.size(); ++number)
      largest = largest_of(values(curve(number), measured(number), false), largest);
    for (std::size_t i = 0; i < sweep.isolas.size(); ++i)
      largest = largest_of(values(sweep.isolas[i].curve, measured_isola(i), false), largest);
    scale_ = axis_scale(largest);
  }

  const Scale& scale() const { return scale_; }

  void draw(Panel& panel) {
    draw_one(panel, "half peak to peak", sweep_, 0, Colour::blue, measured(0));
    Series rms = series("rms without mean", sweep_.curve, measured(0), true, Colour::orange);
    draw_by_stability(panel, rms, sweep_.stability_of(0).points, {});
    constexpr std::array colours{Colour::green, Colour::vermillion, Colour::purple, Colour::sky_blue};
    for (std::size_t i = 0; i < sweep_.branches.size(); ++i)
      draw_one(panel, "branch " + std::to_string(i + 1), sweep_, i + 1, colours[i % colours.size()],
               measured(i + 1));
    for (std::size_t i = 0; i < sweep_.isolas.size(); ++i)
      draw_one(panel, "isola " + std::to_string(i + 1), sweep_.isolas[i], 0,
               colours[(sweep_.branches.size() + i) % colours.size()], measured_isola(i));
    draw_special_points(panel, marks_);
  }

 private:
  using Measured = const std::vector<MeasuredPoint>*;

  const solvers::FrequencySweep& curve(std::size_t number) const {
    return number == 0 ? sweep_.curve : sweep_.branches[number - 1].curve;
  }
  Measured measured(std::size_t number) const { return output_ ? &outputs_.curves[number] : nullptr; }
  Measured measured_isola(std::size_t i) const { return output_ ? &outputs_.isolas[i] : nullptr; }

  std::vector<double> values(const solvers::FrequencySweep& curve, Measured measured, bool rms) const {
    std::vector<double> all;
    for (std::size_t i = 0; i < curve.points.size(); ++i)
      if (measured == nullptr)
        all.push_back(rms ? curve.points[i].rms_vibration : curve.points[i].vibration);
      else if (i >= measured->size() || (*measured)[i].empty())
        all.push_back(std::nan(""));
      else
        all.push_back(rms ? (*measured)[i][*output_].rms : (*measured)[i][*output_].half_peak_to_peak());
    return all;
  }

  Series series(const std::string& label, const solvers::FrequencySweep& curve, Measured measured, bool rms,
                Colour colour) const {
    Series drawn;
    drawn.label = label;
    drawn.colour = colour;
    for (const auto& point : curve.points) drawn.x.push_back(parameter_of(point, curve.parameter));
    for (const double value : values(curve, measured, rms)) drawn.y.push_back(scale_.factor * value);
    return drawn;
  }

  /// Where special points lie: those of outputs between the points of the curve beside them.
  std::vector<PlacedPoint> placed(const Series& drawn, const std::vector<solvers::SpecialPoint>& points,
                                  solvers::SweepParameter parameter) const {
    std::vector<PlacedPoint> marks;
    for (const solvers::SpecialPoint& one : points) {
      const std::size_t next = std::min(one.next_point, drawn.y.size() - 1),
                        before = next == 0 ? 0 : next - 1;
      const double y = output_ ? 0.5 * (drawn.y[before] + drawn.y[next]) : scale_.factor * one.vibration;
      marks.push_back({one.type, parameter_of(one, parameter), y});
    }
    return marks;
  }

  void draw_one(Panel& panel, const std::string& label, const Sweep& sweep, std::size_t number, Colour colour,
                Measured measured) {
    const bool main = number == 0;
    const solvers::FrequencySweep& curve = main ? sweep.curve : sweep.branches[number - 1].curve;
    if (curve.points.empty()) return;
    const Series drawn = series(label, curve, measured, false, colour);
    const std::vector<PlacedPoint> special =
        placed(drawn, (main ? sweep.stability : sweep.branches[number - 1].stability).special_points,
               curve.parameter);
    draw_by_stability(panel, drawn, sweep.stability_of(number).points, special);
    marks_.insert(marks_.end(), special.begin(), special.end());
  }

  const Sweep& sweep_;
  const SweepOutputs& outputs_;
  std::optional<std::size_t> output_;
  Scale scale_;
  std::vector<PlacedPoint> marks_;
};

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
  VibrationCurves curves(sweep, outputs, output);
  Panel panel;
  panel.title =
      "Vibration of " + (output ? plain(outputs.outputs[*output].title) : std::string("the contacts"));
  panel.x.label = sweep_axis(sweep).label();
  panel.y.label = "Vibration (" + curves.scale().prefix +
                  (output ? outputs.outputs[*output].unit : std::string("m")) + ")";
  panel.y.lower = 0.0;
  curves.draw(panel);
  return panel;
}

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

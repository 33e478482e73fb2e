#include "drawing/figures.hpp"

#include <fmt/format.h>

#include "plot/plot_parts.hpp"
#include "wavebalance/app/files/quantity_text.hpp"

namespace wavebalance::app {
namespace {

double largest_of(const std::vector<double>& values, double so_far) {
  for (const double value : values) so_far = std::fmax(so_far, value);
  return so_far;
}

/// The stable part of a curve that has none, the series `first` of two, which the legend would name.
void leave_out_unseen(Panel& panel, std::size_t first) {
  if (panel.series.size() < first + 2) return;
  if (std::ranges::none_of(panel.series[first].y, [](double y) { return std::isfinite(y); }))
    panel.series.erase(panel.series.begin() + std::ptrdiff_t(first));
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
  const std::size_t first = panel.series.size();
  panel.add(std::move(solid));
  if (!dashed.x.empty()) panel.add(std::move(dashed));
  leave_out_unseen(panel, first);
}

/// The multiple of the unit in which the vibration along all curves is readable.
Scale scale_of(const std::vector<SweepLine>& lines, std::optional<std::size_t> output,
               const std::string& unit) {
  double largest = 0.0;
  for (const SweepLine& line : lines) largest = largest_of(line.vibration(output), largest);
  return axis_scale(largest, unit);
}

/// "Velocity (mm/s)", "Transmissibility".
std::string ordinate(const Output& output, const Scale& scale, const std::string& of_displacement) {
  const std::string words = output.quantity_words(of_displacement);
  return output.unit.empty() ? words : words + " (" + scale.prefix + output.unit + ")";
}

/// Bifurcation and grazing points of a curve that is drawn: for outputs on the line between the
/// neighbouring points, at its middle where the curve turns.
std::vector<PlacedPoint> placed_on(const Series& drawn, const SweepLine& line, bool of_output,
                                   double factor) {
  return line.placed([&](const solvers::SpecialPoint& one) {
    const std::size_t next = std::min(one.next_point, drawn.y.size() - 1), before = next == 0 ? 0 : next - 1;
    if (!of_output) return factor * one.vibration;
    const double part =
        (parameter_of(one, line.curve.parameter) - drawn.x[before]) / (drawn.x[next] - drawn.x[before]);
    return std::lerp(drawn.y[before], drawn.y[next], part >= 0.0 && part <= 1.0 ? part : 0.5);
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
    const std::size_t before = panel.series.size();
    draw_by_stability(panel, drawn, line.stability.points, special);
    leave_out_unseen(panel, before);
    marks.insert(marks.end(), special.begin(), special.end());
    if (!main) continue;
    Series rms = line.series("rms without mean", line.vibration(output, true), factor);
    rms.colour = Colour::orange;
    const std::size_t first = panel.series.size();
    draw_by_stability(panel, rms, line.stability.points, {});
    leave_out_unseen(panel, first);
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

/// The amplitudes of the harmonics of an output along the curve, where there are several.
void add_harmonics(Figure& figure, const Sweep& sweep, const SweepLine& line, const Output& output,
                   std::size_t index) {
  constexpr int most = 5;
  constexpr double rounding = 1e-9;  // of the largest; such harmonics are zero
  double largest = 0.0;
  std::vector<std::vector<double>> amplitudes;
  for (int n = 1; n <= most; ++n) {
    amplitudes.push_back(line.harmonic(index, n));
    if (std::ranges::none_of(amplitudes.back(), [](double one) { return std::isfinite(one); })) break;
    largest = largest_of(amplitudes.back(), largest);
  }
  if (amplitudes.size() < 3) return;  // the last is none, or the most
  const Scale scale = axis_scale(largest, output.unit);
  Panel& panel = figure.add_panel("Harmonics of " + plain(output.title), sweep_axis(sweep).label(),
                                  ordinate(output, scale, "Amplitude"));
  panel.y.lower = 0.0;
  for (std::size_t n = 0; n < amplitudes.size(); ++n)
    if (Series series = line.series("harmonic " + std::to_string(n + 1), amplitudes[n], scale.factor);
        largest_of(series.y, 0.0) > rounding * scale.factor * largest) {
      series.colour = Colour::automatic;
      panel.add(std::move(series));
    }
}

/// Those with the largest values, at most `most`, in their order.
std::vector<Series> largest_series(std::vector<Series> all, std::size_t most) {
  std::vector<std::pair<double, std::size_t>> sizes;
  for (std::size_t i = 0; i < all.size(); ++i) sizes.emplace_back(-largest_of(all[i].y, 0.0), i);
  std::ranges::sort(sizes);
  sizes.resize(std::min(sizes.size(), most));
  std::ranges::sort(sizes, {}, &std::pair<double, std::size_t>::second);
  std::vector<Series> kept;
  for (const auto& [size, i] : sizes) kept.push_back(std::move(all[i]));
  return kept;
}

/// A value of each contact along the main curve, in a panel with the contacts in its legend.
void add_contact_panel(Figure& figure, const Sweep& sweep, const std::vector<SceneContact>& contacts,
                       const std::string& title, const std::string& quantity, const std::string& unit,
                       const std::function<double(std::size_t point, std::size_t contact)>& value) {
  constexpr std::size_t most = 7;  // colours
  std::vector<Series> drawn;
  double largest = 0.0;
  for (std::size_t k = 0; k < contacts.size(); ++k) {
    if (contacts[k].place > 0) continue;
    Series series(plain(whole_name_of(contacts[k])), SeriesStyle::line);
    for (std::size_t i = 0; i < sweep.curve.points.size(); ++i)
      series.append(parameter_of(sweep.curve.points[i], sweep.curve.parameter), value(i, k));
    if (std::ranges::none_of(series.y, [](double one) { return std::isfinite(one); })) continue;
    largest = largest_of(series.y, largest);
    drawn.push_back(std::move(series));
  }
  if (!(largest > 0.0)) return;
  const bool cubic = unit.starts_with("m^3");  // whose prefixes would be cubed
  const Scale scale = cubic ? Scale() : axis_scale(largest);
  const std::size_t all = drawn.size();
  drawn = largest_series(std::move(drawn), most);
  Panel& panel = figure.add_panel(
      all > drawn.size() ? fmt::format("{}, the {} largest of {}", title, drawn.size(), all) : title,
      sweep_axis(sweep).label(), quantity + " (" + scale.prefix + unit + ")");
  panel.y.lower = 0.0;
  for (Series& series : drawn) {
    for (double& y : series.y) y *= scale.factor;
    panel.add(std::move(series));
  }
}

/// Work and wear of friction, or speeds of impacts, of each contact along the main curve.
void add_each_contact(Figure& figure, const Sweep& sweep, const std::vector<SceneContact>& contacts) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto friction = [&](std::size_t i, std::size_t k) -> const ContactFriction* {
    if (sweep.friction.empty() || i >= sweep.friction.front().size()) return nullptr;
    const std::vector<ContactFriction>& each = sweep.friction.front()[i].each;
    const auto found = std::ranges::find(each, contacts[k].number, &ContactFriction::number);
    return found == each.end() ? nullptr : &*found;
  };
  add_contact_panel(figure, sweep, contacts, "Energy dissipated by friction per period", "Work", "J",
                    [&](std::size_t i, std::size_t k) {
                      const ContactFriction* one = friction(i, k);
                      return one == nullptr ? none : one->work;
                    });
  add_contact_panel(figure, sweep, contacts, "Wear", "Wear", "m^3/s", [&](std::size_t i, std::size_t k) {
    const ContactFriction* one = friction(i, k);
    return one == nullptr || !one->wears ? none : one->wear * sweep.curve.points[i].frequency / sweep.periods;
  });
  add_contact_panel(figure, sweep, contacts, "Speed of impacts", "Largest speed", "m/s",
                    [&](std::size_t i, std::size_t k) {
                      if (sweep.impacts.empty() || i >= sweep.impacts.front().size()) return none;
                      const std::vector<double>& speeds = sweep.impacts.front()[i].speeds;
                      return k < speeds.size() ? speeds[k] : 0.0;
                    });
}

}  // namespace

std::string vibration_title(const Output& output) {
  return output.names_quantity() ? capitalised(plain(output.title)) : "Vibration of " + plain(output.title);
}

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

Panel vibration_panel(const Sweep& sweep, const SweepOutputs& outputs, std::optional<std::size_t> output,
                      const std::string& of_contacts) {
  const std::vector<SweepLine> lines = lines_of(sweep, outputs);
  const Output* drawn = output ? &outputs.outputs[*output] : nullptr;
  const Scale scale = scale_of(lines, output, drawn == nullptr ? of_contacts : drawn->unit);
  Panel panel;
  panel.title = drawn == nullptr ? "Vibration of the contacts" : vibration_title(*drawn);
  panel.x.label = sweep_axis(sweep).label();
  panel.y.label = drawn == nullptr ? "Vibration (" + scale.prefix + of_contacts + ")"
                                   : ordinate(*drawn, scale, "Vibration");
  panel.y.lower = 0.0;
  draw_vibrations(panel, lines, output, scale.factor);
  return panel;
}

Figure outputs_figure(const Sweep& sweep, const SweepOutputs& outputs,
                      const std::vector<SceneContact>& contacts) {
  Figure figure =
      empty_figure("Outputs along the curve (vibration: half peak to peak)", outputs.outputs.size());
  const std::vector<SweepLine> lines = lines_of(sweep, outputs);
  for (std::size_t i = 0; i < std::min(outputs.outputs.size(), most_drawn_outputs); ++i) {
    const Scale scale = scale_of(lines, i, outputs.outputs[i].unit);
    Panel& panel = figure.add_panel(plain(outputs.outputs[i].title), sweep_axis(sweep).label(),
                                    ordinate(outputs.outputs[i], scale, "Vibration"));
    panel.y.lower = 0.0;
    for (const SweepLine& line : lines) add_line(panel, line, i, scale.factor);
  }
  for (std::size_t i = 0; i < std::min(outputs.outputs.size(), most_drawn_harmonics); ++i)
    if (!outputs.outputs[i].is_contact()) add_harmonics(figure, sweep, lines.front(), outputs.outputs[i], i);
  if (!outputs.outputs.front().is_contact()) add_each_contact(figure, sweep, contacts);
  scale_amplitudes(figure, sweep_axis(sweep));
  return figure;
}

Figure outputs_figure(const std::vector<Output>& outputs, const Eigen::MatrixXd& motion,
                      const PeriodWindow& window) {
  Figure figure = empty_figure("Motion of the outputs", outputs.size());
  for (std::size_t i = 0; i < std::min(outputs.size(), most_drawn_outputs); ++i) {
    const auto row = motion.row(Eigen::Index(i));
    const Scale scale = axis_scale(row.cwiseAbs().maxCoeff(), outputs[i].unit);
    Panel& panel = figure.add_panel(plain(outputs[i].title), "", ordinate(outputs[i], scale, "Displacement"));
    panel.x = window.axis();
    panel.add(window.curve(scale.factor * row.transpose()).in(Colour::blue));
  }
  return figure;
}

}  // namespace wavebalance::app

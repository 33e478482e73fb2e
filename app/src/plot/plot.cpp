#include "wavebalance/app/plot/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plot/plot_parts.hpp"

namespace wavebalance::app {
namespace {

std::string terminal(const Figure& figure, PictureFormat format) {
  const FigureLayout layout(figure);
  const auto size = [&](int scale) {
    return std::to_string(scale * layout.width) + "," + std::to_string(scale * layout.height);
  };
  if (format == PictureFormat::svg)
    return "set terminal svg enhanced background rgb 'white' font 'Arial,13.5' size " + size(1) + "\n";
  // Twice the resolution; the older png terminal where gnuplot was built without cairo.
  return "if (strstrt(GPVAL_TERMINALS, 'pngcairo') > 0) {\n"
         "  set terminal pngcairo enhanced font 'DejaVu Sans,10' fontscale 2 linewidth 2 pointscale 2 size " +
         size(2) + "\n} else {\n  set terminal png enhanced truecolor font ',10' linewidth 2 size " +
         size(2) + "\n}\n";
}

/// The lowest and the highest ordinate of the axis: its limits, or the limits of the curves.
std::pair<double, double> range_of(const Panel& panel) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Series& series : panel.series)
    for (const double y : series.y)
      if (std::isfinite(y)) {
        low = std::min(low, y);
        high = std::max(high, y);
      }
  return {panel.y.lower.value_or(low), panel.y.upper.value_or(high)};
}

}  // namespace

Panel& Panel::mark_x(double x_value) {
  segments.push_back({x_value, {}, x_value, {}, false, Dash::dotted, Colour::grey, 1.2});
  return *this;
}

Panel& Panel::mark_y(double y_value, const std::string& label) {
  segments.push_back({{}, y_value, {}, y_value, false, Dash::dotted, Colour::grey, 1.2, label});
  return *this;
}

Panel& Panel::mark_level(double y_value, const std::string& label, const std::string& value) {
  constexpr double near = 0.5, margin = 0.05;  // of the range
  const auto [low, high] = range_of(*this);
  if (!(low <= high)) return mark_y(y_value, label);
  const double range = high - low;
  if (y_value < low - near * range || y_value > high + near * range) {
    title += fmt::format("{}{} {}, outside of the axis", title.empty() ? "" : ", ", label, value);
    return *this;
  }
  if (y_value < low) y.lower = y_value - margin * range;
  if (y_value > high) y.upper = y_value + margin * range;
  return mark_y(y_value, label);
}

Panel& Figure::add_panel(std::string panel_title, std::string x_label, std::string y_label) {
  Panel& panel = panels.emplace_back();
  panel.title = std::move(panel_title);
  panel.x.label = std::move(x_label);
  panel.y.label = std::move(y_label);
  return panel;
}

std::string render(const Figure& figure, PictureFormat format) {
  const std::string script = gnuplot_script(figure);
  return run_gnuplot(terminal(figure, format) + script);
}

void write_pictures(const std::filesystem::path& stem, const Figure& figure) {
  const std::string name = stem.filename().string();
  OutputFiles files(stem.has_parent_path() ? stem.parent_path() : std::filesystem::path("."));
  files.add(name + ".svg", render(figure, PictureFormat::svg));
  files.add(name + ".png", render(figure, PictureFormat::png));
  files.commit();
}

void take_logarithmic_ordinates(Figure& figure) {
  constexpr double decades = 1e-6;
  for (Panel& panel : figure.panels) {
    double least = std::numeric_limits<double>::infinity(), largest = 0.0;
    for (const Series& series : panel.series)
      for (const double value : series.y)
        if (value > 0.0 && std::isfinite(value))
          least = std::min(least, value), largest = std::max(largest, value);
    if (!(largest > 0.0) || panel.heat_map || panel.drawing || panel.z) continue;
    panel.y.logarithmic = true;
    panel.y.ticks.clear();
    panel.y.lower.reset();
    if (least < decades * largest) panel.y.lower = decades * largest;
    if (panel.y.upper && !(*panel.y.upper > 0.0)) panel.y.upper.reset();
  }
}

std::string plain(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("{}^_@&~\\").find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result;
}

}  // namespace wavebalance::app

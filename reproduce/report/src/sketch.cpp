#include "wavebalance/report/sketch.hpp"

#include <algorithm>
#include <cmath>

namespace wavebalance::report {

app::Table polylines_table(const std::vector<Polyline>& lines) {
  app::Table table({"line", "part", "x", "y"});
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (const auto& [x, y] : lines[i].points) table.append_row({std::int64_t(i + 1), lines[i].part, x, y});
  return table;
}

app::Figure sketch(const std::vector<Polyline>& lines, const app::Axis& x, const app::Axis& y, int width,
                   int height) {
  app::Figure figure;
  figure.panel_width = width;
  figure.panel_height = height;
  auto& panel = figure.add_panel();
  panel.frame = false;
  panel.x = x;
  panel.y = y;
  panel.legend = false;
  for (const auto& line : lines) {
    std::vector<double> xs, ys;
    for (const auto& point : line.points) {
      xs.push_back(point[0]);
      ys.push_back(point[1]);
    }
    app::Series series("", xs, ys);
    series.colour = app::Colour::black;
    series.width = line.part == "hatching" ? 0.8 : 1.6;
    panel.add(std::move(series));
  }
  return figure;
}

std::vector<Polyline> hatching(const Polyline& line, double length) {
  std::vector<Polyline> strokes;
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
    const auto &from = line.points[i], &to = line.points[i + 1];
    const double dx = to[0] - from[0], dy = to[1] - from[1], step = std::hypot(dx, dy);
    const double along = length / std::sqrt(2.0) / step;
    strokes.push_back({"hatching", {from, {from[0] + along * (dy + dx), from[1] + along * (dy - dx)}}});
  }
  return strokes;
}

}  // namespace wavebalance::report

#include "jl14.hpp"

namespace wavebalance::jl14 {

using app::Colour;
using app::Figure;
using app::Legend;
using app::Panel;
using app::SeriesStyle;

app::Axis axis(const std::string& label, double lower, double upper) {
  app::Axis result;
  result.label = label;
  result.lower = lower;
  result.upper = upper;
  return result;
}

Series periodic_series(const std::string& label, const Eigen::VectorXd& values, double from) {
  const Eigen::Index n = values.size();
  const auto first = static_cast<Eigen::Index>(std::lround(from * static_cast<double>(n)));
  Eigen::VectorXd x(n + 1), y(n + 1);
  for (Eigen::Index i = 0; i <= n; ++i) {
    x[i] = static_cast<double>(first + i) / static_cast<double>(n);
    y[i] = values[((first + i) % n + n) % n];
  }
  return Series(label, x, y);
}

Series reference_series(const Eigen::VectorXd& values, double from) {
  Series series = periodic_series("time stepping", values, from);
  series.colour = Colour::black;
  series.dash = app::Dash::dashed;
  series.width = 1.1;
  return series;
}

namespace {

Panel pair_panel(const PairPanels& content, const Eigen::VectorXd& values, const Pair& pair) {
  Panel panel;
  Series series = periodic_series(pair.label, content.scale * values, content.from);
  series.colour = pair.colour;
  panel.add(series).add(reference_series(content.scale * content.reference, content.from));
  panel.x = axis("Normalised time t/T", content.from, content.from + 1.0);
  panel.y = content.y;
  panel.legend = Legend::none;
  if (content.level) panel.mark_y(content.scale * *content.level);
  return panel;
}

Panel zoomed(Panel panel, const Zoom& zoom) {
  panel.x = axis(panel.x.label, zoom.from, zoom.to);
  panel.x.ticks = zoom.ticks;
  panel.y = axis(panel.y.label, zoom.lower, zoom.upper);
  return panel;
}

}  // namespace

Figure pair_figure(const PairPanels& content) {
  constexpr std::size_t columns = 3;
  Figure figure;
  figure.columns = columns;
  figure.panel_width = 400;
  figure.panel_height = content.zoom ? 260 : 300;
  figure.letters = false;
  figure.title = content.title + "; dashed: time stepping";
  const auto chosen = panel_pairs();
  const Values values = reordered(content.values, pairs(), chosen);
  for (std::size_t row = 0; row < chosen.size(); row += columns) {
    for (const bool zoom : {false, true}) {
      if (zoom && !content.zoom) continue;
      for (std::size_t i = row; i < row + columns; ++i) {
        Panel panel = pair_panel(content, values[i], chosen[i]);
        const std::string letter = std::string("{/:Bold (") + static_cast<char>('a' + i) + ")}  ";
        panel.title = letter + (zoom ? "enlarged" : chosen[i].label);
        figure.panels.push_back(zoom ? zoomed(panel, *content.zoom) : panel);
      }
    }
  }
  return figure;
}

Figure levels_figure(const Table& table, const std::string& name, SeriesStyle style) {
  Figure figure;
  figure.columns = 3;
  figure.panel_width = 340;
  figure.panel_height = 240;
  for (int level = 0; level <= 5; ++level) {
    const std::vector<double> values = table.numbers("level_" + std::to_string(level));
    Panel& panel = figure.add_panel("J = " + std::to_string(level));
    Series series = periodic_series(
        "", Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
    if (style == SeriesStyle::steps) series.y.back() = values.back();  // the cell ends, the next is not drawn
    series.style = style;
    series.colour = Colour::blue;
    panel.add(std::move(series));
    panel.x = axis("Normalised time t", 0.0, 1.0);
    panel.y = axis(name, -0.45 * (1 << level), 1.45 * (1 << level));
  }
  return figure;
}

}  // namespace wavebalance::jl14

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "files/number_text.hpp"
#include "plot/plot_parts.hpp"
#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {
namespace {

constexpr const char* text_colour = "#222222";

bool shown(double value, const Axis& axis) {
  return std::isfinite(value) && (!axis.logarithmic || value > 0);
}

bool has_points(const Series& series, const Panel& panel) {
  if (panel.z) return !series.x.empty();
  for (std::size_t i = 0; i < series.x.size(); ++i)
    if (shown(series.x[i], panel.x) && shown(series.y[i], panel.y)) return true;
  return false;
}

std::string block_name(std::size_t panel, std::size_t series) {
  return fmt::format("$panel{}_series{}", panel, series);
}

std::string data_block(const Series& series, const std::string& name) {
  std::string text = name + " << END\n";
  for (std::size_t i = 0; i < series.x.size(); ++i)
    text += coordinate(series.x[i]) + " " + coordinate(series.y[i]) +
            (series.z.empty() ? "" : " " + coordinate(series.z[i])) + "\n";
  return text + "END\n";
}

std::string map_name(std::size_t panel) { return "$panel" + std::to_string(panel) + "_map"; }

/// Bounds of the cell of entry `i`. All but the last reach over the next cell, which is
/// drawn later: cells that only touch leave pale seams where edges are smoothed.
std::pair<double, double> cell(const std::vector<double>& places, std::size_t i) {
  const double half = 0.5 * (places.back() - places.front()) / static_cast<double>(places.size() - 1);
  return {places[i] - half, places[i] + (i + 1 < places.size() ? 2.0 : 1.0) * half};
}

std::string map_block(const HeatMap& map, const std::string& name) {
  std::string text = name + " << END\n";
  for (std::size_t row = 0; row < map.y.size(); ++row)
    for (std::size_t column = 0; column < map.x.size(); ++column) {
      const double value = map.values[row * map.x.size() + column];
      if (std::isnan(value)) continue;
      const auto [left, right] = cell(map.x, column);
      const auto [bottom, top] = cell(map.y, row);
      for (const double one : {map.x[column], map.y[row], left, right, bottom, top})
        text += coordinate(one) + " ";
      text += coordinate(value) + "\n";
    }
  return text + "END\n";
}

/// The ends of the bar mark values beyond them.
std::string map_text(const HeatMap& map) {
  const std::string end = number_text(map.largest);
  std::string text;
  for (int i = 0; const char* colour : map_colours(map))
    text += fmt::format("{}{} '{}'", i == 0 ? "set palette defined (" : ", ", i, colour), ++i;
  text += ")\nset cbrange [" + (map.from_zero ? number_text(map.least) : "-" + end) + ":" + end +
          "]\nset cblabel " + quoted(map.label) + "\nset colorbox\nset cbtics autofreq scale 0.4\n";
  const auto beyond = [&](double sign) {
    return std::ranges::any_of(map.values,
                               [&](double value) { return sign * value > map.largest * (1.0 + 1e-9); });
  };
  if (beyond(1.0)) text += "set cbtics add ('≥ " + end + "' " + end + ")\n";
  if (!map.from_zero && beyond(-1.0)) text += "set cbtics add ('≤ -" + end + "' -" + end + ")\n";
  return text;
}

/// `empty` is true if no point fixes the range. gnuplot then cannot choose one.
std::string axis_text(const std::string& name, const Axis& axis, bool empty) {
  const auto limit = [&](const std::optional<double>& value, const char* otherwise) {
    return value ? number_text(*value) : std::string(empty ? otherwise : "*");
  };
  std::string text = (axis.logarithmic ? "set logscale " : "unset logscale ") + name + "\n";
  text += "set " + name + "label " + quoted(axis.label) + (name == "x" ? " offset 0,0.4\n" : "\n");
  text += "set " + name + "range [" + limit(axis.lower, axis.logarithmic ? "0.1" : "0") + ":" +
          limit(axis.upper, "1") + "]\n";
  const std::string otherwise = axis.logarithmic && axis.ticks.empty() ? "10^{%L}" : "%g";
  text += "set format " + name + " " + quoted(axis.tick_format.empty() ? otherwise : axis.tick_format) + "\n";
  text += "set " + name + "tics ";
  if (axis.ticks.empty()) return text + "autofreq\n";
  for (std::size_t i = 0; i < axis.ticks.size(); ++i)
    text += (i == 0 ? "(" : ", ") + (axis.tick_texts.empty() ? "" : quoted(axis.tick_texts[i]) + " ") +
            number_text(axis.ticks[i]);
  return text + ")\n";
}

/// The least and the largest `member` of the points that are shown; infinity and 0 without any.
std::pair<double, double> shown_extent(const Panel& panel, std::vector<double> Series::*member) {
  double lower = std::numeric_limits<double>::infinity(), upper = 0.0;
  for (const Series& series : panel.series)
    for (std::size_t i = 0; i < series.x.size(); ++i) {
      if (!shown(series.x[i], panel.x) || !shown(series.y[i], panel.y)) continue;
      lower = std::min(lower, (series.*member)[i]);
      upper = std::max(upper, (series.*member)[i]);
    }
  return {lower, upper};
}

/// Commands that number a logarithmic axis of the panel whose values are `member`s of its series, where
/// gnuplot's own powers of ten are too few.
std::string short_axis_text(const std::string& name, const Axis& axis, const Panel& panel,
                            std::vector<double> Series::*member) {
  if (!axis.logarithmic || !axis.ticks.empty()) return "";
  auto [lower, upper] = shown_extent(panel, member);
  lower = axis.lower.value_or(lower);
  upper = axis.upper.value_or(upper);
  if (!(lower <= upper)) return "";
  std::string range, text;
  if (lower == upper) {  // a single value has a range about it
    lower /= 2.0;
    upper *= 2.0;
    range = "set " + name + "range [" + number_text(lower) + ":" + number_text(upper) + "]\n";
  }
  const std::vector<double> ticks = logarithmic_ticks(lower, upper);
  const bool by_decades = std::ranges::all_of(ticks, [](double tick) {
    const double exponent = std::log10(tick);
    return std::abs(exponent - std::round(exponent)) < 1e-9;
  });
  if (by_decades) return "";
  for (const double tick : ticks)
    text += (text.empty() ? "" : ", ") + quoted(tick_text(tick)) + " " + number_text(tick);
  return range + "set " + name + "tics (" + text + ")\n";
}

std::string end_text(const std::optional<double>& value, int edge) {
  return value ? "first " + number_text(*value) : "graph " + std::to_string(edge);
}

std::string segment_text(const Segment& s) {
  return "set arrow from " + end_text(s.x1, 0) + "," + end_text(s.y1, 0) + " to " + end_text(s.x2, 1) + "," +
         end_text(s.y2, 1) + (s.arrow ? " head filled size screen 0.012,20 " : " nohead ") +
         stroke_text(s.colour, s.dash, s.width) + (s.arrow ? " front\n" : " back\n") +
         (s.label.empty()
              ? ""
              : "set label " + quoted(s.label) + " at graph 1.01," + end_text(s.y2, 1) + " left\n");
}

bool has_labelled_segments(const Figure& figure) {
  return std::ranges::any_of(figure.panels, [](const Panel& panel) {
    return std::ranges::any_of(panel.segments, [](const Segment& one) { return !one.label.empty(); });
  });
}

std::string rectangle_text(const Rectangle& r) {
  return fmt::format("set object rectangle from {},{} to {},{} fc rgb '{}' fs solid {} noborder behind\n",
                     number_text(r.x1), number_text(r.y1), number_text(r.x2), number_text(r.y2),
                     colour_code(r.fill), number_text(r.opacity));
}

std::string mark_text(const TextMark& mark) {
  constexpr std::array sides{"left", "center", "right"};  // in the order of the enumeration
  return fmt::format("set label {} at first {},first {} {} front\n", quoted(mark.text), number_text(mark.x),
                     number_text(mark.y), sides[static_cast<std::size_t>(mark.align)]);
}

/// Edges of the axes of a diagram in fractions of the picture. In SVG gnuplot overestimates the height of
/// letters, and would use half of a low panel for its margins. `aligned` panels are below each other: 88 px
/// hold labels like 0.0005. Labels of segments are right of the panel.
std::string margins_text(const Panel& panel, const FigureLayout& layout, const Box& box, bool heading,
                         bool aligned, bool labelled) {
  const double below = panel.x.label.empty() ? 32.0 : 58.0, above = heading ? 30.0 : 12.0;
  const auto at = [](const char* edge, double share) {
    return fmt::format("set {}margin at screen {}\n", edge, number_text(share));
  };
  std::string text = at("b", (box.bottom + below) / layout.height) +
                     at("t", (box.bottom + box.height - above) / layout.height);
  text += aligned ? at("l", (box.left + 88.0) / layout.width) : "unset lmargin\n";
  text += panel.heat_map ? "unset rmargin\n"
                         : at("r", (box.left + box.width - (labelled ? 60.0 : 24.0)) / layout.width);
  return text;
}

/// Labels of ordinates below each other. gnuplot would place each by its estimate of the numbers' length,
/// and beyond the edge where they are long.
std::string aligned_label_text(const Panel& panel, const FigureLayout& layout, const Box& box) {
  return "set ylabel ''\nset label " + quoted(panel.y.label) +
         fmt::format(" at screen {},graph 0.5 center rotate by 90\n",
                     number_text((box.left + 14.0) / layout.width));
}

std::string frame_text(bool frame) {
  if (!frame)
    return "unset border\nunset xtics\nunset ytics\nunset grid\nset lmargin 1\nset rmargin 1\nunset bmargin\n"
           "set tmargin 2.2\n";
  return "set border 3 lc rgb " + quoted(text_colour) +
         " lw 0.9\nset xtics nomirror scale 0.6\nset ytics nomirror scale 0.6\n"
         "set grid lt 1 lc rgb '#D4D4D4' lw 0.8 dt solid\n";
}

/// The heading is at the left so that letters of panels line up.
std::string heading_text(const std::string& letter, const std::string& title, bool perspective) {
  const std::string text =
      letter.empty() ? title : "{/:Bold " + letter + "}" + (title.empty() ? "" : "  " + title);
  if (text.empty()) return "";
  if (perspective) return "set title " + quoted(text) + "\n";
  return "set label " + quoted(text) + " at graph 0,graph 1 left offset 0,0.9\n";
}

std::string plot_command(const Panel& panel, std::size_t panel_index) {
  const std::string command = panel.z ? "splot " : "plot ";
  std::string text;
  if (panel.drawing)
    for (const std::string& item : panel.drawing->items) text += (text.empty() ? command : ", ") + item;
  // Cells are drawn one by one: the same in every terminal, and sharp.
  if (panel.heat_map)
    text += (text.empty() ? command : ", ") + map_name(panel_index) +
            " using 1:2:3:4:5:6:7 with boxxyerror lc palette fs solid noborder notitle";
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    const Series& series = panel.series[i];
    const std::string data = has_points(series, panel)
                                 ? block_name(panel_index, i) + (panel.z ? " using 1:2:3" : " using 1:2")
                                 : "NaN";
    text += (text.empty() ? command : ", ") + data + " with " + style_text(series, i) + " notitle";
  }
  return (text.empty() ? "plot NaN notitle" : text) + "\n";
}

/// One legend for all panels, below them, where it lies on no curve.
std::string legend_text(const Figure& figure, const FigureLayout& layout) {
  const auto entries = legend_entries(figure);
  if (entries.empty()) return "";
  std::string text =
      "unset title\nunset label\nunset arrow\nunset object\nunset border\nunset xtics\nunset ytics\n"
      "unset grid\nunset xlabel\nunset ylabel\nunset colorbox\nunset logscale\nset size noratio\n"
      "set lmargin 0\nset rmargin 0\nset tmargin 0\nset bmargin 0\nset xrange [0:1]\nset yrange [0:1]\n" +
      layout.place_text(layout.legend());
  text += fmt::format("set key inside center center horizontal maxcols {} Left reverse samplen 2.2\n",
                      layout.legend_columns);
  for (std::size_t i = 0; i < entries.size(); ++i)
    text += (i == 0 ? "plot " : ", ") +
            fmt::format("NaN with {} title {}", entries[i].style, quoted(entries[i].label));
  return text + "\n";
}

std::string panel_text(const Panel& panel, std::size_t index, const FigureLayout& layout,
                       const std::string& letter, const std::string& title, bool aligned, bool labelled) {
  const bool framed = panel.frame && !panel.drawing;
  const bool empty =
      std::ranges::none_of(panel.series, [&](const Series& series) { return has_points(series, panel); });
  std::string text = "unset key\nunset title\nunset label\nunset arrow\nunset object\nset size noratio\n" +
                     layout.place_text(layout.panel(index)) + frame_text(framed);
  if (framed)
    text += margins_text(panel, layout, layout.panel(index), !(letter + title).empty(), aligned, labelled);
  text += axis_text("x", panel.x, empty) + axis_text("y", panel.y, empty);
  text += short_axis_text("x", panel.x, panel, &Series::x) + short_axis_text("y", panel.y, panel, &Series::y);
  if (framed && aligned && !panel.z && !panel.y.label.empty())
    text += aligned_label_text(panel, layout, layout.panel(index));
  if (panel.z)
    text +=
        axis_text("z", *panel.z, empty) +
        "set view 60,325,1,1.2\nset xyplane relative 0\nset border 895\nset zlabel rotate\n"
        "set lmargin 7\nset rmargin 2\nset bmargin 6\nset tmargin 2.2\nset xlabel offset 3,0.4\nset ylabel offset 0,0.2\n";
  if (panel.heat_map) text += map_text(*panel.heat_map) + "unset grid\n";
  if (!framed) text += "unset xtics\nunset ytics\n";
  text += heading_text(letter, title, panel.z.has_value());
  for (const auto& rectangle : panel.rectangles) text += rectangle_text(rectangle);
  for (const auto& segment : panel.segments) text += segment_text(segment);
  for (const auto& mark : panel.texts) text += mark_text(mark);
  if (panel.drawing) text = panel.drawing->data + text + panel.drawing->setup;
  return text + plot_command(panel, index);
}

void check(const Axis& axis, const char* name) {
  if (!axis.logarithmic) return;
  if ((axis.lower && *axis.lower <= 0) || (axis.upper && *axis.upper <= 0))
    throw std::invalid_argument("Figure: the limits of the logarithmic axis " + std::string(name) +
                                " must be positive");
}

void check(const HeatMap& map) {
  if (map.values.size() != map.x.size() * map.y.size() || map.x.size() < 2 || map.y.size() < 2)
    throw std::invalid_argument(
        fmt::format("Figure: a heat map has {} values for a grid of {} x {}; at least 2 x 2 are needed",
                    map.values.size(), map.x.size(), map.y.size()));
  if (!(map.largest > 0.0))
    throw std::invalid_argument("Figure: the largest value of a heat map is not positive");
}

void check(const Figure& figure) {
  if (figure.panels.empty())
    throw std::invalid_argument("Figure: it has no panel; it must have one at least");
  if (figure.columns < 1) throw std::invalid_argument("Figure: columns is not positive");
  for (const Panel& panel : figure.panels) {
    if (panel.heat_map) check(*panel.heat_map);
    if (panel.drawing && panel.z) throw std::invalid_argument("Figure: a panel with a drawing has a z axis");
    check(panel.x, "x");
    check(panel.y, "y");
    for (const Series& series : panel.series)
      if (series.x.size() != series.y.size())
        throw std::invalid_argument(fmt::format(
            "Figure: series \"{}\" has {} abscissae and {} ordinates; their numbers must be equal",
            series.label, series.x.size(), series.y.size()));
      else if (series.z.size() != (panel.z ? series.x.size() : 0))
        throw std::invalid_argument(fmt::format(
            "Figure: series \"{}\" has {} heights for {} points; a panel with a z axis needs as many, "
            "one without needs none",
            series.label, series.z.size(), series.x.size()));
  }
}

std::string letter_of(std::size_t index) {
  if (index >= 26) return "(" + std::to_string(index + 1) + ")";
  return std::string("(") + static_cast<char>('a' + index) + ")";
}

}  // namespace

std::string gnuplot_script(const Figure& figure) {
  check(figure);
  std::string text =
      "set encoding utf8\nset samples 2\nset tics textcolor rgb '" + std::string(text_colour) + "'\n";
  text += "set autoscale xfix\nset pointsize 1\n";
  for (std::size_t p = 0; p < figure.panels.size(); ++p)
    if (figure.panels[p].heat_map) text += map_block(*figure.panels[p].heat_map, map_name(p));
  for (std::size_t p = 0; p < figure.panels.size(); ++p)
    for (std::size_t s = 0; s < figure.panels[p].series.size(); ++s)
      text += data_block(figure.panels[p].series[s], block_name(p, s));
  const std::size_t count = figure.panels.size();
  const bool labelled = has_labelled_segments(figure), several = count > 1;
  const FigureLayout layout(figure);
  text += "set multiplot" +
          (several && !figure.title.empty() ? " title " + quoted(figure.title) + " font ',15'" : "") + "\n";
  const std::string& first = figure.panels[0].title;
  const std::string alone = figure.title + (!first.empty() && !figure.title.empty() ? ": " : "") + first;
  for (std::size_t p = 0; p < count; ++p)
    text += panel_text(figure.panels[p], p, layout, several && figure.letters ? letter_of(p) : "",
                       several ? figure.panels[p].title : alone, several, labelled);
  return text + legend_text(figure, layout) + "unset multiplot\n";
}

}  // namespace wavebalance::app

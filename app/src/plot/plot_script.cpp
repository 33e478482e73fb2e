#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "files/number_text.hpp"
#include "plot/plot_surface.hpp"
#include "plot/plot_text.hpp"
#include "wavebalance/app/plot/plot.hpp"

namespace wavebalance::app {
namespace {

constexpr const char* text_colour = "#222222";

std::string dash_text(Dash dash) {
  switch (dash) {
    case Dash::dashed:
      return "(9,5)";
    case Dash::dotted:
      return "(2,4)";
    case Dash::dash_dotted:
      return "(10,4,2,4)";
    case Dash::solid:
      break;
  }
  return "1";
}

std::string stroke(Colour colour, Dash dash, double width) {
  return fmt::format("lc rgb '{}' lw {} dt {}", colour_code(colour), number_text(width), dash_text(dash));
}

std::string symbol(const Series& series, std::size_t index) {
  const std::size_t number = series.marker > 0 ? static_cast<std::size_t>(series.marker - 1) : index;
  std::string text = symbol_text(number);
  if (series.marker_every) text += " pi " + std::to_string(*series.marker_every);
  return text;
}

std::string style_text(const Series& series, std::size_t index) {
  const Colour colour = series.colour == Colour::automatic ? automatic_colour(index) : series.colour;
  const std::string drawn = stroke(colour, series.dash, series.width);
  switch (series.style) {
    case SeriesStyle::points:
      return "points lc rgb '" + colour_code(colour) + "'" + symbol(series, index);
    case SeriesStyle::line_points:
      return "linespoints " + drawn + symbol(series, index);
    case SeriesStyle::steps:
      return "steps " + drawn;
    case SeriesStyle::impulses:
      return "impulses " + drawn;
    case SeriesStyle::line:
      break;
  }
  return "lines " + drawn;
}

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

/// The ends of the bar say so where values lie beyond them.
std::string map_text(const HeatMap& map) {
  const std::string end = number_text(map.largest);
  std::string text =
      map.from_zero ? "set palette defined (0 '#FFFFFF', 0.25 '#ADD8F0', 0.5 '#56B4E9', 0.75 '#0072B2', 1 "
                      "'#062A4E')\nset cbrange [0:"
                    : "set palette defined (-1 '#0072B2', -0.5 '#7FB8D8', 0 '#FFFFFF', 0.5 '#EAAE7F', 1 "
                      "'#D55E00')\nset cbrange [-" +
                          end + ":";
  text += end + "]\nset cblabel " + quoted(map.label) + "\nset colorbox\nset cbtics autofreq scale 0.4\n";
  const auto beyond = [&](double sign) {
    return std::any_of(map.values.begin(), map.values.end(),
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
  text += "set " + name + "label " + quoted(axis.label) + "\n";
  text += "set " + name + "range [" + limit(axis.lower, axis.logarithmic ? "0.1" : "0") + ":" +
          limit(axis.upper, "1") + "]\n";
  const std::string otherwise = axis.logarithmic && axis.ticks.empty() ? "10^{%L}" : "%g";
  text += "set format " + name + " " + quoted(axis.tick_format.empty() ? otherwise : axis.tick_format) + "\n";
  text += "set " + name + "tics ";
  if (axis.ticks.empty()) return text + "autofreq\n";
  for (std::size_t i = 0; i < axis.ticks.size(); ++i)
    text += (i == 0 ? "(" : ", ") + number_text(axis.ticks[i]);
  return text + ")\n";
}

std::string legend_text(const Panel& panel) {
  bool named =
      std::any_of(panel.series.begin(), panel.series.end(), [](const Series& s) { return !s.label.empty(); });
  if (panel.surface)
    for (const Surface& surface : panel.surface->surfaces) named = named || !surface.marks.empty();
  if (!named || panel.legend == Legend::none) return "unset key\n";
  const std::string style = " samplen 2.2 spacing 1.15 noautotitle\n";
  switch (panel.legend) {
    case Legend::top_left:
      return "set key inside left top Left reverse" + style;
    case Legend::bottom_left:
      return "set key inside left bottom Left reverse" + style;
    case Legend::bottom_right:
      return "set key inside right bottom Left reverse" + style;
    case Legend::top_centre:
      return "set key inside center top Left reverse" + style;
    case Legend::right_of_panel:
      return "set key outside right top vertical maxcols 1 Left reverse" + style;
    case Legend::below_panel:
      return "set key outside center bottom horizontal Left reverse height 1.2" + style;
    default:
      return "set key inside right top Left reverse" + style;
  }
}

std::string end_text(const std::optional<double>& value, int edge) {
  return value ? "first " + number_text(*value) : "graph " + std::to_string(edge);
}

std::string segment_text(const Segment& s) {
  return "set arrow from " + end_text(s.x1, 0) + "," + end_text(s.y1, 0) + " to " + end_text(s.x2, 1) + "," +
         end_text(s.y2, 1) + (s.arrow ? " head filled size screen 0.012,20 " : " nohead ") +
         stroke(s.colour, s.dash, s.width) + (s.arrow ? " front\n" : " back\n") +
         (s.label.empty()
              ? ""
              : "set label " + quoted(s.label) + " at graph 1.01," + end_text(s.y2, 1) + " left\n");
}

bool has_labelled_segments(const Figure& figure) {
  for (const Panel& panel : figure.panels)
    for (const Segment& segment : panel.segments)
      if (!segment.label.empty()) return true;
  return false;
}

std::string rectangle_text(const Rectangle& r) {
  return fmt::format("set object rectangle from {},{} to {},{} fc rgb '{}' fs solid {} noborder behind\n",
                     number_text(r.x1), number_text(r.y1), number_text(r.x2), number_text(r.y2),
                     colour_code(r.fill), number_text(r.opacity));
}

std::string mark_text(const TextMark& mark) {
  const char* align = mark.align == TextMark::Align::left    ? "left"
                      : mark.align == TextMark::Align::right ? "right"
                                                             : "center";
  return fmt::format("set label {} at first {},first {} {} front\n", quoted(mark.text), number_text(mark.x),
                     number_text(mark.y), align);
}

/// `aligned` panels have one left margin, so that axes stand below each other; 9 characters hold labels like
/// 0.0005. Labels of segments stand right of the panel, in 6 characters.
std::string frame_text(bool frame, bool aligned, bool labelled) {
  if (!frame) return "unset border\nunset xtics\nunset ytics\nunset grid\nset lmargin 1\nset rmargin 1\n";
  std::string text = "set border 3 lc rgb " + quoted(text_colour);
  text +=
      " lw 0.9\nset xtics nomirror scale 0.6\nset ytics nomirror scale 0.6\n"
      "set grid lt 1 lc rgb '#D4D4D4' lw 0.8 dt solid\n";
  text += aligned ? "set lmargin 9\n" : "unset lmargin\n";
  text += labelled ? "set rmargin 6\n" : "unset rmargin\n";
  return text;
}

/// The heading stands at the left so that letters of panels line up.
std::string heading_text(const std::string& letter, const std::string& title, bool perspective) {
  const std::string text =
      letter.empty() ? title : "{/:Bold " + letter + "}" + (title.empty() ? "" : "  " + title);
  if (text.empty()) return "set tmargin 1\n";
  if (perspective) return "set tmargin 2.2\nset title " + quoted(text) + "\n";
  return "set tmargin 2.2\nset label " + quoted(text) + " at graph 0,graph 1 left offset 0,0.9\n";
}

std::string plot_command(const Panel& panel, std::size_t panel_index, const SurfaceScript& surface) {
  const std::string command = panel.z ? "splot " : "plot ";
  std::string text;
  for (const std::string& item : surface.items) text += (text.empty() ? command : ", ") + item;
  // Cells are drawn one by one: the same in every terminal, and sharp.
  if (panel.heat_map)
    text += (text.empty() ? command : ", ") + map_name(panel_index) +
            " using 1:2:3:4:5:6:7 with boxxyerror lc palette fs solid noborder notitle";
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    const Series& series = panel.series[i];
    // A curve without points is kept in the legend.
    const std::string data = has_points(series, panel)
                                 ? block_name(panel_index, i) + (panel.z ? " using 1:2:3" : " using 1:2")
                                 : "NaN";
    text += (text.empty() ? command : ", ") + data + " with " + style_text(series, i) +
            (series.label.empty() ? " notitle" : " title " + quoted(series.label));
  }
  return (text.empty() ? "plot NaN notitle" : text) + "\n";
}

std::string panel_text(const Panel& panel, std::size_t index, const std::string& letter,
                       const std::string& title, bool aligned, bool labelled) {
  const bool framed = panel.frame && !panel.surface;
  const bool empty = std::none_of(panel.series.begin(), panel.series.end(),
                                  [&](const Series& series) { return has_points(series, panel); });
  std::string text =
      "unset bmargin\nunset title\nunset label\nunset arrow\nunset object\nset size noratio\n" +
      frame_text(framed, aligned, labelled);
  text += axis_text("x", panel.x, empty) + axis_text("y", panel.y, empty);
  if (panel.z)
    text += axis_text("z", *panel.z, empty) +
            "set view 60,325,1,1.2\nset xyplane relative 0\nset border 895\nset zlabel rotate\n"
            "set lmargin 7\nset rmargin 2\nset bmargin 6\nset xlabel offset 3,0.4\nset ylabel offset 0,0.2\n";
  if (panel.heat_map) text += map_text(*panel.heat_map) + "unset grid\n";
  if (!framed) text += "unset xtics\nunset ytics\n";
  text += legend_text(panel) + heading_text(letter, title, panel.z.has_value());
  for (const auto& rectangle : panel.rectangles) text += rectangle_text(rectangle);
  for (const auto& segment : panel.segments) text += segment_text(segment);
  for (const auto& mark : panel.texts) text += mark_text(mark);
  SurfaceScript surface;
  if (panel.surface)
    surface = surface_script(*panel.surface, panel.x, panel.y, "$panel" + std::to_string(index));
  return surface.data + text + surface.setup + plot_command(panel, index, surface);
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
    if (panel.surface) check(*panel.surface);
    if (panel.surface && panel.z) throw std::invalid_argument("Figure: a panel with a surface has a z axis");
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
  const bool labelled = has_labelled_segments(figure);
  if (count == 1) {
    const std::string& title = figure.panels[0].title;
    const bool both = !title.empty() && !figure.title.empty();
    return text +
           panel_text(figure.panels[0], 0, "", figure.title + (both ? ": " : "") + title, false, labelled);
  }
  const std::size_t columns = std::min(count, static_cast<std::size_t>(figure.columns));
  const std::size_t rows = (count + columns - 1) / columns;
  text += fmt::format("set multiplot layout {},{}{}\n", rows, columns,
                      figure.title.empty() ? "" : " title " + quoted(figure.title) + " font ',15'");
  for (std::size_t p = 0; p < count; ++p)
    text += panel_text(figure.panels[p], p, figure.letters ? letter_of(p) : "", figure.panels[p].title, true,
                       labelled);
  return text + "unset multiplot\n";
}

}  // namespace wavebalance::app

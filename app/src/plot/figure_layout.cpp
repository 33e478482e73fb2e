#include "plot/plot_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "files/number_text.hpp"

namespace wavebalance::app {
namespace {

constexpr int title_height = 34;  // px
// gnuplot assumes letters of an SVG 0.7 times the font size (13.5 px) wide, and lines 1.5 times as high.
constexpr double letter_width = 0.7 * 13.5, line_height = 1.5 * 13.5;
constexpr double sample_width = 7 * letter_width;  // of the line before a name, and the space between columns

std::string dash_text(Dash dash) {
  constexpr std::array patterns{"1", "(9,5)", "(2,4)", "(10,4,2,4)"};  // in the order of the enumeration
  return patterns[static_cast<std::size_t>(dash)];
}

Colour colour_of(const Series& series, std::size_t index) {
  return series.colour == Colour::automatic ? automatic_colour(index) : series.colour;
}

std::string symbol(const Series& series, std::size_t index) {
  const std::size_t number = series.marker > 0 ? static_cast<std::size_t>(series.marker - 1) : index;
  std::string text = symbol_text(number, series.marker_size);
  if (series.marker_every) text += " pi " + std::to_string(*series.marker_every);
  return text;
}

/// Letters that are drawn: without marks of sub- and superscripts, each UTF-8 sequence once.
std::size_t letters_in(const std::string& label) {
  return static_cast<std::size_t>(std::ranges::count_if(label, [](char c) {
    return std::string_view("{}^_\\").find(c) == std::string_view::npos &&
           (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

/// Differences between the looks of a name; widths and the number of symbols on a curve do not matter.
using Look = std::tuple<std::string, Colour, Dash, SeriesStyle>;

bool is_drawn(const Series& series, bool logarithmic) {
  if (series.area) return true;
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i)
    if (std::isfinite(series.x[i]) && std::isfinite(series.y[i]) && !(logarithmic && series.y[i] <= 0.0))
      return true;
  return false;
}

void add_series(const std::vector<Series>& series, std::map<Look, bool>& named,
                std::vector<LegendEntry>& entries, bool logarithmic, bool all = false) {
  for (std::size_t i = 0; i < series.size(); ++i) {
    const Series& one = series[i];
    if (one.label.empty() || !(all || is_drawn(one, logarithmic))) continue;
    if (!named.try_emplace({one.label, colour_of(one, i), one.dash, one.style}, true).second) continue;
    Series every = one;
    every.marker_every.reset();
    entries.push_back({one.label, style_text(every, i)});
  }
}

}  // namespace

std::string stroke_text(Colour colour, Dash dash, double width) {
  return fmt::format("lc rgb '{}' lw {} dt {}", colour_code(colour), number_text(width), dash_text(dash));
}

std::string style_text(const Series& series, std::size_t index) {
  // In the order of the enumeration.
  constexpr std::array names{"lines ", "points ", "linespoints ", "steps ", "impulses "};
  const bool points = series.style == SeriesStyle::points;
  const bool marked = points || series.style == SeriesStyle::line_points;
  const Colour colour = colour_of(series, index);
  return names[static_cast<std::size_t>(series.style)] +
         (points ? "lc rgb '" + colour_code(colour) + "'" : stroke_text(colour, series.dash, series.width)) +
         (marked ? symbol(series, index) : "");
}

std::vector<LegendEntry> legend_entries(const Figure& figure) {
  std::map<Look, bool> named;
  std::vector<LegendEntry> entries;
  for (const Panel& panel : figure.panels) {
    if (!panel.legend) continue;
    if (panel.drawing) add_series(panel.drawing->legend, named, entries, false, true);
    add_series(panel.series, named, entries, panel.y.logarithmic);
  }
  return entries;
}

FigureLayout::FigureLayout(const Figure& figure)
    : panel_width(figure.panel_width), panel_height(figure.panel_height) {
  const int count = std::max(1, static_cast<int>(figure.panels.size()));
  columns = std::clamp(figure.columns, 1, count);
  rows = (count + columns - 1) / columns;
  width = columns * panel_width;
  height = rows * panel_height + (count > 1 && !figure.title.empty() ? title_height : 0);
  const auto entries = legend_entries(figure);
  if (entries.empty()) return;
  std::size_t longest = 0;
  for (const LegendEntry& entry : entries) longest = std::max(longest, letters_in(entry.label));
  const double column = sample_width + letter_width * static_cast<double>(longest);
  const int all = static_cast<int>(entries.size());
  legend_columns = std::clamp(static_cast<int>(width / column), 1, all);
  const int lines = (all + legend_columns - 1) / legend_columns;
  legend_columns = (all + lines - 1) / lines;  // rows of nearly equal length
  legend_height = static_cast<int>(line_height * (lines + 0.8));
  height += legend_height;
}

Box FigureLayout::panel(std::size_t index) const {
  const int row = static_cast<int>(index) / columns, column = static_cast<int>(index) % columns;
  return {double(column * panel_width), double(legend_height + (rows - 1 - row) * panel_height),
          double(panel_width), double(panel_height)};
}

std::string FigureLayout::place_text(const Box& box) const {
  return fmt::format("set origin {},{}\nset size {},{}\n", number_text(box.left / width),
                     number_text(box.bottom / height), number_text(box.width / width),
                     number_text(box.height / height));
}

}  // namespace wavebalance::app

#include "wavebalance/app/plot/figure_script.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "files/number_text.hpp"
#include "plot/plot_parts.hpp"

namespace wavebalance::app {
namespace {

using Json = nlohmann::ordered_json;

constexpr double thinning = 1e-4;  // of the range of an axis
constexpr std::size_t most_points = 5000;

double short_number(double value) { return rounded(value, 6); }

std::vector<double> short_numbers(const std::vector<double>& values) {
  std::vector<double> result;
  for (const double value : values) result.push_back(short_number(value));
  return result;
}

/// `values` as fractions of the range of `axis`, by default the range of the values.
std::vector<double> on_axis(std::vector<double> values, const Axis& axis) {
  const auto scale = [&](double value) { return axis.logarithmic ? std::log10(value) : value; };
  double lower = std::numeric_limits<double>::infinity(), upper = -lower;
  for (double& value : values) {
    value = scale(value);
    if (!std::isfinite(value)) continue;
    lower = std::min(lower, value);
    upper = std::max(upper, value);
  }
  if (axis.lower) lower = scale(*axis.lower);
  if (axis.upper) upper = scale(*axis.upper);
  const double range = upper > lower ? upper - lower : 1.0;
  for (double& value : values) value /= range;
  return values;
}

std::vector<std::size_t> shown_points(const Series& series, const Panel& panel) {
  std::vector<std::size_t> all(series.x.size());
  std::iota(all.begin(), all.end(), 0u);
  if (series.style != SeriesStyle::line) return all;
  const auto x = on_axis(series.x, panel.x), y = on_axis(series.y, panel.y);
  auto kept = kept_points(x, y, thinning);
  for (double tolerance = 2.0 * thinning; kept.size() > most_points && tolerance < 0.1; tolerance *= 2.0)
    kept = kept_points(x, y, tolerance);
  return kept;
}

// In the order of the enumerations; of dashes the lengths of strokes and gaps in pixels.
constexpr std::array style_names{"line", "points", "line_points", "steps", "impulses"};
constexpr std::array dash_lengths{"", "8 5", "2 4", "9 4 2 4"};
constexpr std::array anchors{"start", "middle", "end"};

const char* name_in(const auto& names, auto value) { return names[static_cast<std::size_t>(value)]; }

Json optional_number(const std::optional<double>& value) {
  return value ? Json(short_number(*value)) : Json();
}

Json axis_data(const Axis& axis) {
  return {{"label", axis.label},
          {"lower", optional_number(axis.lower)},
          {"upper", optional_number(axis.upper)},
          {"logarithmic", axis.logarithmic},
          {"ticks", short_numbers(axis.ticks)},
          {"texts", axis.tick_texts},
          {"format", axis.tick_format}};
}

Json series_data(const Series& series, std::size_t index, const Panel& panel) {
  std::vector<double> x, y, told;
  for (const std::size_t i : shown_points(series, panel)) {
    x.push_back(short_number(series.x[i]));
    y.push_back(short_number(series.y[i]));
    if (!series.told_x.empty()) told.push_back(short_number(series.told_x[i]));
  }
  const bool automatic = series.colour == Colour::automatic;
  Json data{{"label", series.label},
            {"style", name_in(style_names, series.style)},
            {"colour", colour_code(automatic ? automatic_colour(index) : series.colour)},
            {"dash", name_in(dash_lengths, series.dash)},
            {"width", series.width},
            {"marker", series.marker > 0 ? static_cast<std::size_t>(series.marker - 1) : index},
            {"every", series.marker_every.value_or(1)},
            {"x", x},
            {"y", y}};
  if (!told.empty()) data["told"] = told;
  if (series.marker_size != 1.0) data["size"] = series.marker_size;
  if (series.area) data["area"] = true;
  return data;
}

Json segment_data(const Segment& s) {
  return {{"from", {optional_number(s.x1), optional_number(s.y1)}},
          {"to", {optional_number(s.x2), optional_number(s.y2)}},
          {"arrow", s.arrow},
          {"colour", colour_code(s.colour)},
          {"dash", name_in(dash_lengths, s.dash)},
          {"width", s.width},
          {"label", s.label}};
}

/// A heat map as a series: the middles of its cells, half their sizes, colours, and the text of each.
Json map_data(const HeatMap& map) {
  const auto half = [](const std::vector<double>& places) {
    return 0.5 * (places.back() - places.front()) / static_cast<double>(places.size() - 1);
  };
  Json cells{{"title", map.label},
             {"half", {short_number(half(map.x)), short_number(half(map.y))}},
             {"range", {short_number(map.from_zero ? map.least : -map.largest), short_number(map.largest)}},
             {"colours", map_colours(map)},
             {"heads", map.told_heads}};
  std::vector<double> x, y, values;
  for (std::size_t i = 0; i < map.told_rows.size(); ++i) {
    if (map.told_rows[i].empty()) continue;
    x.push_back(short_number(map.x[i % map.x.size()]));
    y.push_back(short_number(map.y[i / map.x.size()]));
    values.push_back(short_number(map.values[i]));
    cells["rows"].push_back(short_numbers(map.told_rows[i]));
  }
  cells["values"] = values;
  return {{"label", ""}, {"style", "cells"}, {"x", x}, {"y", y}, {"cells", cells}};
}

Json panel_data(const Panel& panel) {
  Json data{
      {"title", panel.title}, {"x", axis_data(panel.x)}, {"y", axis_data(panel.y)}, {"legend", panel.legend}};
  for (const char* list : {"series", "segments", "rectangles", "texts"}) data[list] = Json::array();
  if (panel.heat_map) data["series"].push_back(map_data(*panel.heat_map));
  for (std::size_t i = 0; i < panel.series.size(); ++i)
    data["series"].push_back(series_data(panel.series[i], i, panel));
  for (const Segment& one : panel.segments) data["segments"].push_back(segment_data(one));
  for (const Rectangle& one : panel.rectangles)
    data["rectangles"].push_back({{"x", {short_number(one.x1), short_number(one.x2)}},
                                  {"y", {short_number(one.y1), short_number(one.y2)}},
                                  {"colour", colour_code(one.fill)},
                                  {"opacity", one.opacity}});
  for (const TextMark& one : panel.texts)
    data["texts"].push_back({{"x", short_number(one.x)},
                             {"y", short_number(one.y)},
                             {"text", one.text},
                             {"anchor", name_in(anchors, one.align)}});
  return data;
}

bool has_point(const Series& series) {
  for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i)
    if (std::isfinite(series.x[i]) && std::isfinite(series.y[i])) return true;
  return false;
}

}  // namespace

bool has_curves(const Figure& figure) {
  bool points = false;
  for (const Panel& panel : figure.panels) {
    const bool tells = panel.heat_map && !panel.heat_map->told_rows.empty();
    if (panel.drawing || panel.z || (panel.heat_map && !tells) || !panel.frame) return false;
    points = points || tells || std::ranges::any_of(panel.series, has_point);
  }
  return points;
}

std::string figure_script(const Figure& figure, const std::string& name) {
  Json data{{"title", figure.title},
            {"columns", figure.columns},
            {"letters", figure.letters && figure.panels.size() > 1},
            {"panel", {figure.panel_width, figure.panel_height}},
            {"panels", Json::array()}};
  for (const Panel& panel : figure.panels) {
    for (const Series& series : panel.series)
      if (series.x.size() != series.y.size())
        throw std::invalid_argument(
            fmt::format("figure_script: series \"{}\" has {} abscissae and {} ordinates; their numbers must "
                        "be equal",
                        series.label, series.x.size(), series.y.size()));
    data["panels"].push_back(panel_data(panel));
  }
  return fmt::format("((window.wavebalance ?\?= {{}}).figures ?\?= {{}})[{}] = {};\n", Json(name).dump(),
                     data.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace wavebalance::app

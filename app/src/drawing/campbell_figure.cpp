#include "drawing/figures.hpp"

#include <numbers>

#include "files/missing.hpp"

namespace wavebalance::app {
namespace {

struct Look {
  const char* direction;
  const char* label;
  Colour colour;
};
constexpr std::array<Look, 4> looks{{{"forward", "forward whirl", Colour::blue},
                                     {"backward", "backward whirl", Colour::orange},
                                     {"in a line", "in a line", Colour::grey},
                                     {"-", "whirl", Colour::black}}};

double in_hertz(double speed) { return speed / (2.0 * std::numbers::pi); }

/// The places of a line with one direction, each joined to the next place; a missing value elsewhere.
Series part_of(const CampbellDiagram& diagram, const std::vector<WhirlMode>& line, const Look& look) {
  Series series = Series(look.label, SeriesStyle::line).in(look.colour);
  const auto is_part = [&](std::size_t i) { return line[i].direction() == look.direction; };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool shown = is_part(i) || (i > 0 && is_part(i - 1)) || (i == 0 && line.size() > 1 && is_part(1));
    series.append(in_hertz(diagram.speeds[i]), shown ? line[i].frequency_hz() : missing);
  }
  return series;
}

bool has_any(const std::vector<WhirlMode>& line, const Look& look) {
  return std::any_of(line.begin() + (line.size() > 1 ? 1 : 0), line.end(),
                     [&](const WhirlMode& mode) { return mode.direction() == look.direction; });
}

/// So high that the line of equal frequencies and two whirls at least are in the picture.
double highest_shown(const CampbellDiagram& diagram) {
  double upper = 1.5 * in_hertz(diagram.speeds.back());
  for (std::size_t i = 0; i < std::min<std::size_t>(2, diagram.lines.size()); ++i)
    for (const WhirlMode& mode : diagram.lines[i]) upper = std::max(upper, 1.1 * mode.frequency_hz());
  return upper;
}

}  // namespace

Figure campbell_figure(const CampbellDiagram& diagram) {
  Figure figure;
  figure.title = "Campbell diagram";
  figure.panel_width = 600;
  figure.panel_height = 380;
  Panel& panel = figure.add_panel("", "Speed (Hz)", "Whirl frequency (Hz)");
  panel.x.lower = panel.y.lower = 0.0;
  panel.x.upper = in_hertz(diagram.speeds.back());
  panel.y.upper = highest_shown(diagram);
  for (const Look& look : looks)
    for (const auto& line : diagram.lines)
      if (has_any(line, look)) panel.add(part_of(diagram, line, look));
  const std::vector<double> ends{0.0, *panel.x.upper};
  panel.add(Series("frequency = speed", ends, ends).in(Colour::grey, Dash::dashed));
  Series critical = Series("critical speed", SeriesStyle::points).in(Colour::vermillion);
  critical.marker = 1;
  for (const CriticalSpeed& one : diagram.critical) critical.append(in_hertz(one.speed), in_hertz(one.speed));
  if (!critical.x.empty()) panel.add(std::move(critical));
  return figure;
}

}  // namespace wavebalance::app

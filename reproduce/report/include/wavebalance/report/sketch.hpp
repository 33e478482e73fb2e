#pragma once
#include <array>
#include <string>
#include <vector>

#include "wavebalance/app/files/table.hpp"
#include "wavebalance/app/plot/plot.hpp"

/// Sketches made of lines, which are written as data too.
namespace wavebalance::report {

/// A line of a sketch. Parts named "hatching" are drawn thin.
struct Polyline {
  std::string part;
  std::vector<std::array<double, 2>> points;
};

/// line, part, x, y.
app::Table polylines_table(const std::vector<Polyline>& lines);

/// A figure of one panel without frame that shows the lines. `x` and `y` bound it, in pixels per unit
/// panel_width over the range of x.
app::Figure sketch(const std::vector<Polyline>& lines, const app::Axis& x, const app::Axis& y, int width,
                   int height);

/// Strokes of `length` from each point of `line` in the direction that is 45 degrees from its normal, to
/// mark what holds or stops a body. The normal is to the right of the direction of the line.
std::vector<Polyline> hatching(const Polyline& line, double length);

}  // namespace wavebalance::report

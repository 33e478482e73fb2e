#include "drawing/figures.hpp"

#include <numbers>

#include "wavebalance/app/files/quantity_text.hpp"

namespace wavebalance::app {
namespace {

double extent_of(const OrbitPlane& plane) {
  double largest = std::isfinite(plane.clearance) ? plane.clearance : 0.0;
  for (const Orbit& orbit : plane.orbits)
    largest = std::max({largest, orbit.x.cwiseAbs().maxCoeff(), orbit.y.cwiseAbs().maxCoeff()});
  return largest;
}

Series circle(double radius) {
  constexpr int corners = 180;
  Series series = Series("clearance", SeriesStyle::line).in(Colour::grey, Dash::dashed);
  for (int i = 0; i <= corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    series.append(radius * std::cos(angle), radius * std::sin(angle));
  }
  return series;
}

/// From t = 0 on by a 40th of the path at least, so that its direction is seen.
Segment arrow_along(const Orbit& orbit, double factor, Colour colour) {
  const Eigen::Index points = orbit.x.size(), last = std::max<Eigen::Index>(1, points / 40);
  Segment arrow{factor * orbit.x[0], factor * orbit.y[0], factor * orbit.x[last], factor * orbit.y[last]};
  arrow.arrow = true;
  arrow.colour = colour;
  arrow.width = 1.6;
  return arrow;
}

void add_orbit(Panel& panel, const Orbit& orbit, double factor, Colour colour) {
  Series path(orbit.motion, SeriesStyle::line);
  for (Eigen::Index i = 0; i <= orbit.x.size(); ++i) {
    const Eigen::Index at = i % orbit.x.size();
    path.append(factor * orbit.x[at], factor * orbit.y[at]);
  }
  panel.add(std::move(path).in(colour));
  panel.segments.push_back(arrow_along(orbit, factor, colour));
}

Series beginnings(const OrbitPlane& plane, double factor) {
  Series begin = Series("t = 0", SeriesStyle::points).in(Colour::black);
  for (const Orbit& orbit : plane.orbits) begin.append(factor * orbit.x[0], factor * orbit.y[0]);
  begin.marker = 1;
  return begin;
}

}  // namespace

Figure orbits_figure(const std::vector<OrbitPlane>& planes) {
  constexpr double margin = 1.08;
  constexpr Colour colours[] = {Colour::blue,   Colour::orange,   Colour::green,
                                Colour::purple, Colour::sky_blue, Colour::vermillion};
  Figure figure;
  figure.title = planes.size() > 1 || planes.front().orbits.size() > 1 ? "Orbits" : "Orbit";
  figure.columns = planes.size() > 1 ? 2 : 1;
  figure.panel_width = 415;
  figure.panel_height = 400;  // so that axes of equal length remain
  for (const OrbitPlane& plane : planes) {
    const double extent = extent_of(plane);
    const Scale scale = axis_scale(extent);
    Panel& panel =
        figure.add_panel(plain(plane.title), "x (" + scale.prefix + "m)", "y (" + scale.prefix + "m)");
    panel.x.upper = panel.y.upper = margin * scale.factor * (extent > 0.0 ? extent : 1.0);
    panel.x.lower = panel.y.lower = -*panel.x.upper;
    if (std::isfinite(plane.clearance)) panel.add(circle(scale.factor * plane.clearance));
    for (std::size_t i = 0; i < plane.orbits.size(); ++i)
      add_orbit(panel, plane.orbits[i], scale.factor, colours[i % std::size(colours)]);
    panel.add(beginnings(plane, scale.factor));
  }
  return figure;
}

}  // namespace wavebalance::app

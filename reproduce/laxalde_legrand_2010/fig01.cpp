#include <array>
#include <cmath>
#include <numbers>

#include "figures.hpp"
#include "ll10.hpp"
#include "wavebalance/report/sketch.hpp"

namespace wavebalance::ll10 {
using app::Colour;
using report::Polyline;

namespace {

constexpr double body_gap = 0.16;
constexpr double full_turn = 2.0 * std::numbers::pi;
/// Shares of the boundary at which its parts begin: Neumann, Dirichlet, Neumann, contact.
constexpr double dirichlet_from = 0.42, dirichlet_to = 0.60, contact_from = 0.66, contact_to = 0.86;

using Point = std::array<double, 2>;

/// The boundary over the share s of its parameter, anticlockwise.
Point boundary(double s) {
  const double angle = full_turn * s,
               radius = 1.0 + 0.10 * std::cos(2.0 * angle + 0.6) + 0.05 * std::cos(3.0 * angle);
  return {1.5 * radius * std::cos(angle), radius * std::sin(angle)};
}

/// The outward unit normal there.
Point normal(double s) {
  constexpr double step = 1e-6;
  const Point before = boundary(s - step), after = boundary(s + step);
  const double dx = after[0] - before[0], dy = after[1] - before[1], length = std::hypot(dx, dy);
  return {dy / length, -dx / length};
}

/// The boundary from one share to another, `away` from it along its outward normal.
Polyline part_of(const char* name, double from, double to, double away = 0.0) {
  constexpr int points = 120;
  Polyline line{name, {}};
  for (int i = 0; i <= points; ++i) {
    const double s = from + (to - from) * i / points;
    const Point at = boundary(s), out = normal(s);
    line.points.push_back({at[0] + away * out[0], at[1] + away * out[1]});
  }
  return line;
}

/// Every twelfth point of a line.
Polyline thinned(const Polyline& line) {
  Polyline result{line.part, {}};
  for (std::size_t i = 0; i < line.points.size(); i += 12) result.points.push_back(line.points[i]);
  return result;
}

std::vector<Polyline> body_outline() {
  std::vector<Polyline> lines{
      part_of("Gamma_F", contact_to - 1.0, dirichlet_from), part_of("Gamma_D", dirichlet_from, dirichlet_to),
      part_of("Gamma_F", dirichlet_to, contact_from), part_of("Gamma_C", contact_from, contact_to),
      part_of("obstacle", contact_from, contact_to, body_gap)};
  for (const std::size_t held : {std::size_t{1}, std::size_t{4}})
    for (auto& stroke : hatching(thinned(lines[held]), 0.10)) lines.push_back(std::move(stroke));
  return lines;
}

void annotate_body(app::Panel& panel) {
  const auto text = [&](const Point& at, const char* words) { panel.texts.push_back({at[0], at[1], words}); };
  const auto arrow = [&](const Point& from, const Point& to, Colour colour) {
    panel.segments.push_back({from[0], from[1], to[0], to[1], true, app::Dash::solid, colour, 1.6});
  };
  const auto off = [](double s, double away) {
    const Point at = boundary(s), out = normal(s);
    return Point{at[0] + away * out[0], at[1] + away * out[1]};
  };
  text({0.0, 0.1}, "Ω");
  text(off(0.17, 0.17), "Γ_F");
  text(off(0.51, 0.28), "Γ_D");
  text(off(0.76, -0.16), "Γ_C");
  constexpr double at_normal = 0.80, at_gap = 0.71;
  arrow(boundary(at_normal), off(at_normal, 0.5), Colour::black);
  text(off(at_normal + 0.012, 0.52), "{/:Bold n}");
  arrow(boundary(at_gap), off(at_gap, body_gap), Colour::black);
  arrow(off(at_gap, body_gap), boundary(at_gap), Colour::black);
  text(off(at_gap + 0.02, 0.085), "{/:Italic g}_0");
  text(off(0.845, 0.36), "rigid obstacle");
}

}  // namespace

void fig01(report::Artefact& artefact) {
  const auto lines = body_outline();
  artefact.data(polylines_table(lines), "any unit of length",
                {"Gamma_C, Gamma_D and Gamma_F are the three parts of the boundary, points anticlockwise",
                 "obstacle: the points of Gamma_C at the gap along their outward normals"});
  auto figure = sketch(lines, axis("", -2.0, 2.0), axis("", -1.55, 1.25), 560, 392);
  auto& series = figure.panels.front().series;
  series[1].colour = Colour::blue;        // Gamma_D
  series[3].colour = Colour::vermillion;  // Gamma_C
  series[1].width = series[3].width = 3.0;
  annotate_body(figure.panels.front());
  artefact.picture(figure);
  artefact.caption(
      "The notations of section 2.1: a flexible body $\\Omega$ with the held boundary $\\Gamma_D$, the boundary $\\Gamma_C$ "
      "that may touch, and the free one $\\Gamma_F$. The gap $g_0$ is along the outward normal $n$.");
}

}  // namespace wavebalance::ll10

#include "figures.hpp"
#include "jl14.hpp"
#include "wavebalance/report/sketch.hpp"

namespace wavebalance::jl14 {
using app::Colour;
using report::Polyline;

namespace {

/// The sketch in units of the bar's length.
std::vector<Polyline> outline() {
  std::vector<Polyline> lines{
      {"clamp", {{0, -0.22}, {0, 0.22}}},
      {"bar", {{0, -0.08}, {1, -0.08}, {1, 0.08}, {0, 0.08}}},
      {"spring plate", {{1.14, -0.11}, {1.14, 0.11}}},
      {"foundation", {{1.42, -0.22}, {1.42, 0.22}}},
      {"spring", {{1.14, 0}, {1.18, 0}}},
  };
  for (int tooth = 0; tooth < 8; ++tooth)
    lines.back().points.push_back({1.195 + 0.025 * tooth, tooth % 2 == 0 ? 0.05 : -0.05});
  lines.back().points.insert(lines.back().points.end(), {{1.385, 0}, {1.42, 0}});
  for (int stroke = 0; stroke < 8; ++stroke) {
    const double y = -0.21 + 0.055 * stroke;
    lines.push_back({"hatching", {{-0.04, y - 0.03}, {0, y + 0.02}}});
    lines.push_back({"hatching", {{1.42, y - 0.03}, {1.46, y + 0.02}}});
  }
  return lines;
}

void annotate(app::Panel& panel) {
  const auto arrow = [&](double x1, double y1, double x2, double y2) {
    panel.segments.push_back({x1, y1, x2, y2, true, app::Dash::solid, Colour::black, 1.3});
  };
  const auto line = [&](double x1, double y1, double x2, double y2) {
    panel.segments.push_back({x1, y1, x2, y2, false, app::Dash::solid, Colour::grey, 0.8});
  };
  const auto text = [&](double x, double y, const char* words) { panel.texts.push_back({x, y, words}); };
  panel.rectangles.push_back({0, -0.08, 1, 0.08, Colour::sky_blue, 0.35});
  arrow(0, -0.17, 0.2, -0.17);
  text(0.24, -0.17, "{/:Italic x}");
  text(0.3, 0, "{/:Italic E, S, ρ, ℓ};  {/:Italic C} = β{/:Italic K}");
  // The dimension of the gap, with lines down to what it measures.
  line(1, 0.09, 1, 0.2);
  line(1.14, 0.12, 1.14, 0.2);
  arrow(1.07, 0.17, 1.14, 0.17);
  arrow(1.07, 0.17, 1, 0.17);
  text(1.07, 0.225, "gap {/:Italic g}");
  text(1.28, 0.11, "{/:Italic K}_p");
  // The force at the tip, and its displacement.
  arrow(0.83, 0, 1, 0);
  text(0.72, 0, "{/:Italic F} cos 2π{/:Italic ft}");
  arrow(1, -0.13, 1.1, -0.13);
  text(1.04, -0.185, "{/:Italic u}(ℓ, {/:Italic t})");
}

}  // namespace

void fig01(report::Artefact& artefact) {
  const auto lines = outline();
  auto figure = report::sketch(lines, axis("", -0.1, 1.52), axis("", -0.26, 0.27), 760, 270);
  annotate(figure.panels.front());
  artefact.data(report::polylines_table(lines), "units of the bar's length");
  artefact.picture(figure);
  artefact.caption(
      "The bar clamped at $x = 0$, the gap $g$ and the exponential spring $K_p$ of eq. (5), with the force at "
      "the tip (the paper does not say where it acts; the tip gives its displacements without contact).");
}

}  // namespace wavebalance::jl14

#include <fmt/format.h>

#include "figures.hpp"
#include "ll10.hpp"
#include "wavebalance/report/sketch.hpp"

namespace wavebalance::ll10 {
using app::Colour;
using report::Polyline;

namespace {

/// The sketch in units of the rod's length.
std::vector<Polyline> outline() {
  std::vector<Polyline> lines{
      {"clamp", {{0, -0.2}, {0, 0.2}}},
      {"rod", {{0, -0.06}, {1, -0.06}, {1, 0.06}, {0, 0.06}}},
      {"obstacle", {{1.12, -0.2}, {1.12, 0.2}}},
  };
  for (int stroke = 0; stroke < 8; ++stroke) {
    const double y = -0.19 + 0.05 * stroke;
    lines.push_back({"hatching", {{-0.04, y - 0.03}, {0, y + 0.02}}});
    lines.push_back({"hatching", {{1.12, y - 0.03}, {1.16, y + 0.02}}});
  }
  return lines;
}

void annotate(app::Panel& panel) {
  const auto arrow = [&](double x1, double y1, double x2, double y2) {
    panel.segments.push_back({x1, y1, x2, y2, true, app::Dash::solid, Colour::black, 1.3});
  };
  const auto text = [&](double x, double y, const char* words) { panel.texts.push_back({x, y, words}); };
  panel.rectangles.push_back({0, -0.06, 1, 0.06, Colour::sky_blue, 0.35});
  arrow(0, -0.15, 0.2, -0.15);
  text(0.24, -0.15, "{/:Italic x}");
  text(0.5, 0, "{/:Italic E, ρ, A, L}");
  arrow(1, 0.14, 1.12, 0.14);
  arrow(1.12, 0.14, 1, 0.14);
  text(1.06, 0.19, "{/:Italic g}_0");
  arrow(0.8, 0.12, 0.98, 0.12);
  text(0.72, 0.16, "{/:Italic u}({/:Italic L}, {/:Italic t}) ≤ {/:Italic g}_0");
}

}  // namespace

void fig02(report::Artefact& artefact) {
  const auto lines = outline();
  artefact.data(polylines_table(lines), "units of the rod's length");
  auto figure = sketch(lines, axis("", -0.08, 1.2), axis("", -0.23, 0.24), 700, 250);
  annotate(figure.panels.front());
  artefact.picture(figure);
  const auto& rod = artefact.scene("rod.toml").structure;
  artefact.caption(fmt::format(
      "The rod clamped at x = 0 and the rigid obstacle at the gap before its tip: E = {} Pa, density {} "
      "kg/m³, area {} m², length {} m. The displacement towards the obstacle is positive.",
      report::number(rod.youngs_modulus), report::number(rod.density, 4), report::number(rod.area),
      report::number(rod.length)));
}

}  // namespace wavebalance::ll10

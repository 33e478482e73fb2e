#include "drawing/mode_figure.hpp"

#include <cmath>
#include <utility>

#include "wavebalance/app/drawing/stability_figure.hpp"

namespace wavebalance::app {
namespace {

/// `y` where `shown`, and where `beside` it there is a point that is shown.
std::vector<double> selected(const std::vector<double>& y, const std::vector<bool>& shown, bool beside) {
  std::vector<double> result(y.size(), std::nan(""));
  for (std::size_t i = 0; i < y.size(); ++i) {
    const bool near = beside && ((i > 0 && shown[i - 1]) || (i + 1 < y.size() && shown[i + 1]));
    if (shown[i] || near) result[i] = y[i];
  }
  return result;
}

}  // namespace

void draw_stability(Figure& figure, const Table& backbone, const ModeStudy& study,
                    const solvers::BackboneStability& stability) {
  if (stability.points.empty() || figure.panels.empty()) return;
  Panel& panel = figure.panels.front();
  const std::vector<double> energy = backbone.numbers("energy_ratio"),
                            unstable = backbone.numbers("unstable");
  const std::vector<double> solved = panel.series.front().y;  // without points that were not accepted
  std::vector<bool> is_stable(solved.size()), is_unstable(solved.size()), is_unknown(solved.size());
  bool any_unstable = false, any_unknown = false;
  for (std::size_t i = 0; i < solved.size(); ++i) {
    is_stable[i] = unstable[i] == 0.0;
    is_unstable[i] = unstable[i] > 0.0;
    is_unknown[i] = std::isnan(unstable[i]) && !std::isnan(solved[i]);
    any_unstable = any_unstable || (is_unstable[i] && !std::isnan(solved[i]));
    any_unknown = any_unknown || is_unknown[i];
  }
  Series stable("ω", energy, selected(solved, is_stable, false));
  stable.colour = Colour::blue;
  Series dashed("ω, unstable", energy, selected(solved, is_unstable, true));
  dashed.colour = Colour::blue;
  dashed.dash = Dash::dashed;
  Series unknown("ω, stability unknown", energy, selected(solved, is_unknown, false), SeriesStyle::points);
  unknown.colour = Colour::blue;
  panel.series.front() = std::move(stable);
  auto next = panel.series.begin() + 1;
  if (any_unstable) next = panel.series.insert(next, std::move(dashed)) + 1;
  if (any_unknown) panel.series.insert(next, std::move(unknown));
  std::vector<PlacedPoint> marks;
  for (const auto& point : stability.special_points)
    marks.push_back({point.type, point.energy_ratio, point.omega / study.mode().linear_omega()});
  draw_special_points(panel, marks);
}

}  // namespace wavebalance::app

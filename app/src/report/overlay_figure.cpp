
#include "files/missing.hpp"
#include "plot/plot_parts.hpp"
#include "report/overlay.hpp"
#include "wavebalance/app/drawing/stability_figure.hpp"
#include "wavebalance/app/files/quantity_text.hpp"

namespace wavebalance::app {
namespace {

bool any_number(const Series& series) {
  return std::ranges::any_of(series.y, [](double value) { return std::isfinite(value); });
}

void draw(Panel& panel, const OverlayCurve& curve, Colour colour, double factor) {
  Series series(plain(curve.label), curve.time.empty() ? curve.frequency : curve.time, curve.displacement);
  for (double& value : series.y) value *= factor;
  series.colour = colour;
  if (curve.kind == "response" || curve.of_diagram()) series.style = SeriesStyle::points;
  if (curve.kind == "nonlinear_mode") series.width = 2.4;
  if (series.x.size() < 2 || curve.of_diagram()) {
    panel.add(std::move(series));
    return;
  }
  std::vector<bool> unstable;
  for (const double count : curve.unstable) unstable.push_back(count > 0.0);
  auto [solid, dashed] = parts_by_stability(series, unstable);
  if (any_number(solid) || !any_number(dashed)) panel.add(std::move(solid));
  if (any_number(dashed)) panel.add(std::move(dashed));
}

/// Second frequencies of quasi-periodic motions, in a panel below the curves.
void add_second_frequencies(Figure& figure, const Overlay& overlay, const std::vector<Colour>& colours) {
  for (std::size_t i = 0; i < overlay.curves.size(); ++i) {
    const OverlayCurve& curve = overlay.curves[i];
    if (curve.second_frequency.empty()) continue;
    if (figure.panels.size() < 2) {
      figure.add_panel("Second frequency of quasi-periodic motions").x.label = overlay.axis.label();
      figure.panels.back().y.label = "Frequency (Hz)";
      figure.panel_height = 300;
    }
    Series series("", curve.frequency, curve.second_frequency, SeriesStyle::points);
    series.colour = colours[i];
    figure.panels.back().add(std::move(series));
  }
}

}  // namespace

Figure overlay_figure(const Overlay& overlay) {
  const OverlayQuantity& quantity = overlay.quantity;
  constexpr std::array colours{Colour::blue,   Colour::orange,   Colour::green,
                               Colour::purple, Colour::sky_blue, Colour::vermillion};
  double largest = 0.0;
  for (const OverlayCurve& curve : overlay.curves)
    for (const double value : curve.displacement)
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  const Scale scale = axis_scale(largest, quantity.unit);
  Figure figure;
  figure.panel_width = 640;
  figure.panel_height = 420;
  Panel& panel = figure.add_panel();
  const bool over_time = is_over_time(overlay);
  panel.x.label = over_time ? "Time (fraction of a period)" : overlay.axis.label();
  const std::string words = quantity.is_output() && over_time ? quantity.name : quantity.words;
  panel.y.label = over_time && !quantity.is_output() ? "Displacement" : capitalised(plain(words));
  if (!quantity.unit.empty()) panel.y.label += fmt::format(" ({}{})", scale.prefix, quantity.unit);
  std::size_t next = 0;
  std::vector<Colour> taken;
  for (const OverlayCurve& curve : overlay.curves) {
    const bool mode = curve.kind == "nonlinear_mode";
    taken.push_back(mode ? Colour::black : colours[next++ % colours.size()]);
    draw(panel, curve, taken.back(), scale.factor);
  }
  const bool is_largest = quantity.name == "max" || quantity.name == "max_abs";
  if (std::isfinite(overlay.gap) && !quantity.is_output() && (over_time || is_largest))
    panel.mark_level(scale.factor * overlay.gap, "gap", app::quantity(overlay.gap, quantity.unit));
  add_second_frequencies(figure, overlay, taken);
  if (overlay.logarithmic && !over_time) take_logarithmic_ordinates(figure);
  return figure;
}

bool is_over_time(const Overlay& overlay) {
  return !overlay.curves.empty() && overlay.curves.front().kind == "motion";
}

Table overlay_table(const Overlay& overlay) {
  std::vector<std::string> columns{"curve", "kind", overlay.axis.column(), "displacement_m", "unstable"};
  const bool over_time = is_over_time(overlay);
  if (overlay.quantity.is_output())
    columns[3] = over_time ? overlay.quantity.motion : overlay.quantity.column;
  if (over_time) columns.insert(columns.begin() + 3, "time_fraction");
  const bool second = std::ranges::any_of(
      overlay.curves, [](const OverlayCurve& curve) { return !curve.second_frequency.empty(); });
  if (second) columns.emplace_back("second_frequency_Hz");
  Table table(columns);
  for (const OverlayCurve& curve : overlay.curves)
    for (std::size_t i = 0; i < curve.frequency.size(); ++i) {
      std::vector<Cell> row{curve.label, curve.kind, curve.frequency[i], curve.displacement[i],
                            curve.unstable[i]};
      if (over_time) row.insert(row.begin() + 3, curve.time[i]);
      if (second) row.emplace_back(curve.second_frequency.empty() ? missing : curve.second_frequency[i]);
      table.append_row(std::move(row));
    }
  return table;
}

}  // namespace wavebalance::app

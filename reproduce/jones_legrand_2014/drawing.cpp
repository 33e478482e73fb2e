#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "jl14.hpp"

namespace wavebalance::jl14 {

using app::Colour;
using app::Figure;
using app::Panel;
using app::plain;
using app::SeriesStyle;

Series periodic_series(const std::string& label, const Eigen::VectorXd& values, double from) {
  const Eigen::Index n = values.size();
  const auto first = static_cast<Eigen::Index>(std::lround(from * static_cast<double>(n)));
  Eigen::VectorXd x(n + 1), y(n + 1);
  for (Eigen::Index i = 0; i <= n; ++i) {
    x[i] = static_cast<double>(first + i) / static_cast<double>(n);
    y[i] = values[((first + i) % n + n) % n];
  }
  return Series(label, x, y);
}

Series reference_series(const Eigen::VectorXd& values, double from) {
  return report::styled(periodic_series(reference_label, values, from), Colour::black,
                        {.dash = app::Dash::dashed, .width = 1.1});
}

app::Axis fitted_axis(const std::string& label, const Values& curves) {
  double lower = std::numeric_limits<double>::infinity(), upper = -lower;
  for (const auto& curve : curves)
    for (const double value : curve) {
      if (!std::isfinite(value)) continue;
      lower = std::min(lower, value);
      upper = std::max(upper, value);
    }
  if (!(lower <= upper)) throw std::invalid_argument("fitted_axis: no values; it takes one or more");
  const double margin = 0.06 * std::max(upper - lower, 1e-12 * std::max(std::abs(upper), 1.0));
  return axis(label, lower - margin, upper + margin);
}

Eigen::VectorXd window(const Eigen::VectorXd& values, double from, double to) {
  const auto n = static_cast<double>(values.size());
  const auto first = static_cast<Eigen::Index>(std::ceil(from * n - 1e-9)),
             last = static_cast<Eigen::Index>(std::floor(to * n + 1e-9));
  return Eigen::VectorXd::NullaryExpr(
      last - first + 1, [&](Eigen::Index i) { return values[(first + i + values.size()) % values.size()]; });
}

std::pair<double, double> contact_interval(const Case& study, double from) {
  const Eigen::VectorXd all = study.reference().force(),
                        force = from < 0.0 ? shifted_by_half_a_period(all) : all;
  Eigen::Index first = 0, last = force.size() - 1;
  while (force[first] <= 0.0) ++first;
  while (force[last] <= 0.0) --last;
  const auto n = static_cast<double>(force.size());
  return {static_cast<double>(first) / n + from, static_cast<double>(last) / n + from};
}

std::vector<Panel> pair_view(const PairView& view, bool haar_apart) {
  const auto chosen = panel_pairs();
  const Values values = in_panels(view.values);
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    Values shown{window(view.reference, view.from, view.to)};
    for (std::size_t other = 0; other < chosen.size(); ++other)
      if (!haar_apart || has_haar_trial(chosen[i]) == has_haar_trial(chosen[other]))
        shown.push_back(window(values[other], view.from, view.to));
    Panel& panel = panels.emplace_back();
    const double from = std::min(view.from, 0.0);
    panel.add(report::styled(periodic_series(chosen[i].label, values[i], from), chosen[i].colour))
        .add(reference_series(view.reference, from));
    panel.x = axis(time_label, view.from, view.to);
    panel.y = fitted_axis(view.label, shown);
    panel.legend = false;
    if (view.level) panel.mark_y(*view.level);
  }
  return panels;
}

Figure pair_rows(const std::string& title, app::TextMark key, std::vector<Panel> panels,
                 std::vector<Panel> more, const std::string& second) {
  const auto chosen = panel_pairs();
  Figure figure;
  figure.columns = 2;
  figure.panel_width = 400;
  figure.panel_height = more.empty() ? 260 : 215;
  figure.letters = false;
  figure.title = title;
  key.text = std::string("dashed: ") + reference_label;
  panels.at(0).texts.push_back(std::move(key));
  for (std::size_t row = 0; row < chosen.size(); ++row) {
    Panel& panel = panels.at(row);
    panel.title = std::string("{/:Bold (") + static_cast<char>('a' + row) + ")}  " + plain(chosen[row].label);
    // The abscissa has its name at the foot of each column only.
    const bool last = row + (more.empty() ? 2 : 1) >= chosen.size();
    if (!last) panel.x.label.clear();
    figure.panels.push_back(panel);
    if (more.empty()) continue;
    Panel& beside = more.at(row);
    if (beside.title.empty()) beside.title = second;
    if (!last) beside.x.label.clear();
    figure.panels.push_back(beside);
  }
  return figure;
}

Figure levels_figure(const Table& table, const std::string& name, SeriesStyle style) {
  Figure figure;
  figure.columns = 2;
  figure.panel_width = 400;
  figure.panel_height = 230;
  for (int level = 0; level <= 5; ++level) {
    const std::vector<double> values = table.numbers("level_" + std::to_string(level));
    Panel& panel = figure.add_panel("J = " + std::to_string(level));
    Series series = periodic_series(
        "", Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size())));
    if (style == SeriesStyle::steps) series.y.back() = values.back();  // the cell ends, the next is not drawn
    series.style = style;
    series.colour = Colour::blue;
    panel.add(std::move(series));
    panel.x = axis(level >= 4 ? time_label : "", 0.0, 1.0);
    panel.y = axis(name, -0.45 * (1 << level), 1.45 * (1 << level));
    if (level == 0) panel.y.ticks = {0.0, 0.5, 1.0};
  }
  return figure;
}

}  // namespace wavebalance::jl14

#include "drawing/figures.hpp"

#include "wavebalance/app/files/quantity_text.hpp"

namespace wavebalance::app {
namespace {

/// The impacts of a contact in the order in which the window shows them, with their instants there.
std::vector<solvers::Impact> shown_impacts(const PeriodWindow& window,
                                           const std::vector<solvers::Impact>& all, int contact) {
  std::vector<solvers::Impact> impacts;
  for (solvers::Impact one : all) {
    if (one.contact != contact) continue;
    one.time = window.instant(one.time);
    impacts.push_back(one);
  }
  std::ranges::sort(impacts, [](const auto& a, const auto& b) { return a.time < b.time; });
  return impacts;
}

}  // namespace

void add_velocity_with_jumps(Figure& figure, const PeriodWindow& window, const std::string& title,
                             const std::vector<solvers::Impact>& all, int contact,
                             const Eigen::VectorXd& velocity) {
  std::vector<double> times, values;
  const Series samples = window.curve(velocity);
  const std::vector<solvers::Impact> impacts = shown_impacts(window, all, contact);
  auto impact = impacts.begin();
  for (std::size_t l = 0; l < samples.x.size(); ++l) {
    for (; impact != impacts.end() && impact->time <= samples.x[l]; ++impact) {
      times.insert(times.end(), {impact->time, impact->time});
      values.insert(values.end(), {impact->velocity_before, impact->velocity_after});
    }
    times.push_back(samples.x[l]);
    values.push_back(samples.y[l]);
  }
  const Scale scale = take_to_scale(values);
  Panel& panel = figure.add_panel(title);
  panel.x = window.axis();
  panel.y.label = "Velocity (" + scale.prefix + "m/s)";
  panel.add({"", times, values});
}

void add_impulses(Figure& figure, const PeriodWindow& window, const std::string& title,
                  const std::vector<solvers::Impact>& all, int contact) {
  std::vector<double> times, impulses;
  for (const solvers::Impact& impact : shown_impacts(window, all, contact)) {
    times.push_back(impact.time);
    impulses.push_back(impact.impulse);
  }
  if (impulses.empty()) return;
  const double largest = *std::ranges::max_element(impulses);
  const Scale scale = take_to_scale(impulses);
  Panel& panel = figure.add_panel(title);
  panel.x = window.axis();
  panel.y.label = "Impulse (" + scale.prefix + "N s)";
  panel.y.lower = 0.0;
  if (largest > 0.0) panel.y.upper = 1.1 * scale.factor * largest;
  panel.add({"", times, impulses, SeriesStyle::impulses});
}

}  // namespace wavebalance::app

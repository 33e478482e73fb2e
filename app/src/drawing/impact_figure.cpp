#include "drawing/impact_figure.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "plot/unit_prefix.hpp"

namespace wavebalance::app {
namespace {

Axis time_axis(int periods) {
  return {
      .label = "Time (fraction of " +
               (periods == 1 ? std::string("a period") : std::to_string(periods) + " periods of the load") +
               ")",
      .lower = 0.0,
      .upper = 1.0,
      .ticks = {},
      .tick_format = "%.1f"};
}

}  // namespace

void add_velocity_with_jumps(Figure& figure, const solvers::ImpactResponse& response, int contact,
                             const Eigen::VectorXd& velocity) {
  std::vector<double> times, values;
  const auto points = static_cast<std::size_t>(velocity.size());
  auto impact = response.motion.impacts.begin();
  for (std::size_t l = 0; l <= points; ++l) {
    const double time = double(l) / double(points);
    for (; impact != response.motion.impacts.end() && impact->time <= time; ++impact) {
      if (impact->contact != contact) continue;
      times.insert(times.end(), {impact->time, impact->time});
      values.insert(values.end(), {impact->velocity_before, impact->velocity_after});
    }
    times.push_back(time);
    values.push_back(velocity[static_cast<Eigen::Index>(l % points)]);
  }
  double largest = 0.0;
  for (const double one : values) largest = std::max(largest, std::abs(one));
  const Scale scale = axis_scale(largest);
  for (double& one : values) one *= scale.factor;
  Panel& panel = figure.add_panel();
  panel.x = time_axis(response.load_periods);
  panel.y.label = "Velocity (" + scale.prefix + "m/s)";
  panel.add({"", times, values});
}

void add_impulses(Figure& figure, const solvers::ImpactResponse& response, int contact) {
  std::vector<double> times, impulses;
  for (const solvers::Impact& impact : response.motion.impacts) {
    if (impact.contact != contact) continue;
    times.push_back(impact.time);
    impulses.push_back(impact.impulse);
  }
  const double largest = impulses.empty() ? 0.0 : *std::max_element(impulses.begin(), impulses.end());
  const Scale scale = axis_scale(largest);
  for (double& one : impulses) one *= scale.factor;
  Panel& panel = figure.add_panel();
  panel.x = time_axis(response.load_periods);
  panel.y.label = "Impulse (" + scale.prefix + "N s)";
  panel.y.lower = 0.0;
  if (largest > 0.0) panel.y.upper = 1.1 * scale.factor * largest;
  if (largest == 0.0) panel.y.upper = 1.0;
  panel.add({"", times, impulses, SeriesStyle::impulses});
}

}  // namespace wavebalance::app

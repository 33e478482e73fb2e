#include "drawing/figures.hpp"

namespace wavebalance::app {

bool SweepLine::is_unstable() const {
  return std::ranges::any_of(stability.points, [](const auto& point) { return point.unstable > 0; });
}

std::vector<double> SweepLine::vibration(std::optional<std::size_t> output, bool rms) const {
  std::vector<double> values(curve.points.size(), std::nan(""));
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!output) {
      values[i] = rms ? curve.points[i].rms_vibration : curve.points[i].vibration;
    } else if (measured != nullptr && i < measured->size() && !(*measured)[i].empty()) {
      const OutputMeasures& one = (*measured)[i][*output];
      values[i] = rms ? one.rms : one.half_peak_to_peak();
    }
  return values;
}

std::vector<double> SweepLine::harmonic(std::size_t output, int n) const {
  std::vector<double> values(curve.points.size(), std::nan(""));
  for (std::size_t i = 0; measured != nullptr && i < std::min(values.size(), measured->size()); ++i) {
    if ((*measured)[i].empty()) continue;
    const Eigen::VectorXcd& harmonics = (*measured)[i][output].harmonics;
    if (n <= harmonics.size()) values[i] = std::abs(harmonics[n - 1]);
  }
  return values;
}

Series SweepLine::series(const std::string& label, const std::vector<double>& values, double factor) const {
  Series drawn;
  drawn.label = label;
  drawn.colour = colour;
  for (const auto& point : curve.points) drawn.x.push_back(parameter_of(point, curve.parameter));
  for (const double value : values) drawn.y.push_back(factor * value);
  return drawn;
}

std::vector<PlacedPoint> SweepLine::placed(
    const std::function<double(const solvers::SpecialPoint&)>& height) const {
  std::vector<PlacedPoint> marks;
  for (const solvers::SpecialPoint& one : special_points)
    marks.push_back({one.type, parameter_of(one, curve.parameter), height(one)});
  return marks;
}

std::vector<SweepLine> lines_of(const Sweep& sweep, const SweepOutputs& outputs) {
  constexpr std::array colours{Colour::green, Colour::vermillion, Colour::purple, Colour::sky_blue};
  const auto measured = [](const auto& all, std::size_t i) { return i < all.size() ? &all[i] : nullptr; };
  std::vector<SweepLine> lines;
  lines.push_back({"", "", sweep.curve, sweep.stability_of(0), sweep.stability.special_points,
                   measured(outputs.curves, 0), Colour::blue});
  const auto next_colour = [&] { return colours[(lines.size() - 1) % colours.size()]; };
  for (std::size_t i = 0; i < sweep.branches.size(); ++i) {
    const solvers::Branch& branch = sweep.branches[i];
    const int periods = branch.periods * sweep.periods;
    const std::string name = "branch " + std::to_string(i + 1);
    lines.push_back({name, name + ", " + std::to_string(periods) + (periods == 1 ? " period" : " periods"),
                     branch.curve, sweep.stability_of(i + 1), branch.stability.special_points,
                     measured(outputs.curves, i + 1), next_colour()});
  }
  for (std::size_t i = 0; i < sweep.isolas.size(); ++i) {
    const Sweep& isola = sweep.isolas[i];
    const std::string name = "isola " + std::to_string(i + 1);
    lines.push_back({name, name, isola.curve, isola.stability_of(0), isola.stability.special_points,
                     measured(outputs.isolas, i), next_colour()});
  }
  return lines;
}

}  // namespace wavebalance::app

#include "curve_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "wavebalance/app/compose/compose.hpp"
#include "wavebalance/report/artefact.hpp"

namespace wavebalance::blade {
namespace {

/// The point of indices first..last - 1 whose frequency is nearest to `frequency`; the first of them.
std::size_t index_of(const std::vector<solvers::SweepPoint>& points, std::size_t first, std::size_t last,
                     double frequency) {
  const auto nearer = [&](const auto& a, const auto& b) {
    return std::abs(a.frequency - frequency) < std::abs(b.frequency - frequency);
  };
  const auto begin = points.begin();
  return static_cast<std::size_t>(std::min_element(begin + static_cast<std::ptrdiff_t>(first),
                                                   begin + static_cast<std::ptrdiff_t>(last), nearer) -
                                  begin);
}

}  // namespace

std::string CurveParts::counts_text() const {
  std::string text;
  for (const PointCount& one : counts)
    text += fmt::format("{}{} at {} Hz", text.empty() ? "" : ", ",
                        one.unstable < 0 ? std::string("not known") : std::to_string(one.unstable),
                        report::number(one.frequency, 5));
  return text;
}

CurveParts curve_parts(const app::Scene& scene, const app::StructureModel& model, const app::Sweep& sweep) {
  const auto& points = sweep.curve.points;
  const auto& turns = sweep.curve.turning_points;
  CurveParts parts;
  if (turns.size() < 2) return parts;
  const auto below = [](const auto& a, const auto& b) { return a.frequency < b.frequency; };
  const auto upper = std::max_element(turns.begin(), turns.end(), below);
  const auto lower = std::min_element(upper, turns.end(), below);
  parts.folds = {*upper, *lower};
  // The curve goes up to the first fold and back to the second, whose point is the lowest after it.
  const std::size_t highest = index_of(points, 0, points.size(), upper->frequency);
  const std::size_t back = index_of(points, highest, points.size(), lower->frequency);
  const std::array<std::size_t, 4> ends{0, highest, back, points.size() - 1};
  solvers::ContactProblem problem = app::compose_problem(scene, model);
  const auto count = [&](const solvers::SweepPoint& point) -> PointCount {
    const auto response = problem.response(sweep.curve, point.frequency, point.unknown);
    return {point.frequency, problem.stability(response).unstable};
  };
  parts.points.resize(points.size());
  for (std::size_t part = 0; part < 3; ++part) {
    const double from = points[ends[part]].frequency, to = points[ends[part + 1]].frequency;
    for (const double share : {1.0 / 3.0, 2.0 / 3.0})
      parts.counts.push_back(
          count(points[index_of(points, ends[part], ends[part + 1] + 1, from + share * (to - from))]));
    const int one = parts.counts.end()[-2].unstable, other = parts.counts.back().unstable;
    for (std::size_t i = ends[part] + (part > 0 ? 1 : 0); i <= ends[part + 1]; ++i)
      parts.points[i].unstable = one == other ? one : -1;
  }
  return parts;
}

}  // namespace wavebalance::blade

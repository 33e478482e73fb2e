#include "wavebalance/app/compare/comparison.hpp"

#include <fmt/format.h>

#include <set>

namespace wavebalance::app {
namespace {

Series time_series(const std::string& label, const std::vector<SolvePoint>& points, SeriesStyle style) {
  Series series(label, style);
  for (const SolvePoint& point : points) series.append(point.seconds, point.error);
  return series;
}

Series least_errors(const BasisPair& pair, const std::vector<SolvePoint>& points) {
  std::map<int, double> least;
  for (const SolvePoint& point : points_of(pair, points))
    if (point.converged && point.error > 0.0) {
      const auto found = least.try_emplace(point.functions, point.error).first;
      found->second = std::min(found->second, point.error);
    }
  Series series(label_of(pair), SeriesStyle::line_points);
  for (const auto& [functions, error] : least) series.append(functions, error);
  return styled(std::move(series), pair);
}

Panel& add_error_panel(Figure& figure, const std::string& abscissa, ErrorMeasure measure) {
  figure.panel_width = 900;
  figure.panel_height = 460;
  Panel& panel = figure.add_panel("", abscissa, "Relative rms error of " + subject_of(measure));
  panel.x.logarithmic = panel.y.logarithmic = true;
  return panel;
}

/// How fast the curves of each pair come to the exact one, or to the finest one where there is none.
void add_distances(Figure& figure, const SweepComparison& comparison) {
  const bool exact = comparison.exact.has_value();
  Panel& panel = figure.add_panel(fmt::format("Distance from the {} curve", exact ? "exact" : "finest"),
                                  "Functions", "Distance (-)");
  panel.x.logarithmic = panel.y.logarithmic = true;
  std::map<std::string, Series> pairs;
  for (const ComparedCurve& curve : comparison.curves) {
    const double distance = exact ? curve.distance_from_exact : curve.distance;
    if (!(distance > 0.0)) continue;
    const Series empty = styled({"", SeriesStyle::line_points}, curve.pair);
    pairs.try_emplace(name_of(curve.pair), empty).first->second.append(curve.functions, distance);
  }
  for (auto& [name, series] : pairs) panel.add(std::move(series));
  if (pairs.empty()) figure.panels.pop_back();
}

/// Only where errors come near it.
void mark_reference(Panel& panel, const Comparison& comparison) {
  double least = std::numeric_limits<double>::infinity();
  for (const SolvePoint& point : comparison.points)
    if (point.converged) least = std::min(least, point.error);
  const double own = comparison.reference.error_by(comparison.measure);
  if (least >= 10.0 * own) return;
  panel.mark_y(own);
  double drawn = std::numeric_limits<double>::infinity();
  for (const Series& series : panel.series)
    for (const double error : series.y)
      if (error > 0.0) drawn = std::min(drawn, error);
  if (own > 0.0 && own < drawn)
    panel.y.lower = std::pow(10.0, std::floor(std::log10(own)));  // else below the axis
}

}  // namespace

Series pareto_front(const std::vector<SolvePoint>& points) {
  Series one = time_series("Pareto front", envelope(points), SeriesStyle::steps).in(Colour::grey);
  one.width = 5.0;
  return one;
}

Series best_of(const BasisPair& pair, const std::vector<SolvePoint>& points) {
  return styled(time_series(label_of(pair), envelope(points_of(pair, points)), SeriesStyle::line_points),
                pair);
}

std::vector<BasisPair> leading_pairs(std::vector<BasisPair> pairs, const std::vector<SolvePoint>& points,
                                     std::size_t most) {
  const auto lead = [&](const BasisPair& pair) {
    const auto own = points_of(pair, points);
    return std::ranges::count_if(own, &SolvePoint::on_front);
  };
  std::ranges::stable_sort(pairs, [&](const BasisPair& a, const BasisPair& b) {
    if (a.is_fourier() != b.is_fourier()) return a.is_fourier();
    return lead(a) > lead(b);
  });
  pairs.resize(std::min(most, pairs.size()));
  return pairs;
}

Figure error_over_time(const Comparison& comparison) {
  Figure figure;
  figure.title = "Error over solve time";
  Panel& panel = add_error_panel(figure, "Solve time (processor seconds)", comparison.measure);
  panel.add(pareto_front(comparison.points));
  std::vector<BasisPair> pairs;
  for (const PairResult& pair : comparison.pairs)
    if (pair.converged > 0 && !pair.pair.is_exact()) pairs.push_back(pair.pair);
  constexpr std::size_t most = 6;
  for (const BasisPair& pair : leading_pairs(pairs, comparison.points, most))
    panel.add(best_of(pair, comparison.points));
  if (!points_of(BasisPair::exact(), comparison.points).empty())
    panel.add(best_of(BasisPair::exact(), comparison.points));
  mark_reference(panel, comparison);
  return figure;
}

Figure error_over_functions(const Comparison& comparison) {
  Figure figure;
  figure.title = "Error over functions, with the best number of points";
  Panel& panel = add_error_panel(figure, "Functions", comparison.measure);
  for (const PairResult& pair : comparison.pairs)
    if (pair.converged > 0 && !pair.pair.is_exact()) panel.add(least_errors(pair.pair, comparison.points));
  mark_reference(panel, comparison);
  return figure;
}

Figure curves_figure(const SweepComparison& comparison) {
  Figure figure;
  figure.title = "Responses over the " + comparison.quantity + ", the most functions of each pair";
  figure.panel_width = 900;
  figure.panel_height = 460;
  Panel& panel = figure.add_panel("Responses", comparison.axis, "Largest displacement (mm)");
  std::set<std::string> drawn;
  for (auto curve = comparison.curves.rbegin(); curve != comparison.curves.rend(); ++curve) {
    if (!curve->converged() || !drawn.insert(name_of(curve->pair)).second) continue;
    std::vector<double> millimetres = curve->displacement;
    for (double& value : millimetres) value *= 1e3;
    panel.add(styled({label_of(curve->pair) + ", " + std::to_string(curve->functions), curve->varied,
                      millimetres, SeriesStyle::line},
                     curve->pair));
  }
  add_distances(figure, comparison);
  return figure;
}

}  // namespace wavebalance::app

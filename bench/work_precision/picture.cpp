#include "picture.hpp"

#include <utility>

#include "wavebalance/app/compare/comparison.hpp"

namespace wavebalance::bench {
namespace {

app::Series baseline(const std::string& method, const std::string& label, int marker,
                     const std::vector<Point>& points) {
  std::vector<double> x, y;
  for (const Point& point : points)
    if (point.method == method && point.converged) {
      x.push_back(point.seconds);
      y.push_back(point.error);
    }
  app::Series one(label, x, y, app::SeriesStyle::line_points);
  one.colour = app::Colour::grey;
  one.marker = marker;
  return one;
}

}  // namespace

void add_panel(app::Figure& figure, const Study& study, const std::vector<Point>& points) {
  app::Panel& panel = figure.add_panel(study.title);
  panel.x.label = "Solve time (processor seconds)";
  panel.y.label = "Relative rms error of the tip displacement";
  panel.x.logarithmic = panel.y.logarithmic = true;
  panel.add(app::pareto_front(points));
  constexpr std::size_t most = 5;
  for (const app::BasisPair& pair : app::leading_pairs(pairs(), points, most))
    panel.add(app::best_of(pair, points));
  app::Series exact = app::best_of(app::BasisPair::exact(), points);
  exact.label = "exact solution from 63 functions";
  exact.marker = 8;  // of no pair in the same colour
  for (app::Series one : {baseline("dense", "Fourier:Fourier, assembled system", 6, points),
                          baseline("time_stepping", "time stepping", 7, points), std::move(exact)})
    if (!one.x.empty()) panel.add(std::move(one));
}

}  // namespace wavebalance::bench

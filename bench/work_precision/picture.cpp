#include "picture.hpp"

#include <algorithm>
#include <utility>

namespace wavebalance::bench {
namespace {

using app::Series;
using app::SeriesStyle;

Series series(const std::string& label, const std::vector<Point>& points, SeriesStyle style) {
  std::vector<double> x, y;
  for (const Point& point : points) {
    x.push_back(point.seconds);
    y.push_back(point.error);
  }
  return {label, x, y, style};
}

template <class Predicate>
std::vector<Point> chosen(const std::vector<Point>& points, const Predicate& predicate) {
  std::vector<Point> result;
  std::copy_if(points.begin(), points.end(), std::back_inserter(result), predicate);
  return result;
}

Series front(const std::vector<Point>& points) {
  Series one = series("Pareto front", envelope(points), SeriesStyle::steps);
  one.colour = app::Colour::grey;
  one.width = 5.0;
  return one;
}

Series best_of(const Pair& pair, const std::vector<Point>& points) {
  const auto own = chosen(points, [&](const Point& point) {
    return point.method == "weighted_residual" && point.trial == pair.trial && point.weight == pair.weight;
  });
  Series one = series(pair.label, envelope(own), SeriesStyle::line_points);
  one.colour = pair.colour;
  one.dash = pair.dash;
  one.marker = pair.marker;
  return one;
}

Series baseline(const std::string& method, const std::string& label, int marker,
                const std::vector<Point>& points) {
  const auto own =
      chosen(points, [&](const Point& point) { return point.method == method && point.converged; });
  Series one = series(label, own, SeriesStyle::line_points);
  one.colour = app::Colour::grey;
  one.marker = marker;
  return one;
}

}  // namespace

WorkPrecisionPicture::WorkPrecisionPicture(const std::string& title) {
  figure_.title = title;
  figure_.columns = 1;
  figure_.panel_width = 900;
  figure_.panel_height = 460;
}

void WorkPrecisionPicture::add(const Study& study, const std::vector<Point>& points) {
  app::Panel& panel = figure_.add_panel(study.title);
  panel.x.label = "Solve time (processor seconds)";
  panel.y.label = "Relative rms error of the tip displacement";
  panel.x.logarithmic = panel.y.logarithmic = true;
  panel.legend = app::Legend::right_of_panel;
  panel.add(front(points));
  for (const Pair& pair : pairs()) panel.add(best_of(pair, points));
  for (Series one :
       {baseline("dense", "Fourier:Fourier, assembled system", 6, points),
        baseline("time_stepping", "time stepping", 7, points), baseline("shooting", "shooting", 8, points)})
    if (!one.x.empty()) panel.add(std::move(one));
}

}  // namespace wavebalance::bench

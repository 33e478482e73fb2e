#include "wavebalance/app/drawing/stability_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace wavebalance::app {
namespace {

using Type = solvers::SpecialPointType;

/// The kinds in the order of the legend, with their names there.
constexpr std::array<std::pair<Type, const char*>, 8> kinds{{{Type::fold, "fold"},
                                                             {Type::period_doubling, "period doubling"},
                                                             {Type::neimark_sacker, "Neimark-Sacker point"},
                                                             {Type::branch, "branch point"},
                                                             {Type::grazing, "grazing"},
                                                             {Type::slip, "first slip"},
                                                             {Type::stick, "onset of sticking"},
                                                             {Type::krein_collision, "Krein collision"}}};

struct Vertex {
  double x, y;
};

/// A run of lines of one stability.
struct Piece {
  std::vector<Vertex> vertices;
  bool unstable;
};

/// Distances over the extent of a curve in x and in y.
class Metric {
 public:
  explicit Metric(const Series& curve) : x_(extent(curve.x)), y_(extent(curve.y)) {}
  double operator()(Vertex a, Vertex b) const { return std::hypot((a.x - b.x) / x_, (a.y - b.y) / y_); }

 private:
  static double extent(const std::vector<double>& values) {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return values.empty() || *low == *high ? 1.0 : *high - *low;
  }
  double x_, y_;
};

Vertex vertex(const Series& curve, std::size_t i) { return {curve.x[i], curve.y[i]}; }

/// The lines of a curve in which its special points lie: from the line of the one before on, that through
/// which the way by the special point is least longer.
std::vector<std::size_t> lines_of(const Series& curve, const std::vector<PlacedPoint>& special) {
  const Metric distance(curve);
  std::vector<std::size_t> lines;
  for (const PlacedPoint& one : special) {
    const Vertex at{one.x, one.y};
    const auto detour = [&](std::size_t i) {
      const Vertex a = vertex(curve, i), b = vertex(curve, i + 1);
      return distance(a, at) + distance(at, b) - distance(a, b);
    };
    std::size_t best = lines.empty() ? 0 : lines.back();
    for (std::size_t i = best; i + 1 < curve.x.size(); ++i)
      if (detour(i) < detour(best)) best = i;
    lines.push_back(best);
  }
  return lines;
}

bool all_grazings(const std::vector<PlacedPoint>& points, std::size_t from, std::size_t to) {
  return std::all_of(points.begin() + static_cast<std::ptrdiff_t>(from),
                     points.begin() + static_cast<std::ptrdiff_t>(to),
                     [](const PlacedPoint& one) { return one.type == Type::grazing; });
}

void append(std::vector<Piece>& pieces, Vertex from, Vertex to, bool unstable) {
  if (pieces.empty() || pieces.back().unstable != unstable) pieces.push_back({{from}, unstable});
  pieces.back().vertices.push_back(to);
}

/// Lines of a curve, cut at its special points.
std::vector<Piece> pieces_of(const Series& curve, const std::vector<bool>& points,
                             const std::vector<PlacedPoint>& special) {
  const std::vector<std::size_t> lines = lines_of(curve, special);
  const auto unstable_at = [&](std::size_t i) { return i < points.size() && points[i]; };
  std::vector<Piece> pieces;
  std::size_t next = 0;
  for (std::size_t i = 0; i + 1 < curve.x.size(); ++i) {
    const std::size_t first = next;
    std::size_t end = first;
    while (end < lines.size() && lines[end] == i) ++end;
    const bool before = unstable_at(i), after = unstable_at(i + 1);
    // Where contact alone begins or ends, stability may change with it.
    const bool ends_at_grazing = end > first && all_grazings(special, first, end) && before != after;
    Vertex from = vertex(curve, i);
    for (; next <= end; ++next) {
      const bool last = next == end;
      const Vertex to = last ? vertex(curve, i + 1) : Vertex{special[next].x, special[next].y};
      const bool as_before = all_grazings(special, first, next), as_after = all_grazings(special, next, end);
      const bool unstable = ends_at_grazing         ? next == first ? before
                                                      : last        ? after
                                                                    : true
                            : as_before && as_after ? before || after
                            : as_before             ? before
                            : as_after              ? after
                                                    : before || after;
      append(pieces, from, to, unstable);
      from = to;
      if (last) break;
    }
  }
  return pieces;
}

Series drawn(const Series& curve, const std::vector<Piece>& pieces, bool unstable) {
  Series series = curve;
  series.x.clear();
  series.y.clear();
  for (const Piece& piece : pieces) {
    if (piece.unstable != unstable) continue;
    if (!series.x.empty()) {
      series.x.push_back(piece.vertices.front().x);
      series.y.push_back(std::nan(""));
    }
    for (const Vertex& one : piece.vertices) {
      series.x.push_back(one.x);
      series.y.push_back(one.y);
    }
  }
  return series;
}

/// One entry of the legend for the parts of a branch, the series from `first` on: dashes mean the same in
/// all.
void label_once(Panel& panel, std::size_t first) {
  if (panel.series.size() < first + 2) return;
  Series &stable = panel.series[first], &unstable = panel.series[first + 1];
  unstable.label = "";
  if (std::any_of(stable.y.begin(), stable.y.end(), [](double y) { return !std::isnan(y); })) return;
  unstable.label = std::move(stable.label);
  panel.series.erase(panel.series.begin() + static_cast<std::ptrdiff_t>(first));
}

}  // namespace

StabilityParts parts_by_stability(const Series& curve, const std::vector<bool>& unstable,
                                  const std::vector<PlacedPoint>& special) {
  const std::vector<Piece> pieces = pieces_of(curve, unstable, special);
  Series solid = drawn(curve, pieces, false), dashed = drawn(curve, pieces, true);
  if (solid.x.empty() && !dashed.x.empty()) {
    solid.x = {dashed.x.front()};
    solid.y = {std::nan("")};
  }
  if (!dashed.label.empty()) dashed.label += ", unstable";
  dashed.dash = Dash::dashed;
  return {std::move(solid), std::move(dashed)};
}

void draw_by_stability(Panel& panel, const Series& curve, const std::vector<solvers::PointStability>& points,
                       const std::vector<PlacedPoint>& special) {
  std::vector<bool> unstable;
  for (const auto& point : points) unstable.push_back(point.unstable > 0);
  auto [solid, dashed] = parts_by_stability(curve, unstable, special);
  panel.add(std::move(solid));
  if (!dashed.x.empty()) panel.add(std::move(dashed));
}

void draw_special_points(Panel& panel, const std::vector<PlacedPoint>& points) {
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    std::vector<double> x, y;
    for (const PlacedPoint& point : points) {
      if (point.type != kinds[kind].first) continue;
      x.push_back(point.x);
      y.push_back(point.y);
    }
    if (x.empty()) continue;
    Series series(kinds[kind].second, x, y, SeriesStyle::points);
    series.colour = Colour::black;
    series.marker = static_cast<int>(kind) + 1;
    panel.add(std::move(series));
  }
}

namespace {

/// One of the curves beside the first, the i-th of its kind.
void draw_beside(Panel& panel, std::string label, const solvers::FrequencySweep& curve,
                 const StabilityAlong& stability, const std::vector<solvers::SpecialPoint>& special_points,
                 std::size_t colour, double x_factor, double y_factor) {
  constexpr std::array colours{Colour::green, Colour::vermillion, Colour::purple, Colour::sky_blue};
  if (curve.points.empty()) return;
  Series series;
  series.label = std::move(label);
  for (const auto& point : curve.points) {
    series.x.push_back(x_factor * point.frequency);
    series.y.push_back(y_factor * point.max_displacement);
  }
  series.colour = colours[colour % colours.size()];
  std::vector<PlacedPoint> special;
  for (const auto& point : special_points)
    special.push_back({point.type, x_factor * point.frequency, y_factor * point.max_displacement});
  const std::size_t before = panel.series.size();
  draw_by_stability(panel, series, stability.points, special);
  label_once(panel, before);
}

}  // namespace

void draw_branches(Panel& panel, const Sweep& sweep, double x_factor, double y_factor) {
  for (std::size_t i = 0; i < sweep.branches.size(); ++i) {
    const solvers::Branch& branch = sweep.branches[i];
    const int periods = branch.periods * sweep.periods;
    draw_beside(panel,
                "branch " + std::to_string(i + 1) + ", " + std::to_string(periods) +
                    (periods == 1 ? " period" : " periods"),
                branch.curve, sweep.stability_of(i + 1), branch.stability.special_points, i, x_factor,
                y_factor);
  }
}

void draw_isolas(Panel& panel, const Sweep& sweep, double x_factor, double y_factor) {
  for (std::size_t i = 0; i < sweep.isolas.size(); ++i) {
    const Sweep& isola = sweep.isolas[i];
    draw_beside(panel, "isola " + std::to_string(i + 1), isola.curve, isola.stability_of(0),
                isola.stability.special_points, sweep.branches.size() + i, x_factor, y_factor);
  }
}

}  // namespace wavebalance::app

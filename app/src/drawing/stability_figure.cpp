#include "wavebalance/app/drawing/stability_figure.hpp"

namespace wavebalance::app {
namespace {

using Type = solvers::SpecialPointType;

/// The kinds in the order of the legend, with their names there.
constexpr std::array<std::pair<Type, const char*>, 8> kinds{{{Type::fold, "fold"},
                                                             {Type::period_doubling, "period doubling"},
                                                             {Type::neimark_sacker, "Neimark-Sacker point"},
                                                             {Type::branch, "branch point"},
                                                             {Type::grazing, "grazing"},
                                                             {Type::slip, "slip onset"},
                                                             {Type::stick, "stick onset"},
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

/// The lines of a curve in which its bifurcation points lie: from the line of the one before on, that through
/// which the way by the point is least longer.
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

/// Lines of a curve, cut at its bifurcation and grazing points.
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
    // Stability may change where contact begins or ends.
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
    if (!series.x.empty()) series.append(piece.vertices.front().x, std::nan(""));
    for (const Vertex& one : piece.vertices) series.append(one.x, one.y);
  }
  return series;
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
    Series series = Series(kinds[kind].second, SeriesStyle::points).in(Colour::black);
    for (const PlacedPoint& point : points)
      if (point.type == kinds[kind].first) series.append(point.x, point.y);
    if (series.x.empty()) continue;
    series.marker = static_cast<int>(kind) + 1;
    panel.add(std::move(series));
  }
}

}  // namespace wavebalance::app

#include "surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "colour_bands.hpp"
#include "files/number_text.hpp"
#include "plot/plot_parts.hpp"

namespace wavebalance::blade {
namespace {

using app::Axis;
using app::coordinate;
using app::Drawing;
using app::number_text;

/// Rows: the directions to the right, upwards and towards the viewer. A rotation.
Eigen::Matrix3d directions(const SurfaceView& view) {
  const double azimuth = view.azimuth * std::numbers::pi / 180.0;
  const double elevation = view.elevation * std::numbers::pi / 180.0;
  const double ca = std::cos(azimuth), sa = std::sin(azimuth), ce = std::cos(elevation),
               se = std::sin(elevation);
  Eigen::Matrix3d rows;
  rows << -sa, ca, 0.0, -se * ca, -se * sa, ce, ce * ca, ce * sa, se;
  return rows;
}

struct Corner {
  Eigen::Vector2d at;
  double value = 0.0;
};
using Polygon = std::vector<Corner>;

/// A face whose outer side is visible.
struct Facet {
  Polygon ring;
  double depth = 0.0;  // depth of the centre, larger is nearer
  double light = 1.0;  // cosine to the light
  bool valued = false;
  int layer = 0;
};

/// Twice the area vector of a polygon in space, outwards.
Eigen::Vector3d area_of(const Eigen::Matrix3Xd& vertices, const std::vector<int>& face) {
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Eigen::Vector3d from = vertices.col(face[i]) - vertices.col(face[0]);
    const Eigen::Vector3d to = vertices.col(face[(i + 1) % face.size()]) - vertices.col(face[0]);
    area += from.cross(to);
  }
  return area;
}

/// The polygon without the vertices that lie on the line between their neighbours to `tolerance`, mostly
/// midpoints of edges.
Polygon simplified(const Polygon& ring, double tolerance) {
  Polygon result;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d& before = ring[(i + ring.size() - 1) % ring.size()].at;
    const Eigen::Vector2d line = ring[(i + 1) % ring.size()].at - before, to = ring[i].at - before;
    const double across = std::abs(line.x() * to.y() - line.y() * to.x());
    const bool between = to.dot(line) > 0.0 && to.dot(line) < line.squaredNorm();
    if (!between || across > tolerance * line.norm()) result.push_back(ring[i]);
  }
  return result.size() < 3 ? ring : result;
}

/// The part of a polygon where the value, linear along its edges, is at least `level`.
Polygon above(const Polygon& polygon, double level) {
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (a.value >= level) result.push_back(a);
    if ((a.value >= level) == (b.value >= level)) continue;
    const double share = (level - a.value) / (b.value - a.value);
    result.push_back({a.at + share * (b.at - a.at), level});
  }
  return result;
}

/// True if an edge of `a` separates the two polygons, which may overlap by `margin`.
bool separated(const Polygon& a, const Polygon& b, double margin) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Eigen::Vector2d edge = a[(i + 1) % a.size()].at - a[i].at;
    const Eigen::Vector2d outwards = Eigen::Vector2d(edge.y(), -edge.x()).normalized();
    if (std::all_of(b.begin(), b.end(),
                    [&](const Corner& c) { return outwards.dot(c.at - a[i].at) > -margin; }))
      return true;
  }
  return false;
}

bool overlap(const Facet& a, const Facet& b, double margin) {
  return !separated(a.ring, b.ring, margin) && !separated(b.ring, a.ring, margin);
}

/// Sorts facets from the back to the front. Each goes to the lowest layer above those that it hides in part,
/// so that the lines of a layer can be drawn at once. O(n^2) pairs of facets.
void order(std::vector<Facet>& facets, double margin) {
  std::sort(facets.begin(), facets.end(), [](const Facet& a, const Facet& b) { return a.depth < b.depth; });
  for (std::size_t i = 0; i < facets.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (facets[j].layer >= facets[i].layer && overlap(facets[i], facets[j], margin))
        facets[i].layer = facets[j].layer + 1;
}

struct Extent {
  Eigen::Vector2d lower = Eigen::Vector2d::Constant(1e300);
  Eigen::Vector2d upper = Eigen::Vector2d::Constant(-1e300);
  double size() const { return (upper - lower).maxCoeff(); }
};

Extent extent_of(const SurfaceView& view) {
  Extent extent;
  for (const Surface& surface : view.surfaces) {
    const Eigen::Matrix2Xd at = directions(view).topRows(2) * surface.vertices;
    extent.lower = extent.lower.cwiseMin(at.rowwise().minCoeff());
    extent.upper = extent.upper.cwiseMax(at.rowwise().maxCoeff());
  }
  return extent;
}

std::vector<Facet> facets_of(const SurfaceView& view, double tolerance) {
  const Eigen::Matrix3d rotation = directions(view);
  const Eigen::Vector3d light = Eigen::Vector3d(-0.4, 0.5, 1.0).normalized();
  std::vector<Facet> facets;
  for (const Surface& surface : view.surfaces) {
    if (surface.outline) continue;
    const Eigen::Matrix3Xd seen = rotation * surface.vertices;
    for (const auto& face : surface.faces) {
      const Eigen::Vector3d area = area_of(seen, face);
      if (!(area.z() > 0.0)) continue;
      Facet facet;
      facet.valued = !surface.values.empty();
      for (const int vertex : face) {
        const double value = facet.valued ? surface.values[static_cast<std::size_t>(vertex)] : 0.0;
        facet.ring.push_back({seen.col(vertex).head<2>(), value});
        facet.depth += seen(2, vertex) / static_cast<double>(face.size());
      }
      facet.ring = simplified(facet.ring, tolerance);
      facet.light = std::max(0.0, area.normalized().dot(light));
      facets.push_back(std::move(facet));
    }
  }
  order(facets, tolerance);
  return facets;
}

std::string polygon_text(const Polygon& polygon, int colour, double resolution) {
  std::string text;
  const auto line = [&](const Corner& corner) {
    const Eigen::Vector2d rounded = (corner.at / resolution).array().round() * resolution;
    text += coordinate(rounded.x()) + " " + coordinate(rounded.y()) + " " + std::to_string(colour) + "\n";
  };
  for (const Corner& corner : polygon) line(corner);
  line(polygon.front());
  return text + "\n";
}

/// The edges of facets, each once, as connected lines.
class Edges {
 public:
  explicit Edges(double resolution) : resolution_(resolution) {}

  void add(const Polygon& ring) {
    bool joined = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Place from = place(ring[i]), to = place(ring[(i + 1) % ring.size()]);
      if (!drawn_.insert(std::minmax(from, to)).second) {
        joined = false;
        continue;
      }
      if (!joined) text_ += "\n" + row(from);
      text_ += row(to);
      joined = true;
    }
  }
  const std::string& text() const { return text_; }

 private:
  using Place = std::pair<long, long>;  // in units of the resolution
  Place place(const Corner& corner) const {
    return {std::lround(corner.at.x() / resolution_), std::lround(corner.at.y() / resolution_)};
  }
  std::string row(const Place& at) const {
    return coordinate(static_cast<double>(at.first) * resolution_) + " " +
           coordinate(static_cast<double>(at.second) * resolution_) + "\n";
  }

  double resolution_;
  std::set<std::pair<Place, Place>> drawn_;
  std::string text_;
};

/// The facet in the colour of its lowest band, and over it the parts above each further level, so that no
/// gaps show.
std::string filled(const Facet& facet, const SurfaceView& view, double resolution) {
  if (!facet.valued) {
    const double brightness = 235.0 * (1.0 - view.shading * (1.0 - facet.light));
    return polygon_text(facet.ring, grey(brightness), resolution);
  }
  const auto [least, largest] =
      std::minmax_element(facet.ring.begin(), facet.ring.end(),
                          [](const Corner& a, const Corner& b) { return a.value < b.value; });
  const ColourBands& colours = view.colours;
  const int first = band_of(colours, least->value), last = band_of(colours, largest->value);
  std::string text = polygon_text(facet.ring, band_colour(colours, first), resolution);
  for (int band = first + 1; band <= last; ++band) {
    const Polygon part = above(facet.ring, level_of(colours, band));
    if (part.size() >= 3) text += polygon_text(part, band_colour(colours, band), resolution);
  }
  return text;
}

std::string block(const std::string& name, const std::string& rows) {
  return name + " << END\n" + rows + "END\n";
}

/// Edges where the normal changes by more than 40 degrees.
std::string sharp_edges(const Surface& surface, const Eigen::Matrix3d& rotation) {
  std::map<std::pair<int, int>, Eigen::Vector3d> normals;
  std::string text;
  for (const auto& face : surface.faces) {
    const Eigen::Vector3d normal = area_of(surface.vertices, face).normalized();
    for (std::size_t i = 0; i < face.size(); ++i) {
      const int a = face[i], b = face[(i + 1) % face.size()];
      const auto opposite = normals.find({b, a});
      if (opposite == normals.end()) {
        normals[{a, b}] = normal;
      } else if (opposite->second.dot(normal) < std::cos(40.0 * std::numbers::pi / 180.0)) {
        for (const int vertex : {a, b}) {
          const Eigen::Vector3d at = rotation * surface.vertices.col(vertex);
          text += coordinate(at.x()) + " " + coordinate(at.y()) + "\n";
        }
        text += "\n";
      }
    }
  }
  return text;
}

/// The marked vertices that lie on a visible face.
std::string marked(const Surface& surface, const SurfaceMarks& marks, const Eigen::Matrix3d& rotation) {
  std::set<int> seen;
  for (const auto& face : surface.faces)
    if ((rotation * area_of(surface.vertices, face)).z() > 0.0) seen.insert(face.begin(), face.end());
  std::string text;
  for (const int vertex : marks.vertices) {
    const Eigen::Vector3d at = rotation * surface.vertices.col(vertex);
    if (seen.count(vertex) > 0) text += coordinate(at.x()) + " " + coordinate(at.y()) + "\n";
  }
  return text;
}

void add(Drawing& script, const std::string& name, const std::string& rows, const std::string& how) {
  if (rows.empty()) return;
  script.data += block(name, rows);
  script.items.push_back(name + " " + how);
}

void add_facets(Drawing& script, const SurfaceView& view, const std::string& name, double size) {
  const double resolution = size * 1e-4;
  const auto facets = facets_of(view, 10.0 * resolution);
  int layers = 0;
  for (const Facet& facet : facets) layers = std::max(layers, facet.layer + 1);
  for (int layer = 0; layer < layers; ++layer) {
    std::string fills;
    Edges edges(resolution);
    for (const Facet& facet : facets)
      if (facet.layer == layer) {
        fills += filled(facet, view, resolution);
        edges.add(facet.ring);
      }
    const std::string number = std::to_string(layer);
    add(script, name + "_fill" + number, fills,
        "using 1:2:3 with filledcurves closed fc rgb variable notitle");
    add(script, name + "_lines" + number, edges.text(),
        "using 1:2 with lines lc rgb '#444444' lw 0.45 dt 1 notitle");
  }
}

app::Series legend_of(const SurfaceMarks& marks) {
  app::Series series;
  series.label = marks.label;
  series.style = app::SeriesStyle::points;
  series.colour = marks.colour;
  series.marker = std::max(marks.marker, 1);
  return series;
}

void add_marks(Drawing& script, const SurfaceView& view, const std::string& name) {
  const Eigen::Matrix3d rotation = directions(view);
  for (std::size_t i = 0; i < view.surfaces.size(); ++i)
    for (std::size_t j = 0; j < view.surfaces[i].marks.size(); ++j) {
      const SurfaceMarks& marks = view.surfaces[i].marks[j];
      add(script, name + "_marks" + std::to_string(i) + "_" + std::to_string(j),
          marked(view.surfaces[i], marks, rotation),
          "using 1:2 with points lc rgb '" + app::colour_code(marks.colour) + "'" +
              app::symbol_text(static_cast<std::size_t>(std::max(marks.marker, 1) - 1)) + " notitle");
      script.legend.push_back(legend_of(marks));
    }
}

std::string limits_text(const char* name, const Axis& axis, double lower, double upper) {
  return std::string("set ") + name + "range [" + number_text(axis.lower.value_or(lower)) + ":" +
         number_text(axis.upper.value_or(upper)) + "]\n";
}

/// Three arrows from the lower left corner.
std::string axes_text(const SurfaceView& view, const Eigen::Vector2d& corner) {
  const Eigen::Matrix<double, 2, 3> tips = view.axes * directions(view).topRows(2);
  const Eigen::Vector2d origin = corner - tips.rowwise().minCoeff().cwiseMin(0.0);
  std::string text;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Eigen::Vector2d tip = origin + tips.col(axis), label = origin + 1.2 * tips.col(axis);
    text += "set arrow from " + number_text(origin.x()) + "," + number_text(origin.y()) + " to " +
            number_text(tip.x()) + "," + number_text(tip.y()) +
            " head filled size screen 0.008,20 lc rgb '#222222' lw 1 front\n";
    text += std::string("set label '") + "xyz"[axis] + "' at " + number_text(label.x()) + "," +
            number_text(label.y()) + " center front\n";
  }
  return text;
}

/// Faces are projected, ordered and cut into bands here, because gnuplot 5.4 gives a polygon one colour,
/// draws back faces as well, and writes several times as much SVG.
Drawing drawing_of(const SurfaceView& view, const Axis& x, const Axis& y, const std::string& name) {
  Drawing script;
  const Extent extent = extent_of(view);
  const Eigen::Matrix3d rotation = directions(view);
  const double margin = 0.06 * extent.size();
  for (std::size_t i = 0; i < view.surfaces.size(); ++i)
    if (view.surfaces[i].outline)
      add(script, name + "_outline" + std::to_string(i), sharp_edges(view.surfaces[i], rotation),
          "using 1:2 with lines lc rgb '#777777' lw 0.9 dt (4,3) notitle");
  add_facets(script, view, name, extent.size());
  add_marks(script, view, name);
  const Eigen::Vector2d lower = extent.lower.array() - margin - 0.8 * view.axes;
  const Eigen::Vector2d upper = extent.upper.array() + margin;
  script.setup = "set size ratio -1\n" + limits_text("x", x, lower.x(), upper.x()) +
                 limits_text("y", y, lower.y(), upper.y());
  if (view.axes > 0.0)
    script.setup +=
        axes_text(view, {x.lower.value_or(lower.x()) + 0.3 * margin, y.lower.value_or(lower.y()) + margin});
  const bool valued = std::any_of(view.surfaces.begin(), view.surfaces.end(),
                                  [](const Surface& surface) { return !surface.values.empty(); });
  if (valued) script.setup += colour_bar_text(view.colours);
  return script;
}

}  // namespace

Eigen::Vector2d projected(const SurfaceView& view, const Eigen::Vector3d& point) {
  return (directions(view) * point).head<2>();
}

void paint(app::Panel& panel, const SurfaceView& view, const std::string& name) {
  panel.drawing = drawing_of(view, panel.x, panel.y, "$" + name);
}

}  // namespace wavebalance::blade

#include "wavebalance/fem/boundary_faces.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

namespace wavebalance::fem {
namespace {

// Corners, then midpoints, of the faces zeta = -1, zeta = 1, eta = -1, xi = 1, eta = 1, xi = -1 from outside.
constexpr std::array<std::array<int, 8>, 6> faces_of_hexahedron{{{0, 3, 2, 1, 11, 10, 9, 8},
                                                                 {4, 5, 6, 7, 12, 13, 14, 15},
                                                                 {0, 1, 5, 4, 8, 17, 12, 16},
                                                                 {1, 2, 6, 5, 9, 18, 13, 17},
                                                                 {2, 3, 7, 6, 10, 19, 14, 18},
                                                                 {3, 0, 4, 7, 11, 16, 15, 19}}};

struct Face {
  std::array<int, 4> ascending;  // corners, the same from either side
  int element;
  int side;
  auto key() const { return std::pair(element, side); }
};

std::vector<Face> all_faces(const SolidMesh& mesh) {
  std::vector<Face> faces;
  faces.reserve(6 * static_cast<std::size_t>(mesh.elements.cols()));
  for (int element = 0; element < mesh.elements.cols(); ++element)
    for (int side = 0; side < 6; ++side) {
      Face face{{}, element, side};
      for (std::size_t i = 0; i < 4; ++i)
        face.ascending[i] = mesh.elements(faces_of_hexahedron[static_cast<std::size_t>(side)][i], element);
      std::sort(face.ascending.begin(), face.ascending.end());
      faces.push_back(face);
    }
  return faces;
}

/// Those that belong to one solid only, by their corners.
template <class AnyFace>
std::vector<AnyFace> single(std::vector<AnyFace> faces) {
  std::stable_sort(faces.begin(), faces.end(),
                   [](const AnyFace& a, const AnyFace& b) { return a.ascending < b.ascending; });
  std::vector<AnyFace> found;
  for (auto at = faces.begin(); at != faces.end();) {
    const auto next =
        std::find_if(at, faces.end(), [&](const AnyFace& face) { return face.ascending != at->ascending; });
    if (next - at == 1) found.push_back(*at);
    at = next;
  }
  return found;
}

/// A face of a solid by its corners, in their order around it and ascending.
struct CornerFace {
  std::vector<int> corners, ascending;
};

void add_triangles(const std::vector<int>& corners, std::vector<int>& triangles) {
  for (std::size_t i = 2; i < corners.size(); ++i)
    triangles.insert(triangles.end(), {corners[0], corners[i - 1], corners[i]});
}

/// The faces of a solid of so many corners, by these.
const std::vector<std::vector<int>>& faces_of_corners(int corners) {
  static const std::vector<std::vector<int>> tetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}},
      wedge{{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}},
      hexahedron{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  return corners == 4 ? tetrahedron : corners == 6 ? wedge : hexahedron;
}

void add_faces(const int* points, int corners, std::vector<CornerFace>& faces) {
  for (const std::vector<int>& places : faces_of_corners(corners)) {
    CornerFace face;
    for (const int place : places) face.corners.push_back(points[place]);
    face.ascending = face.corners;
    std::sort(face.ascending.begin(), face.ascending.end());
    faces.push_back(std::move(face));
  }
}

/// The points of a cell of VTK's type; 0 for types that read_mesh() does not make.
int points_of(int type) {
  constexpr std::array<std::array<int, 2>, 12> known{{{3, 2},
                                                      {5, 3},
                                                      {9, 4},
                                                      {10, 4},
                                                      {12, 8},
                                                      {13, 6},
                                                      {21, 3},
                                                      {22, 6},
                                                      {23, 8},
                                                      {24, 10},
                                                      {25, 20},
                                                      {26, 15}}};
  const auto found =
      std::find_if(known.begin(), known.end(), [&](const auto& one) { return one[0] == type; });
  return found == known.end() ? 0 : (*found)[1];
}

/// A cell of VTK's type with `count` points.
void add_cell(int type, const int* points, int count, std::vector<CornerFace>& faces, MeshSurface& surface) {
  if (count == 0 || count != points_of(type))
    throw std::invalid_argument("surface_of: a cell of " + std::to_string(count) + " points has the type " +
                                std::to_string(type) + "; it must be one that read_mesh() makes");
  switch (type) {
    case 3:
      surface.segments.insert(surface.segments.end(), {points[0], points[1]});
      return;
    case 21:  // both ends, then the middle
      surface.segments.insert(surface.segments.end(), {points[0], points[2], points[2], points[1]});
      return;
    case 5:
    case 22:
      return add_triangles({points[0], points[1], points[2]}, surface.triangles);
    case 9:
    case 23:
      return add_triangles({points[0], points[1], points[2], points[3]}, surface.triangles);
    case 10:
    case 24:
      return add_faces(points, 4, faces);
    case 13:
    case 26:
      return add_faces(points, 6, faces);
    default:
      return add_faces(points, 8, faces);
  }
}

}  // namespace

Connectivity boundary_faces(const SolidMesh& mesh) {
  mesh.validate();
  std::vector<Face> found = single(all_faces(mesh));
  std::sort(found.begin(), found.end(), [](const Face& a, const Face& b) { return a.key() < b.key(); });
  Connectivity faces(nodes_per_element(mesh.element) == 20 ? 8 : 4, static_cast<Eigen::Index>(found.size()));
  for (Eigen::Index column = 0; column < faces.cols(); ++column) {
    const Face& face = found[static_cast<std::size_t>(column)];
    const auto& places = faces_of_hexahedron[static_cast<std::size_t>(face.side)];
    for (Eigen::Index row = 0; row < faces.rows(); ++row)
      faces(row, column) = mesh.elements(places[static_cast<std::size_t>(row)], face.element);
  }
  return faces;
}

MeshSurface surface_of(const Mesh& mesh) {
  mesh.validate();
  MeshSurface surface;
  std::vector<CornerFace> faces;
  int begin = 0;
  for (std::size_t cell = 0; cell < mesh.cell_types.size(); ++cell) {
    const int* points = mesh.connectivity.data() + begin;
    add_cell(mesh.cell_types[cell], points, mesh.cell_ends[cell] - begin, faces, surface);
    begin = mesh.cell_ends[cell];
  }
  for (const CornerFace& face : single(std::move(faces))) add_triangles(face.corners, surface.triangles);
  return surface;
}

std::vector<int> around(const Connectivity& faces, int face) {
  std::vector<int> nodes;
  for (Eigen::Index corner = 0; corner < 4; ++corner) {
    nodes.push_back(faces(corner, face));
    if (faces.rows() == 8) nodes.push_back(faces(4 + corner, face));
  }
  return nodes;
}

}  // namespace wavebalance::fem

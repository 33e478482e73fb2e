#include "wavebalance/fem/boundary_faces.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

namespace wavebalance::fem {
namespace {

using Places = std::vector<std::vector<int>>;

// The corners of the faces of solids, from outside.
const Places faces_of_tetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
const Places faces_of_wedge{{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
// zeta = -1, zeta = 1, eta = -1, xi = 1, eta = 1, xi = -1.
const Places faces_of_hexahedron{{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                 {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
// The midpoints of the edges of the latter, each after the corner of the same place.
const Places midpoints_of_hexahedron{{11, 10, 9, 8},  {12, 13, 14, 15}, {8, 17, 12, 16},
                                     {9, 18, 13, 17}, {10, 19, 14, 18}, {11, 16, 15, 19}};

struct Face {
  std::vector<int> corners, ascending;  // in their order around it, and the same from either side
  int cell = 0, side = 0;
};

void add_faces(const int* points, const Places& sides, int cell, std::vector<Face>& faces) {
  for (std::size_t side = 0; side < sides.size(); ++side) {
    Face face{{}, {}, cell, static_cast<int>(side)};
    for (const int place : sides[side]) face.corners.push_back(points[place]);
    face.ascending = face.corners;
    std::ranges::sort(face.ascending);
    faces.push_back(std::move(face));
  }
}

/// Those that belong to one solid only, by their corners, which become the order.
std::vector<Face> single(std::vector<Face> faces) {
  std::ranges::stable_sort(faces, {}, &Face::ascending);
  std::vector<Face> found;
  for (auto at = faces.begin(); at != faces.end();) {
    const auto next =
        std::find_if(at, faces.end(), [&](const Face& face) { return face.ascending != at->ascending; });
    if (next - at == 1) found.push_back(std::move(*at));
    at = next;
  }
  return found;
}

/// A cell of VTK that read_mesh() makes: its points, and what becomes of it.
struct CellType {
  int type, points;
  int shell = 0;                  // corners of a shell
  const Places* solid = nullptr;  // faces of a solid
};

const CellType& type_of(int type, int points) {
  static const std::array<CellType, 12> known{{{3, 2},
                                               {21, 3},
                                               {5, 3, 3},
                                               {22, 6, 3},
                                               {9, 4, 4},
                                               {23, 8, 4},
                                               {10, 4, 0, &faces_of_tetrahedron},
                                               {24, 10, 0, &faces_of_tetrahedron},
                                               {13, 6, 0, &faces_of_wedge},
                                               {26, 15, 0, &faces_of_wedge},
                                               {12, 8, 0, &faces_of_hexahedron},
                                               {25, 20, 0, &faces_of_hexahedron}}};
  const auto found = std::ranges::find_if(
      known, [&](const CellType& one) { return one.type == type && one.points == points; });
  if (found == known.end())
    throw std::invalid_argument("surface_of: a cell of " + std::to_string(points) + " points has the type " +
                                std::to_string(type) + "; it must be one that read_mesh() makes");
  return *found;
}

void add_triangles(const std::vector<int>& corners, std::vector<int>& triangles) {
  for (std::size_t i = 2; i < corners.size(); ++i)
    triangles.insert(triangles.end(), {corners[0], corners[i - 1], corners[i]});
}

}  // namespace

Connectivity boundary_faces(const SolidMesh& mesh) {
  mesh.validate();
  std::vector<Face> found;
  for (int element = 0; element < mesh.elements.cols(); ++element)
    add_faces(mesh.elements.col(element).data(), faces_of_hexahedron, element, found);
  found = single(std::move(found));
  std::ranges::sort(found, [](const Face& a, const Face& b) {
    return std::tie(a.cell, a.side) < std::tie(b.cell, b.side);
  });
  const bool quadratic = nodes_per_element(mesh.element) == 20;
  Connectivity faces(quadratic ? 8 : 4, std::ssize(found));
  for (Eigen::Index column = 0; column < faces.cols(); ++column) {
    const Face& face = found[static_cast<std::size_t>(column)];
    for (std::size_t i = 0; i < 4; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      faces(row, column) = face.corners[i];
      if (quadratic)
        faces(4 + row, column) =
            mesh.elements(midpoints_of_hexahedron[static_cast<std::size_t>(face.side)][i], face.cell);
    }
  }
  return faces;
}

MeshSurface surface_of(const Mesh& mesh) {
  mesh.validate();
  MeshSurface surface;
  std::vector<Face> faces;
  int begin = 0;
  for (std::size_t cell = 0; cell < mesh.cell_types.size(); ++cell) {
    const int* points = mesh.connectivity.data() + begin;
    const int count = mesh.cell_ends[cell] - begin;
    const CellType& type = type_of(mesh.cell_types[cell], count);
    if (type.solid)
      add_faces(points, *type.solid, static_cast<int>(cell), faces);
    else if (type.shell > 0)
      add_triangles({points, points + type.shell}, surface.triangles);
    else if (count == 2)
      surface.segments.insert(surface.segments.end(), {points[0], points[1]});
    else  // both ends, then the middle
      surface.segments.insert(surface.segments.end(), {points[0], points[2], points[2], points[1]});
    begin = mesh.cell_ends[cell];
  }
  for (const Face& face : single(std::move(faces))) add_triangles(face.corners, surface.triangles);
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

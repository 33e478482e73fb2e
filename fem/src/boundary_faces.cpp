#include "wavebalance/fem/boundary_faces.hpp"

#include <algorithm>

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
  std::array<int, 4> corners;  // ascending: the same from either side
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
        face.corners[i] = mesh.elements(faces_of_hexahedron[static_cast<std::size_t>(side)][i], element);
      std::sort(face.corners.begin(), face.corners.end());
      faces.push_back(face);
    }
  return faces;
}

std::vector<Face> single(std::vector<Face> faces) {
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.corners < b.corners; });
  std::vector<Face> found;
  for (auto at = faces.begin(); at != faces.end();) {
    const auto next =
        std::find_if(at, faces.end(), [&](const Face& face) { return face.corners != at->corners; });
    if (next - at == 1) found.push_back(*at);
    at = next;
  }
  std::sort(found.begin(), found.end(), [](const Face& a, const Face& b) { return a.key() < b.key(); });
  return found;
}

}  // namespace

Connectivity boundary_faces(const SolidMesh& mesh) {
  mesh.validate();
  const std::vector<Face> found = single(all_faces(mesh));
  Connectivity faces(nodes_per_element(mesh.element) == 20 ? 8 : 4, static_cast<Eigen::Index>(found.size()));
  for (Eigen::Index column = 0; column < faces.cols(); ++column) {
    const Face& face = found[static_cast<std::size_t>(column)];
    const auto& places = faces_of_hexahedron[static_cast<std::size_t>(face.side)];
    for (Eigen::Index row = 0; row < faces.rows(); ++row)
      faces(row, column) = mesh.elements(places[static_cast<std::size_t>(row)], face.element);
  }
  return faces;
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

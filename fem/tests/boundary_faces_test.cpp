#include "wavebalance/fem/boundary_faces.hpp"

#include <Eigen/Geometry>
#include <map>
#include <tuple>

#include "print.hpp"
#include "testing.hpp"
#include "wavebalance/fem/blade.hpp"

namespace wavebalance::fem {
namespace {

StructuredMesh skewed_box(SolidElement element) {
  return structured_mesh(element, {3, 2, 4}, [](const Eigen::Vector3d& at) {
    return Eigen::Vector3d(2 * at[0] + 0.3 * at[2], at[1] - 0.2 * at[0], 3 * at[2]);
  });
}

class Faces : public testing::TestWithParam<SolidElement> {};
INSTANTIATE_TEST_SUITE_P(Boundary, Faces,
                         testing::Values(SolidElement::hexahedron8, SolidElement::hexahedron20), case_name);

TEST_P(Faces, OfABlockAreThoseOfItsSixSides) {
  const StructuredMesh block = skewed_box(GetParam());
  const Connectivity faces = boundary_faces(block.mesh);
  ASSERT_EQ(faces.cols(), 2 * (3 * 2 + 3 * 4 + 2 * 4));
  ASSERT_EQ(faces.rows(), GetParam() == SolidElement::hexahedron8 ? 4 : 8);
  for (Eigen::Index face = 0; face < faces.cols(); ++face) {
    const Eigen::Matrix3Xd at = block.parameters(Eigen::all, faces.col(face));
    bool on_a_side = false;
    for (int axis = 0; axis < 3; ++axis)
      on_a_side = on_a_side || (at.row(axis).array() == 0.0).all() || (at.row(axis).array() == 1.0).all();
    EXPECT_TRUE(on_a_side) << face;
  }
}

TEST_P(Faces, EncloseTheVolumeWithTheirOutsideOutwards) {
  const SolidMesh mesh = skewed_box(GetParam()).mesh;
  const Connectivity faces = boundary_faces(mesh);
  double volume = 0.0;  // a third of the flux of the position
  for (int face = 0; face < faces.cols(); ++face) {
    const Eigen::Matrix<double, 3, 4> corner = mesh.nodes(Eigen::all, faces.col(face).head(4));
    const Eigen::Vector3d area =
        0.5 * Eigen::Vector3d(corner.col(2) - corner.col(0)).cross(corner.col(3) - corner.col(1));
    volume += area.dot(corner.rowwise().mean()) / 3.0;
  }
  // The mapping of the unit cube has the determinant 2 * 1 * 3: its shears do not change it.
  EXPECT_NEAR(volume, 6.0, 1e-13 * 6.0);
}

TEST_P(Faces, MidpointsLieBetweenTheirCorners) {
  const SolidMesh mesh = skewed_box(GetParam()).mesh;
  const Connectivity faces = boundary_faces(mesh);
  for (int face = 0; face < faces.cols(); ++face) {
    const std::vector<int> ring = around(faces, face);
    ASSERT_EQ(static_cast<Eigen::Index>(ring.size()), faces.rows());
    if (ring.size() == 4) continue;
    for (std::size_t i = 1; i < 8; i += 2) {
      const Eigen::Vector3d middle = 0.5 * (mesh.nodes.col(ring[i - 1]) + mesh.nodes.col(ring[(i + 1) % 8]));
      EXPECT_LT((mesh.nodes.col(ring[i]) - middle).norm(), 1e-14);
    }
  }
}

TEST(BladeFaces, FormAClosedSurface) {
  const Blade blade = fem::blade();
  const Connectivity faces = boundary_faces(blade.model.mesh);
  EXPECT_EQ(faces.cols(), 2 * (11 * 1 + 11 * 16 + 1 * 16));
  std::map<std::pair<int, int>, int> edges;
  for (int face = 0; face < faces.cols(); ++face)
    for (int i = 0; i < 4; ++i) ++edges[{faces(i, face), faces((i + 1) % 4, face)}];
  for (const auto& [edge, count] : edges) {
    EXPECT_EQ(count, 1);  // each direction of an edge belongs to one face, the opposite one to its neighbour
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
  }
}

TEST(Surface, OfSolidsIsThatOfTheirBoundaryFaces) {
  for (const SolidElement element : {SolidElement::hexahedron8, SolidElement::hexahedron20}) {
    const SolidMesh solid = skewed_box(element).mesh;
    const MeshSurface surface = surface_of(mesh_of(solid));
    EXPECT_EQ(std::ssize(surface.triangles), 6 * boundary_faces(solid).cols());
    EXPECT_TRUE(surface.segments.empty());
    // The enclosed volume by the divergence theorem, for any order of the faces.
    double volume = 0.0, expected = 0.0;
    for (std::size_t i = 0; i < surface.triangles.size(); i += 3) {
      Eigen::Matrix3d corners;
      for (int k = 0; k < 3; ++k)
        corners.col(k) = solid.nodes.col(surface.triangles[i + static_cast<std::size_t>(k)]);
      volume += corners.determinant() / 6.0;
    }
    const Connectivity faces = boundary_faces(solid);
    for (Eigen::Index face = 0; face < faces.cols(); ++face)
      for (const auto& [a, b, c] : {std::tuple{0, 1, 2}, {0, 2, 3}}) {
        Eigen::Matrix3d corners;
        corners << solid.nodes.col(faces(a, face)), solid.nodes.col(faces(b, face)),
            solid.nodes.col(faces(c, face));
        expected += corners.determinant() / 6.0;
      }
    EXPECT_NEAR(volume, expected, 1e-12 * expected);
  }
}

TEST(Surface, HasShellsBeamsAndTheOuterFacesOfTetrahedraAndWedges) {
  Mesh mesh;
  mesh.points = Eigen::Matrix3Xd::Random(3, 9);
  const auto add = [&](int type, const std::vector<int>& points) {
    mesh.cell_types.push_back(type);
    mesh.connectivity.insert(mesh.connectivity.end(), points.begin(), points.end());
    mesh.cell_ends.push_back(static_cast<int>(mesh.connectivity.size()));
  };
  add(10, {0, 1, 2, 3});
  add(10, {0, 2, 1, 4});  // shares the face 0, 1, 2
  EXPECT_EQ(surface_of(mesh).triangles.size(), 3u * 6u);
  add(13,
      {0, 1, 3, 5, 6, 7});  // shares the face 0, 1, 3 of the first: a triangle and three quadrangles are new
  EXPECT_EQ(surface_of(mesh).triangles.size(), 3u * (5u + 1u + 6u));
  add(9, {0, 1, 2, 8});
  EXPECT_EQ(surface_of(mesh).triangles.size(), 3u * (12u + 2u));
  add(3, {0, 1});
  add(21, {1, 2, 8});  // ends 1 and 2, middle 8
  EXPECT_EQ(surface_of(mesh).segments, (std::vector<int>{0, 1, 1, 8, 8, 2}));
  const Mesh before = mesh;
  add(42, {0, 1, 2});
  EXPECT_THROW(surface_of(mesh), std::invalid_argument);
  mesh = before;
  add(12, {0, 1, 2});  // a hexahedron of three points
  EXPECT_THROW(surface_of(mesh), std::invalid_argument);
}

TEST(BoundaryFaces, OfAMeshThatIsNotValidAreRefused) {
  SolidMesh mesh = skewed_box(SolidElement::hexahedron8).mesh;
  mesh.elements(0, 0) = 1000000;
  EXPECT_THROW(boundary_faces(mesh), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::fem

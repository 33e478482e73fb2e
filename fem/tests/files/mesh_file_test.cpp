#include <sstream>

#include "expect_error.hpp"
#include "temporary_folder.hpp"
#include "testing.hpp"
#include "wavebalance/fem/mesh.hpp"
#include "wavebalance/fem/vtu.hpp"

namespace wavebalance::fem {
namespace {

NumberedMesh mesh_in(const std::string& text) {
  std::istringstream input(text);
  return read_mesh(input, "plate.inp");
}

constexpr const char* mixed = R"(** two shells, a beam in three lines and a spring
*HEADING
a plate, with a comma
*Node, nset=all
1, 0., 0., 0.
2, 1., 0.
3, 1., 1., 0.
4, 0., 1., 0.
10, 2., 0., 0.5
11, 2., 1.
7, 9., 9., 9.
*ELEMENT, TYPE=S4R, ELSET=skin
5, 1, 2, 3, 4
*Element, elset = edge, type = B32
6, 2,
10,
11
*ELEMENT, TYPE=SPRINGA, ELSET=spring
8, 1, 2
*SHELL SECTION, ELSET=skin, MATERIAL=steel
0.01
)";

TEST(MeshFile, HasTheNodesOfItsElementsInTheOrderOfTheirNumbers) {
  const NumberedMesh found = mesh_in(mixed);
  EXPECT_EQ(found.nodes, (std::vector<int>{1, 2, 3, 4, 10, 11}));  // 7 belongs to no element
  EXPECT_EQ(found.mesh.points.col(4), Eigen::Vector3d(2.0, 0.0, 0.5));
  EXPECT_EQ(found.mesh.points.col(5), Eigen::Vector3d(2.0, 1.0, 0.0));
  EXPECT_EQ(found.mesh.cell_types, (std::vector<int>{9, 21}));
  EXPECT_EQ(found.mesh.cell_ends, (std::vector<int>{4, 7}));
  // Both ends of an edge come before its middle.
  EXPECT_EQ(found.mesh.connectivity, (std::vector<int>{0, 1, 2, 3, 1, 5, 4}));
  found.mesh.validate();
}

TEST(MeshFile, HasSolidsWhoseNodesGoOnInTheNextLine) {
  std::string text = "*NODE\n";
  for (int i = 1; i <= 20; ++i) text += std::to_string(i) + ", " + std::to_string(i * i % 7) + ", 1, 2\n";
  text +=
      "*ELEMENT, TYPE=C3D20R\n1, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10,\n11, 12, 13, 14, 15, 16, 17, 18, 19, 20\n";
  const NumberedMesh found = mesh_in(text);
  EXPECT_EQ(found.mesh.cell_types, (std::vector<int>{25}));
  EXPECT_EQ(found.mesh.connectivity.size(), 20u);
  const std::string written =
      vtu_text(found.mesh, std::vector<PointField>{{"displacement", Eigen::MatrixXd::Ones(3, 20)}});
  EXPECT_NE(written.find("NumberOfPoints=\"20\" NumberOfCells=\"1\""), std::string::npos);
}

TEST(MeshFile, TakesFilesThatItIncludes) {
  const TemporaryFolder folder;
  folder.write("nodes.inp", "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n");
  const auto file = folder.write("beam.inp", "*INCLUDE, INPUT=nodes.inp\n*ELEMENT, TYPE=B31\n1, 1, 2\n");
  EXPECT_EQ(read_mesh(file).nodes, (std::vector<int>{1, 2}));
  const auto itself = folder.write("itself.inp", "*INCLUDE, INPUT=itself.inp\n");
  expect_error([&] { read_mesh(itself); }, "files include each other");
  const auto none = folder.write("none.inp", "*INCLUDE, INPUT=\"missing.inp\"\n");
  expect_error([&] { read_mesh(none); }, "missing.inp");
}

TEST(MeshFile, SaysLineAndReasonOfWhatItRefuses) {
  const std::string nodes = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n";
  expect_error([] { mesh_in(""); }, "there is no element");
  expect_error([&] { mesh_in(nodes); }, "there is no element");
  expect_error([&] { mesh_in(nodes + "*ELEMENT, TYPE=C3D99\n1, 1, 2\n"); },
               "plate.inp:5: the element is \"c3d99\"");
  expect_error([&] { mesh_in(nodes + "*ELEMENT\n1, 1, 2\n"); }, "the element is \"\"");
  expect_error([&] { mesh_in(nodes + "*ELEMENT, TYPE=S3\n1, 1, 2\n*STEP\n"); },
               "element 1 ends with 2 nodes; it must have 3");
  expect_error([&] { mesh_in(nodes + "*ELEMENT, TYPE=S3\n1, 1, 2, 3, 1\n"); }, "has 4 nodes; it must have 3");
  expect_error([&] { mesh_in(nodes + "*ELEMENT, TYPE=S3\n1, 1, 2, 8\n"); }, "an element has node 8");
  expect_error([&] { mesh_in(nodes + "2, 0, 0, 0\n"); }, "plate.inp:5: node 2 is there twice");
  expect_error([&] { mesh_in("*NODE\n1, nan, 0, 0\n"); }, "plate.inp:2");
  expect_error([&] { mesh_in("*NODE\n1, 0, 0, 0, 0\n"); }, "the line must hold node, x, y, z");
  expect_error([&] { mesh_in("*NODE\n1.5, 0, 0, 0\n"); }, "whole number");
}

TEST(Mesh, RefusesWhatDoesNotFit) {
  Mesh mesh{Eigen::Matrix3Xd::Zero(3, 2), {3}, {2}, {0, 1}};
  EXPECT_NO_THROW(mesh.validate());
  mesh.connectivity[1] = 2;
  expect_error([&] { mesh.validate(); }, "a point of a cell is 2");
  mesh.connectivity = {0};
  EXPECT_THROW(mesh.validate(), std::invalid_argument);
  mesh = {Eigen::Matrix3Xd::Constant(3, 1, std::numeric_limits<double>::infinity()), {1}, {1}, {0}};
  EXPECT_THROW(mesh.validate(), std::invalid_argument);
}

}  // namespace
}  // namespace wavebalance::fem

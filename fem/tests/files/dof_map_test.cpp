#include "wavebalance/fem/dof_map.hpp"

#include <gtest/gtest.h>

#include <sstream>

#include "expect_error.hpp"

namespace wavebalance::fem {
namespace {

DofMap dof_map(const std::string& text) {
  std::istringstream input(text);
  return read_dof_map(input, "plate.dof");
}

TEST(DofMap, NamesTheRowsInTheOrderOfTheLines) {
  for (const char* text :
       {"7.1\n7.3\n1042.2\n9.6\n", "7 x\n7 z\n1042 y\n9 rz\n", "node,direction\n7,1\n7,3\n1042,2\n9,6\n",
        "# of a plate\nNode; Direction\n7; UX\n7; UZ\n1042; uy\n\n9; ROTZ\n",
        "direction\tnode\r\nX\t7\r\nZ\t7\r\nY\t1042\r\nRZ\t9\r\n",
        "row node direction\n3 1042 y\n4 9 rz\n2 7 z\n1 7 x\n", "1 7 UX\n2 7 UZ\n4 9 ROTZ\n3 1042 UY\n",
        "  Matrix Eqn    Node    DOF\n  1  7  UX\n  2  7  UZ\n  3  1042  UY\n  4  9  ROTZ\n"}) {
    const DofMap map = dof_map(text);
    ASSERT_EQ(map.rows(), 4) << text;
    EXPECT_EQ(map.name(0), "node 7 x");
    EXPECT_EQ(map.name(3), "node 9 rz");
    for (int row = 0; row < 4; ++row)
      EXPECT_EQ(
          map.row(std::vector<NodeDof>{{7, 1}, {7, 3}, {1042, 2}, {9, 6}}[static_cast<std::size_t>(row)]),
          row);
    EXPECT_EQ(map.row({7, 2}), -1);
    EXPECT_EQ(map.row({8, 1}), -1);
    EXPECT_EQ(map.directions(7), (std::vector<int>{1, 3}));
    EXPECT_TRUE(map.directions(8).empty());
  }
}

// As CalculiX writes shells and beams, which it expands to solids.
TEST(DofMap, CountsTheRowsThatHaveOneName) {
  const DofMap map = dof_map("2.3\n7.1\n2.3\n2.1\n2.3\n");
  EXPECT_EQ(map.name(0), "node 2 z #1");
  EXPECT_EQ(map.name(2), "node 2 z #2");
  EXPECT_EQ(map.name(4), "node 2 z #3");
  EXPECT_EQ(map.name(1), "node 7 x");
  EXPECT_EQ(map.row({2, 3}), 0);
  EXPECT_EQ(map.row({2, 3, 3}), 4);
  EXPECT_EQ(map.row({2, 3, 4}), -1);
  EXPECT_EQ(map.copies({2, 3}), 3);
  EXPECT_EQ(map.copies({2, 1}), 1);
  EXPECT_EQ(map.copies({2, 2}), 0);
  EXPECT_EQ(map.directions(2), (std::vector<int>{1, 3}));
}

TEST(DofMap, NamesWhatIsWrongAndWhere) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "plate.dof:0: there is no row"},
      {"7.1\n7.0\n",
       "plate.dof:2: the direction is \"0\"; it must be x, y, z, rx, ry, rz, scalar or a number in 1..6"},
      {"7 w\n", "plate.dof:1: the direction is \"w\""},
      {"7.1\n8\n", "plate.dof:2: found \"8\"; the line must hold node.direction"},
      {"7 x 3\n", "plate.dof:1: found \"7 x 3\"; the line must hold node.direction, or node and direction"},
      {"seven x\n", "plate.dof:1: found the column \"seven\""},
      {"node direction\nseven x\n", "plate.dof:2: the node is \"seven\"; it must be a whole number"},
      {"node x\n", "found the column \"x\"; columns must be node, direction and, if there is one, row"},
      {"node row\n", "the columns node and direction must both be there"},
      {"row node direction\n1 7 x\n1 7 y\n", "plate.dof:3: row 1 is there twice, first in line 2"},
      {"row node direction\n1 7 x\n3 7 y\n", "there are 2 rows, the last is 3; all from 1 on must be there"},
      {"row node direction\n0 7 x\n", "the row is 0; it must be in 1.."},
  };
  for (const auto& [text, expected] : cases) expect_error([&, given = text] { dof_map(given); }, expected);
  expect_error([] { DofMap({{1, 8}}); }, "a direction is 8; it must be in 1..7");
}

}  // namespace
}  // namespace wavebalance::fem

#include "wavebalance/fem/internal_nodes.hpp"

#include "testing.hpp"
#include "wavebalance/fem/bar.hpp"

namespace wavebalance::fem {
namespace {

// A bar of two-node elements in each of three directions, held at one end, with `internal` amplitudes per
// element that couple to its own nodes.
struct Chain {
  std::vector<NodeDof> dofs;
  Eigen::SparseMatrix<double> stiffness;
};

Chain chain(int elements, int internal) {
  Chain made;
  const int size = 3 * elements * (1 + internal);
  std::vector<Eigen::Triplet<double>> entries;
  const auto node_row = [](int node, int axis) { return 3 * (node - 1) + axis; };
  for (int node = 1; node <= elements * (1 + internal); ++node)
    for (int axis = 1; axis <= 3; ++axis) made.dofs.push_back({node <= elements ? node : node + 100, axis});
  for (int element = 1; element <= elements; ++element)
    for (int axis = 0; axis < 3; ++axis) {
      const int right = node_row(element, axis), left = node_row(element - 1, axis);
      entries.emplace_back(right, right, 1.0);
      if (element > 1) {
        entries.emplace_back(left, left, 1.0);
        entries.emplace_back(right, left, -1.0);
        entries.emplace_back(left, right, -1.0);
      }
      for (int mode = 0; mode < internal; ++mode) {
        const int row = node_row(elements + internal * (element - 1) + mode + 1, axis);
        entries.emplace_back(row, row, 5.0);
      }
    }
  made.stiffness.resize(size, size);
  made.stiffness.setFromTriplets(entries.begin(), entries.end());
  return made;
}

TEST(InternalNodes, AreThoseWithoutWhichATranslationStrainsNothing) {
  const Chain made = chain(20, 3);
  EXPECT_EQ(first_internal_node(made.stiffness, DofMap(made.dofs)), std::optional(121));
}

TEST(InternalNodes, AreNoneOfAMeshThatHasNone) {
  for (const int elements : {3, 20, 200}) {
    const Chain made = chain(elements, 0);
    EXPECT_EQ(first_internal_node(made.stiffness, DofMap(made.dofs)), std::nullopt) << elements;
  }
}

}  // namespace
}  // namespace wavebalance::fem

#include <limits>

#include "hexahedron.hpp"
#include "require.hpp"

namespace wavebalance::fem {
namespace {

// A lattice of half steps: corners have even indices, edge midpoints one odd index.
class Lattice {
 public:
  Lattice(const std::array<int, 3>& cells, bool midpoints) : cells_(cells), midpoints_(midpoints) {
    double places = 1.0;
    for (int count : cells) {
      if (count < 1) detail::reject_value("structured_mesh", "an entry of cells", count, "at least 1");
      places *= 2.0 * count + 1.0;
    }
    const double most = std::numeric_limits<int>::max() / 4;
    detail::require_value(places <= most, "structured_mesh", "the product of 2 cells + 1", places,
                          "at most " + detail::text(most));
    numbers_.assign(static_cast<std::size_t>(places), -1);
    for (int k = 0; k <= 2 * cells[2]; ++k)
      for (int j = 0; j <= 2 * cells[1]; ++j)
        for (int i = 0; i <= 2 * cells[0]; ++i)
          if (has_node(i, j, k)) {
            numbers_[place(i, j, k)] = static_cast<int>(nodes_.size());
            nodes_.push_back({i, j, k});
          }
  }
  const std::vector<std::array<int, 3>>& nodes() const { return nodes_; }
  int number(int i, int j, int k) const { return numbers_[place(i, j, k)]; }

 private:
  bool has_node(int i, int j, int k) const { return i % 2 + j % 2 + k % 2 <= (midpoints_ ? 1 : 0); }
  std::size_t place(int i, int j, int k) const {
    return static_cast<std::size_t>(i + (2 * cells_[0] + 1) * (j + (2 * cells_[1] + 1) * k));
  }

  std::array<int, 3> cells_;
  bool midpoints_;
  std::vector<int> numbers_;
  std::vector<std::array<int, 3>> nodes_;
};

Connectivity cells_of(const Lattice& lattice, SolidElement element, const std::array<int, 3>& cells) {
  const Eigen::Matrix3Xi offsets = (detail::natural_nodes(element).array() + 1.0).cast<int>();
  Connectivity elements(offsets.cols(), cells[0] * cells[1] * cells[2]);
  for (int index = 0; index < elements.cols(); ++index) {
    const int i = 2 * (index % cells[0]);
    const int j = 2 * (index / cells[0] % cells[1]);
    const int k = 2 * (index / (cells[0] * cells[1]));
    for (Eigen::Index node = 0; node < offsets.cols(); ++node)
      elements(node, index) =
          lattice.number(i + offsets(0, node), j + offsets(1, node), k + offsets(2, node));
  }
  return elements;
}

}  // namespace

std::vector<int> StructuredMesh::nodes_where(
    const std::function<bool(const Eigen::Vector3d&)>& condition) const {
  std::vector<int> found;
  for (int node = 0; node < parameters.cols(); ++node)
    if (condition(parameters.col(node))) found.push_back(node);
  return found;
}

StructuredMesh structured_mesh(SolidElement element, const std::array<int, 3>& cells,
                               const std::function<Eigen::Vector3d(const Eigen::Vector3d&)>& mapping) {
  const Lattice lattice(cells, element != SolidElement::hexahedron8);
  const auto count = static_cast<Eigen::Index>(lattice.nodes().size());
  StructuredMesh result{{element, Eigen::Matrix3Xd(3, count), cells_of(lattice, element, cells)},
                        Eigen::Matrix3Xd(3, count)};
  for (Eigen::Index node = 0; node < count; ++node) {
    const auto& half_steps = lattice.nodes()[static_cast<std::size_t>(node)];
    for (int axis = 0; axis < 3; ++axis)
      result.parameters(axis, node) =
          half_steps[static_cast<std::size_t>(axis)] / (2.0 * cells[static_cast<std::size_t>(axis)]);
    result.mesh.nodes.col(node) = mapping(result.parameters.col(node));
  }
  return result;
}

}  // namespace wavebalance::fem

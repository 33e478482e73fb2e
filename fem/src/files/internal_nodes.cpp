#include "wavebalance/fem/internal_nodes.hpp"

#include <algorithm>
#include <functional>
#include <map>

namespace wavebalance::fem {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

// Forces K r over the square roots of the diagonal, of a translation of which nodes are taken out one by one.
class Translation {
 public:
  explicit Translation(const Sparse& stiffness)
      : stiffness_(stiffness),
        forces_(Eigen::VectorXd::Zero(stiffness.rows())),
        scale_(stiffness.diagonal()) {}

  void add(int row, double sign) {
    for (Sparse::InnerIterator entry(stiffness_, row); entry; ++entry) {
      const auto i = entry.row();
      if (!(scale_[i] > 0.0)) continue;
      strain_ -= forces_[i] * forces_[i] / scale_[i];
      forces_[i] += sign * entry.value();
      strain_ += forces_[i] * forces_[i] / scale_[i];
    }
  }
  double strain() const { return strain_; }

 private:
  const Sparse& stiffness_;
  Eigen::VectorXd forces_;
  Eigen::VectorXd scale_;
  double strain_ = 0.0;
};

}  // namespace

std::optional<int> first_internal_node(const Sparse& stiffness, const DofMap& map) {
  constexpr int directions = 3, per_element = 3;
  constexpr double much_less = 0.1;
  constexpr double most_internal = 0.8;  // three of each element, which has about one separate node
  std::map<int, std::vector<int>, std::greater<>> rows;  // of each node, the highest number first
  std::vector<Translation> along(directions, Translation(stiffness));
  for (int row = 0; row < map.rows(); ++row) {
    if (map.dof(row).direction > directions) continue;
    rows[map.dof(row).node].push_back(row);
    along[static_cast<std::size_t>(map.dof(row).direction - 1)].add(row, 1.0);
  }
  const auto strain = [&] {
    double sum = 0.0;
    for (const Translation& one : along) sum += one.strain();
    return sum;
  };
  const double whole = strain();
  double least = much_less * whole;
  std::optional<int> found;
  std::size_t taken = 0;
  for (const auto& [node, of_node] : rows) {
    if (double(++taken) > most_internal * double(rows.size()) || of_node.size() != directions) break;
    for (const int row : of_node) along[static_cast<std::size_t>(map.dof(row).direction - 1)].add(row, -1.0);
    if (taken % per_element != 0 || !(strain() < least)) continue;
    least = strain();
    found = node;
  }
  return found;
}

}  // namespace wavebalance::fem

#include "matrices/boundary.hpp"

#include "matrices/load_places.hpp"
#include "wavebalance/fem/craig_bampton.hpp"

namespace wavebalance::app {
namespace {

/// Entries of contacts and loads further apart than this, relative to themselves, differ.
constexpr double touch_rounding = 100.0 * std::numeric_limits<double>::epsilon();

/// How contacts and loads touch the unknowns: a column for each unknown.
Eigen::MatrixXd touches(const Scene& scene, const StructureFiles& files, const std::vector<int>& unknowns) {
  const solvers::ContactDirections directions = contact_directions(scene, files);
  const Eigen::MatrixXd loads = boundary_loads(scene, files)(unknowns, Eigen::all);
  std::vector<Eigen::Index> column(std::size_t(directions.cols()), -1);
  for (std::size_t i = 0; i < unknowns.size(); ++i) column[std::size_t(unknowns[i])] = Eigen::Index(i);
  Eigen::MatrixXd both = Eigen::MatrixXd::Zero(directions.rows() + loads.cols(), std::ssize(unknowns));
  for (int row = 0; row < directions.outerSize(); ++row)
    for (solvers::ContactDirections::InnerIterator entry(directions, row); entry; ++entry)
      both(row, column[std::size_t(entry.col())]) = entry.value();
  both.bottomRows(loads.cols()) = loads.transpose();
  return both;
}

bool same_name(const StructureFiles& files, int one, int other) {
  const fem::NodeDof& a = files.dof_map->dof(files.rows[std::size_t(one)]);
  const fem::NodeDof& b = files.dof_map->dof(files.rows[std::size_t(other)]);
  return a.node == b.node && a.direction == b.direction;
}

}  // namespace

std::vector<BoundaryCoordinate> boundary_coordinates(const Scene& scene, const StructureFiles& files) {
  const std::vector<int> unknowns = boundary_rows(scene, files);
  const Eigen::MatrixXd touched = files.dof_map ? touches(scene, files, unknowns) : Eigen::MatrixXd();
  std::vector<BoundaryCoordinate> boundary;
  std::vector<Eigen::Index> first;  // the column of each coordinate's first unknown
  const auto weight_in = [&](std::size_t k, Eigen::Index i) -> std::optional<double> {
    if (!same_name(files, boundary[k].unknowns.front(), unknowns[std::size_t(i)])) return std::nullopt;
    const auto one = touched.col(first[k]), other = touched.col(i);
    const double weight = one.dot(other) / one.squaredNorm();
    if ((other - weight * one).norm() > touch_rounding * other.norm()) return std::nullopt;
    return weight;
  };
  for (Eigen::Index i = 0; i < std::ssize(unknowns); ++i) {
    const int unknown = unknowns[std::size_t(i)];
    std::optional<double> weight;
    for (std::size_t k = 0; files.dof_map && k < boundary.size() && !weight; ++k)
      if ((weight = weight_in(k, i))) {
        boundary[k].unknowns.push_back(unknown);
        boundary[k].weights.push_back(*weight);
      }
    if (weight) continue;
    boundary.push_back({{unknown}, {1.0}});
    first.push_back(i);
  }
  return boundary;
}

std::vector<int> unknowns_of(const std::vector<BoundaryCoordinate>& boundary) {
  std::vector<int> unknowns;
  for (const BoundaryCoordinate& one : boundary) unknowns.push_back(one.unknowns.front());
  return unknowns;
}

Eigen::SparseMatrix<double> merging(const std::vector<BoundaryCoordinate>& boundary, Eigen::Index size) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const BoundaryCoordinate& one : boundary)
    for (std::size_t i = 1; i < one.unknowns.size(); ++i)
      entries.emplace_back(one.unknowns.front(), one.unknowns[i], -one.weights[i]);
  if (entries.empty()) return {};
  for (Eigen::Index i = 0; i < size; ++i) entries.emplace_back(i, i, 1.0);
  Eigen::SparseMatrix<double> result(size, size);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

fem::Matrices merged(const fem::Matrices& matrices, const Eigen::SparseMatrix<double>& merging) {
  const Eigen::SparseMatrix<double> transposed = merging.transpose();
  const auto of = [&](const Eigen::SparseMatrix<double>& matrix) -> Eigen::SparseMatrix<double> {
    if (matrix.size() == 0) return matrix;
    const Eigen::SparseMatrix<double> half = matrix * merging;
    return transposed * half;
  };
  return {.mass = of(matrices.mass), .damping = of(matrices.damping), .stiffness = of(matrices.stiffness)};
}

solvers::ContactDirections merged(const solvers::ContactDirections& directions,
                                  const Eigen::SparseMatrix<double>& merging) {
  solvers::ContactDirections result = directions * solvers::ContactDirections(merging);
  double largest = 0.0;
  for (int row = 0; row < result.outerSize(); ++row)
    for (solvers::ContactDirections::InnerIterator entry(result, row); entry; ++entry)
      largest = std::max(largest, std::abs(entry.value()));
  result.prune(largest, touch_rounding);
  return result;
}

}  // namespace wavebalance::app

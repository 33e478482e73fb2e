#include "structure/held_structure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "linalg/dense.hpp"
#include "linalg/index.hpp"

namespace wavebalance::solvers {
namespace {

// As many rows as R has columns, each the largest of what those before it leave of R.
std::vector<Index> pivot_rows(Eigen::MatrixXd rest) {
  std::vector<Index> rows;
  for (Index i = 0; i < rest.cols(); ++i) {
    Index row = 0;
    rest.rowwise().squaredNorm().maxCoeff(&row);
    const Eigen::RowVectorXd direction = rest.row(row).normalized();
    rest -= (rest * direction.transpose()) * direction;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

double HeldStructure::spring_stiffness(double frequency) const {
  const double omega = 2.0 * std::numbers::pi * std::exp2(2.0 * std::round(0.5 * std::log2(frequency)));
  return std::max(structure.stiffness.diagonal().cwiseAbs().maxCoeff(),
                  omega * omega * structure.mass.diagonal().cwiseAbs().maxCoeff());
}

LinearStructure HeldStructure::with_springs(double stiffness) const {
  LinearStructure held = structure;
  held.stiffness += stiffness * springs;
  return held;
}

HeldStructure hold(const LinearStructure& structure) {
  const Eigen::MatrixXd& rigid = structure.rigid_modes;
  const Eigen::MatrixXd moved = structure.contact_directions * rigid;  // S R
  constexpr double least = 1e-12;                                      // of squared sizes
  const auto modes = detail::symmetric_eigen(detail::transposed_product(moved, moved));
  HeldStructure held{structure, {}, {}, {}};
  held.structure.rigid_modes.resize(rigid.rows(), 0);
  const double largest = modes ? modes->values.tail(1)[0] : 0.0;
  const Index drifting = largest > 0.0 ? (modes->values.array() <= least * largest).count() : rigid.cols();
  const Index resisted = rigid.cols() - drifting;
  held.directions.resize(moved.rows(), resisted);
  for (Index i = 0; i < resisted; ++i)
    held.directions.col(i) =
        moved * modes->vectors.col(drifting + i) / std::sqrt(modes->values[drifting + i]);
  held.drifting = modes ? Eigen::MatrixXd(rigid * modes->vectors.leftCols(drifting)) : rigid;
  const Eigen::SparseMatrix<double> springs =
      Eigen::MatrixXd(structure.contact_directions.transpose() * held.directions)
          .sparseView();  // S^T Q, n x q
  held.springs = springs * springs.transpose();
  for (const Index row : pivot_rows(held.drifting)) held.springs.coeffRef(row, row) += 1.0;
  return held;
}

}  // namespace wavebalance::solvers

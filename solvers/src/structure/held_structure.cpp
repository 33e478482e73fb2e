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
  HeldStructure held{structure, {}, {}, {}, {}, {}};
  held.structure.rigid_modes.resize(rigid.rows(), 0);
  // The size of its terms, so that a motion whose terms cancel in every contact is one that none resists.
  const double size = (structure.contact_directions.cwiseAbs() * rigid.cwiseAbs()).squaredNorm();
  const Index drifting = modes ? (modes->values.array() <= least * size).count() : rigid.cols();
  const Index resisted = rigid.cols() - drifting;
  held.directions.resize(moved.rows(), resisted);
  for (Index i = 0; i < resisted; ++i)
    held.directions.col(i) =
        moved * modes->vectors.col(drifting + i) / std::sqrt(modes->values[drifting + i]);
  if (modes) held.resisted = rigid * modes->vectors.rightCols(resisted);
  held.drifting = modes ? Eigen::MatrixXd(rigid * modes->vectors.leftCols(drifting)) : rigid;
  const Eigen::SparseMatrix<double> springs =
      Eigen::MatrixXd(structure.contact_directions.transpose() * held.directions)
          .sparseView();  // S^T Q, n x q
  held.springs = springs * springs.transpose();
  held.drift_rows = pivot_rows(held.drifting);
  for (const Index row : held.drift_rows) held.springs.coeffRef(row, row) += 1.0;
  return held;
}

LinearStructure without_drift(const LinearStructure& structure) {
  const HeldStructure held = hold(structure);
  const Eigen::MatrixXd& drifting = held.drifting;
  constexpr double rounding = 1e-12;
  if (drifting.cols() == 0 ||
      !((structure.damping * drifting).norm() <= rounding * structure.damping.norm() * drifting.norm()))
    return structure;
  // Vectors perpendicular to the momenta of the drift have eigenvalues 0.
  const Eigen::MatrixXd momenta = structure.mass * drifting;
  const auto parts = detail::symmetric_eigen(detail::product_transposed(momenta, momenta));
  if (!parts) return structure;
  const Eigen::MatrixXd kept = parts->vectors.leftCols(structure.size() - drifting.cols());
  const auto projected = [&](const Eigen::SparseMatrix<double>& matrix) {
    return Eigen::SparseMatrix<double>(detail::transposed_product(kept, matrix * kept).sparseView());
  };
  LinearStructure rest;
  rest.mass = projected(structure.mass);
  rest.damping = projected(structure.damping);
  rest.stiffness = projected(structure.stiffness);
  rest.load = Eigen::VectorXd::Zero(kept.cols());
  rest.contact_directions = Eigen::MatrixXd(structure.contact_directions * kept).sparseView();
  rest.loss_factor = structure.loss_factor;
  rest.rigid_modes = detail::transposed_product(kept, held.resisted);
  return rest;
}

}  // namespace wavebalance::solvers

#pragma once

#include <algorithm>
#include <random>

#include "wavebalance/solvers/structure/condensation.hpp"

namespace wavebalance::solvers::testing {

// The same structure with its degrees of freedom in another order, which is not tridiagonal any more.
inline LinearStructure shuffled(const LinearStructure& structure, std::mt19937& generator) {
  Eigen::PermutationMatrix<Eigen::Dynamic> order(structure.size());
  order.setIdentity();
  auto& indices = order.indices();
  std::shuffle(indices.data(), indices.data() + indices.size(), generator);
  LinearStructure out = structure;
  out.mass = structure.mass.twistedBy(order);
  out.damping = structure.damping.twistedBy(order);
  out.stiffness = structure.stiffness.twistedBy(order);
  out.load = order * structure.load;
  out.contact_directions = structure.contact_directions * order.transpose();
  return out;
}

// The same structure in other coordinates: x = turn y, for any invertible n x n matrix.
inline LinearStructure turned(const LinearStructure& structure, const Eigen::MatrixXd& turn) {
  const auto congruent = [&](const Eigen::SparseMatrix<double>& matrix) -> Eigen::SparseMatrix<double> {
    const Eigen::MatrixXd product = turn.transpose() * (matrix * turn);
    return Eigen::MatrixXd(0.5 * (product + product.transpose())).sparseView();
  };
  LinearStructure out;
  out.mass = congruent(structure.mass);
  out.damping = congruent(structure.damping);
  out.stiffness = congruent(structure.stiffness);
  out.load = turn.transpose() * structure.load;
  out.contact_directions = Eigen::MatrixXd(structure.contact_directions * turn).sparseView();
  return out;
}

// Directions of unit size with all entries, from a normal distribution.
inline ContactDirections random_directions(int contacts, int size, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  Eigen::MatrixXd rows = Eigen::MatrixXd::NullaryExpr(contacts, size, [&] { return normal(generator); });
  rows.rowwise().normalize();
  return rows.sparseView();
}

inline constexpr CondensationMethod all_methods[] = {CondensationMethod::tridiagonal,
                                                     CondensationMethod::modal, CondensationMethod::dense,
                                                     CondensationMethod::sparse};

}  // namespace wavebalance::solvers::testing

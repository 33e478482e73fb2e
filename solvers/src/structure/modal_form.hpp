#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>

#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::solvers {

/// Columns of `shapes` with shapes^T (M, C, K) shapes = diag(mass), diag(damping), diag(stiffness).
struct ModalForm {
  Eigen::MatrixXd shapes;  // n x n
  Eigen::VectorXd mass, damping, stiffness;
  // Frobenius norms of the errors of the three diagonal forms, off the diagonal too.
  std::array<double, 3> errors = {};
};

/// The modes of a structure; nothing when C or K is not symmetric, neither K nor M is positive definite or
/// the damping couples them. O(n^3).
std::optional<ModalForm> modal_form(const LinearStructure& structure);

}  // namespace wavebalance::solvers

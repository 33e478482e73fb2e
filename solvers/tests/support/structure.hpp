#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::solvers::testing {

/// The structure of dense matrices, of which the rows are its contact directions.
inline LinearStructure structure(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& damping,
                                 const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& load,
                                 const ContactDirections& rows) {
  return {mass.sparseView(), damping.sparseView(), stiffness.sparseView(), load, rows};
}

inline LinearStructure structure(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& damping,
                                 const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& load,
                                 const Eigen::MatrixXd& rows) {
  return structure(mass, damping, stiffness, load, ContactDirections(rows.sparseView()));
}

}  // namespace wavebalance::solvers::testing

#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "wavebalance/fem/solid.hpp"

namespace wavebalance::fem {

/// The axis of rotation of a structure.
struct RotationAxis {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  ///< any length but zero
  Eigen::Vector3d point = Eigen::Vector3d::Zero();       ///< m, on the axis
};

/// The matrices that rotation adds to a linear structure, for the speed Omega = 1 rad/s. They grow with
/// Omega^2, so that one prestress solve serves all speeds of a Campbell diagram.
struct CentrifugalStiffness {
  Eigen::SparseMatrix<double> geometric;  ///< K_g, N/m: stress of the centrifugal load on the gradients
  Eigen::SparseMatrix<double> softening;  ///< S, kg: mass in the directions across the axis
  Eigen::VectorXd displacement;           ///< m, of the unknowns under the centrifugal load: K u = f

  /// K + Omega^2 (K_g - S). Throws std::invalid_argument if the sizes differ or speed is not finite.
  Eigen::SparseMatrix<double> stiffness(const Eigen::SparseMatrix<double>& at_rest, double speed) const;
};

/// Linear prestress: with P the projection across the axis and r the positions relative to it,
///
///     f = int rho N^T P r,   K u = f,   K_g = int dN/dx_a sigma_ab(u) dN/dx_b I,   S = int rho N^T P N.
///
/// Coriolis forces, 2 Omega x u', are left out: they are zero for motion along the axis. stiffness: from
/// solid_matrices(model). One sparse factorisation. Throws std::invalid_argument if sizes or axis do not
/// fit, std::domain_error if the stiffness is not positive definite.
CentrifugalStiffness centrifugal_stiffness(const SolidModel& model,
                                           const Eigen::SparseMatrix<double>& stiffness,
                                           const RotationAxis& axis);

}  // namespace wavebalance::fem

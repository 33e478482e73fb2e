#pragma once

#include "wavebalance/fem/solid.hpp"

namespace wavebalance::fem::detail {

/// Points (3 x p, natural coordinates) and weights of a product Gauss rule with 2 or 3 points per direction.
struct GaussRule {
  Eigen::Matrix3Xd points;
  Eigen::VectorXd weights;
};
GaussRule gauss_rule(int points_per_direction);
GaussRule stiffness_rule(SolidElement element);
GaussRule mass_rule(SolidElement element);

/// Natural coordinates of the nodes, 3 x k.
Eigen::Matrix3Xd natural_nodes(SolidElement element);

/// The functions of one element at p points: of the k nodes and, after them and in gradients only, the
/// three incompatible modes of the 8-node element.
struct Samples {
  Eigen::MatrixXd values;                    // k x p
  std::array<Eigen::MatrixXd, 3> gradients;  // functions x p, 1/m
  Eigen::VectorXd volumes;                   // weight times Jacobian determinant, m^3
};

/// Throws std::invalid_argument if the Jacobian is not positive at a point or sizes do not fit.
Samples sample(SolidElement element, const Eigen::Matrix3Xd& coordinates, const GaussRule& rule);

/// The elastic matrix of all functions, the incompatible ones included, 3f x 3f.
Eigen::MatrixXd elastic_matrix(const Samples& samples, const SolidMaterial& material);

/// 3 x functions: the displacements and the amplitudes of the incompatible modes that minimize the energy.
Eigen::Matrix3Xd with_incompatible_modes(SolidElement element, const Eigen::Matrix3Xd& coordinates,
                                         const SolidMaterial& material,
                                         const Eigen::Matrix3Xd& displacements);

/// Stress at the points, 6 x p, of coefficients 3 x functions.
Eigen::Matrix<double, 6, Eigen::Dynamic> stress_at(const Samples& samples, const SolidMaterial& material,
                                                   const Eigen::Matrix3Xd& coefficients);

/// k x k: the integral of density N_i N_j.
Eigen::MatrixXd scalar_mass(SolidElement element, const Eigen::Matrix3Xd& coordinates, double density);

/// scalar (k x k) times block (3 x 3) for each pair of nodes, 3k x 3k.
Eigen::MatrixXd expand_by_block(const Eigen::MatrixXd& scalar, const Eigen::Matrix3d& block);

}  // namespace wavebalance::fem::detail

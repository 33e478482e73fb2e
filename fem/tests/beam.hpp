#pragma once
#include <cmath>

#include "wavebalance/fem/solid.hpp"

namespace wavebalance::fem {

/// A straight bar along z, width along x, height along y, clamped at z = 0. Without lateral contraction,
/// which the clamp would hinder over a length outside beam theory.
struct Beam {
  double width, height, length;
  SolidMaterial material{210e9, 0.0, 7800.0};

  double area() const { return width * height; }
  double inertia() const { return width * height * height * height / 12; }
  /// Deflection along y under a unit load at the tip: bending, and shear with Timoshenko's coefficient for a
  /// rectangle, 10 (1 + nu)/(12 + 11 nu) [Cowper 1966].
  double timoshenko_deflection() const {
    const double nu = material.poissons_ratio;
    const double shear = material.youngs_modulus / (2 * (1 + nu)) * area() * 10 * (1 + nu) / (12 + 11 * nu);
    return length * length * length / (3 * material.youngs_modulus * inertia()) + length / shear;
  }
  /// Lowest frequency of bending along y, Euler-Bernoulli, rad/s.
  double euler_bernoulli_omega() const {
    return 1.8751040687119611 * 1.8751040687119611 / (length * length) *
           std::sqrt(material.youngs_modulus * inertia() / (material.density * area()));
  }
  StructuredMesh block(SolidElement element, const std::array<int, 3>& cells) const {
    return structured_mesh(element, cells, [this](const Eigen::Vector3d& at) {
      return Eigen::Vector3d(width * (at[0] - 0.5), height * (at[1] - 0.5), length * at[2]);
    });
  }
};

inline std::vector<int> root(const StructuredMesh& block) {
  return block.nodes_where([](const Eigen::Vector3d& at) { return at[2] == 0.0; });
}

}  // namespace wavebalance::fem

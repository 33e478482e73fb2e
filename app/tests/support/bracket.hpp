#pragma once
#include <cmath>
#include <numbers>

#include "wavebalance/fem/solid.hpp"

/// The steel bracket of scenes/matrices/bracket, m: an upright of 60 mm along z, a quarter bend of radius 20
/// mm and an arm of 60 mm along x, 20 mm wide along y and 4 mm thick, clamped at z = 0.
class Bracket {
 public:
  Bracket()
      : block_(
            wavebalance::fem::structured_mesh(wavebalance::fem::SolidElement::hexahedron20, {1, 1, 6}, &at)),
        model_(wavebalance::fem::hold_nodes(
            block_.mesh, {.youngs_modulus = 210e9, .poissons_ratio = 0.3, .density = 7800.0},
            block_.nodes_where([](const Eigen::Vector3d& place) { return place[2] == 0.0; }))) {}

  const wavebalance::fem::SolidModel& model() const { return model_; }

 private:
  /// From the width, the thickness from the inside out and the length, each in 0..1.
  static Eigen::Vector3d at(const Eigen::Vector3d& place) {
    constexpr double straight = 0.06, radius = 0.02, width = 0.02, thickness = 0.004;
    const double outwards = thickness * (place[1] - 0.5), along = 3.0 * place[2];
    const double angle = 0.5 * std::numbers::pi * std::min(1.0, std::max(0.0, along - 1.0));
    const double upright = straight * std::min(1.0, along), arm = straight * std::max(0.0, along - 2.0);
    const double bent = radius + outwards;
    return {radius - bent * std::cos(angle) + arm, width * place[0], upright + bent * std::sin(angle)};
  }

  wavebalance::fem::StructuredMesh block_;
  wavebalance::fem::SolidModel model_;
};

#pragma once
#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "wavebalance/fem/bar.hpp"

namespace wavebalance::fem {

/// The bar of [JL14, section 4].
inline BarOptions published_bar() {
  BarOptions options;
  options.stiffness_damping = 1e-4;
  return options;
}

/// Wave number times element size of mode m = 1, 2, ... of the clamped-free chain of n equal elements: the
/// shape is sin(kappa i) at node i, antisymmetric about the clamp and symmetric about the tip.
inline double phase_per_element(const BarOptions& bar, int mode) {
  return (2 * mode - 1) * std::numbers::pi / (2.0 * bar.elements);
}

/// Closed form of the discrete natural frequency (rad/s): the symbol of K_e over the symbol of M_e at
/// kappa, omega^2 = E/(rho h^2) (2 - 2 cos kappa) / ((1-s)(2 + cos kappa)/3 + s).
inline double discrete_omega(const BarOptions& bar, int mode) {
  const double kappa = phase_per_element(bar, mode);
  const double sine = std::sin(kappa / 2);
  const double size = bar.length / bar.elements;
  const double mass = (1 - bar.lumped_fraction) * (2 + std::cos(kappa)) / 3 + bar.lumped_fraction;
  return std::sqrt(bar.youngs_modulus / bar.density / mass) * 2 * sine / size;
}

/// The continuous bar: omega = (2m-1) pi/2 c/L.
inline double continuous_omega(const BarOptions& bar, int mode) {
  return (2 * mode - 1) * std::numbers::pi / 2 * std::sqrt(bar.youngs_modulus / bar.density) / bar.length;
}

}  // namespace wavebalance::fem

#pragma once
#include "wavebalance/fem/matrices.hpp"

namespace wavebalance::fem {

/// An axial bar, clamped at x = 0 and free at its tip x = length, in equal two-node elements. SI or any
/// consistent units.
struct BarOptions {
  double youngs_modulus = 70e9;    ///< Pa, > 0
  double density = 2700.0;         ///< kg/m^3, > 0
  double area = 25e-4;             ///< m^2, > 0
  double length = 1.0;             ///< m, > 0
  int elements = 25;               ///< >= 1
  double stiffness_damping = 0.0;  ///< s, >= 0; beta in C = beta K [JL14, below eq. (7)]
  /// Share of the lumped matrix in the mass, in [0, 1]: 0 consistent, 1 lumped. With 1/2 the leading errors
  /// of the two cancel and the frequencies converge with order 4 in the element size, not 2.
  double lumped_fraction = 0.0;

  /// Throws std::invalid_argument naming the member, its value and what is allowed.
  void validate() const;
};

/// Mass, damping and stiffness of the bar, tridiagonal. Unknown i = 0..elements-1 is the displacement (m) of
/// the node at x = (i+1) length/elements; the last is the tip. With h the element length and s the lumped
/// fraction, an element has
///
///     K_e = E A/h [1 -1; -1 1],   M_e = rho A h ((1-s)/6 [2 1; 1 2] + s/2 [1 0; 0 1]),
///
/// the matrices of linear shape functions and those with the mass moved to the nodes. O(elements), assembled
/// straight into compressed storage. Throws as BarOptions::validate does.
Matrices bar(const BarOptions& options);

}  // namespace wavebalance::fem

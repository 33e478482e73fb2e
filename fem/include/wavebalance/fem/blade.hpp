#pragma once
#include "wavebalance/fem/solid.hpp"

namespace wavebalance::fem {

/// A cambered, tapered and twisted blade on the plane z = 0. Each pair of values belongs to root and tip,
/// with linear interpolation in s = z/length between them. With xi, eta in [-1,1] along chord and thickness
/// (xi = -1 is the leading edge), the section is
///
///     x = xi c/2,   y = k (1 - xi^2) - 2k/3 + eta/2 t (edge + (1 - edge)(1 - xi^2)),
///
/// with chord c, thickness t = thickness_ratio c and camber k = camber_ratio c, turned by the angle from x
/// to y. The defaults are a titanium compressor blade of this project, an open substitute for the
/// proprietary one of [LL10, section 5.2].
struct BladeOptions {
  std::array<double, 2> chord = {0.052, 0.056};           ///< m, > 0
  std::array<double, 2> thickness_ratio = {0.09, 0.031};  ///< > 0
  std::array<double, 2> camber_ratio = {0.098, 0.011};
  std::array<double, 2> angle_degrees = {10.0, 35.0};
  double edge_thickness = 0.35;  ///< relative to the thickness at mid chord, in (0, 1]
  double length = 0.091;         ///< m, > 0
  SolidMaterial material;
  SolidElement element = SolidElement::hexahedron20;
  int chord_elements = 11;     ///< >= 1
  int thickness_elements = 1;  ///< >= 1
  int span_elements = 16;      ///< >= 1

  /// Throws std::invalid_argument naming the member, its value and what is allowed.
  void validate() const;
};

/// The blade with its root nodes held.
struct Blade {
  SolidModel model;
  /// Corner nodes of the tip on its two faces (eta = -1, 1), in pairs from the leading to the trailing edge.
  std::vector<int> contact_nodes;
  std::vector<int> contact_unknowns;   ///< radial (z) unknown of each contact node
  std::vector<int> boundary_unknowns;  ///< all three unknowns of each contact node
};

/// Throws std::invalid_argument as BladeOptions::validate does. O(elements).
Blade blade(const BladeOptions& options = {});

}  // namespace wavebalance::fem

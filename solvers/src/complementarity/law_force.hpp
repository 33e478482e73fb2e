#pragma once
#include "complementarity/complementarity_path.hpp"
#include "wavebalance/solvers/balance/contact_system.hpp"

namespace wavebalance::solvers {

/// Forces that contact laws and structure agree on, as far as was found.
struct LawForce {
  bool found = false;
  Eigen::VectorXd force, displacement;  ///< N, and the motion u0 - K force that they make, m
  /// The largest distance, over max |u0| + max |K force|, between this motion and the displacements at which
  /// the laws give these forces.
  double defect = 0.0;
  /// What rounding the displacements makes of the laws' forces, over the largest.
  double rounding = 0.0;
  double condition = 0.0;  ///< of the last linear system, see ComplementarityPath
  int corners = 0;
};

/// Contact by paths of linear complementarity problems: each law by its tangent where it starts, then, as
/// Newton's method for generalised equations does (Josephy), by its tangent at the forces found, until they
/// stay. Laws that are linear in contact need no second round. Forces are the unknowns: a law so stiff that
/// displacements do not resolve its penetration is met in displacement. Nothing is found for laws that do not
/// start with a positive finite slope or do not grow.
LawForce law_force(ContactSystem& system, ComplementarityPath::Observer observer);

}  // namespace wavebalance::solvers

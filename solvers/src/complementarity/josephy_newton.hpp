#pragma once
#include "complementarity/complementarity_path.hpp"
#include "wavebalance/solvers/balance/contact_system.hpp"
#include "wavebalance/solvers/balance/newton.hpp"
#include "wavebalance/solvers/complementarity/complementarity_options.hpp"

namespace wavebalance::solvers {

/// Forces that contact laws and structure agree on, as far as was found.
struct LawForce {
  bool found = false;
  SolveStatus status = SolveStatus::stalled;  ///< why nothing was found
  Strategy strategy = Strategy::none;         ///< of the first complementarity problem
  Eigen::VectorXd force, displacement;        ///< N, and the motion u0 - K force that they make, m
  /// The largest distance, over max |u0| + max |K force|, between this motion and the displacements at which
  /// the laws give these forces.
  double defect = 0.0;
  /// What rounding the displacements makes of the laws' forces, over the largest.
  double rounding = 0.0;
  double condition = 0.0;  ///< of the last linear system, see ComplementarityPath
  int pivots = 0;          ///< of all paths
};

/// Newton's method for generalised equations (N. H. Josephy, MRC Technical Summary Report 1965, University of
/// Wisconsin-Madison, 1979): each law is replaced by its tangent, first where it starts, then at the forces
/// found, and the linear complementarity problem is solved by LcpHomotopy, until the forces do not change any
/// more. Laws that are linear in contact need no second round. The unknowns are forces: a law so stiff that
/// displacements do not resolve its penetration is met in displacement. Nothing is found for laws that do not
/// start with a positive finite slope or do not grow.
LawForce josephy_newton(ContactSystem& system, const ComplementarityOptions& options, Observer observer);

}  // namespace wavebalance::solvers

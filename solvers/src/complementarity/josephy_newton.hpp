#pragma once
#include "complementarity/complementarity_path.hpp"
#include "wavebalance/solvers/balance/contact_system.hpp"
#include "wavebalance/solvers/balance/newton.hpp"
#include "wavebalance/solvers/complementarity/complementarity_options.hpp"

namespace wavebalance::solvers {

/// Contact forces that satisfy laws and structure, or the best found.
struct LawForce {
  bool found = false;
  SolveStatus status = SolveStatus::stalled;  ///< the reason when nothing was found
  Strategy strategy = Strategy::none;         ///< what solved the first complementarity problem
  Eigen::VectorXd force, displacement;        ///< N, and the motion u0 - K force, m
  /// The largest distance, over max |u0| + max |K force|, between this motion and the displacements at which
  /// the laws give these forces.
  double defect = 0.0;
  /// Largest change of a law's force if its displacement changes by rounding, over the largest force.
  double rounding = 0.0;
  double condition = 0.0;  ///< ComplementarityPath::condition() of the last linear system
  int pivots = 0;          ///< pivots of all paths together
};

/// Newton's method for generalised equations (N. H. Josephy, MRC Technical Summary Report 1965, University of
/// Wisconsin-Madison, 1979). Each law is replaced by its tangent, first at its gap, then at the forces found.
/// The linear complementarity problem is solved by LcpHomotopy. This is repeated until the forces do not
/// change any more; laws that are linear in contact need one round. The unknowns are forces, so that a law
/// whose penetration is below rounding of the displacements can still be satisfied. Nothing is found for laws
/// that do not have a positive finite slope at the gap, or whose force is bounded.
LawForce josephy_newton(ContactSystem& system, const ComplementarityOptions& options, Observer observer);

}  // namespace wavebalance::solvers

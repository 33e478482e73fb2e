#pragma once
#include <Eigen/Core>
#include <vector>

#include "wavebalance/solvers/response/forced_response.hpp"

namespace wavebalance::solvers {

/// Cells of the period on which a contact force is constant: the first sample (0..N-1) of each, ascending,
/// the first one 0; a cell ends where the next begins, the last one at N.
using ForceCells = std::vector<int>;

/// `count` cells of equal width. Throws std::invalid_argument unless count is positive and divides points.
ForceCells uniform_cells(int points, int count);

/// A response against a rigid obstacle on cells.
struct CellResponse {
  SolveStatus status = SolveStatus::stalled;
  int iterations = 0;
  ForceCells cells;
  Eigen::VectorXd cell_force;     ///< N, of each cell
  Eigen::VectorXd displacement;   ///< m, N samples: the response of the structure to this force
  Eigen::VectorXd contact_force;  ///< N, N samples

  bool converged() const { return status == SolveStatus::converged; }
};

/// The response of `problem` (frequency set, one contact) to a contact force in the space of Haar functions
/// that the cells span, with a rigid obstacle at `gap`:
///
///   u <= gap at the end of each cell,   force >= 0 in it,   product 0,   u = u0 - K force at the N samples.
///
/// Only the force is discretised anew. A force acts on the end of its own cell and on what follows, so that
/// against a structure whose contact has no mass and is damped the matrix of the active set is nearly lower
/// triangular with a positive diagonal, and the active set settles within a few steps; with means over the
/// cells, or points and functions of one number, it is nearly skew and cycles. Between the ends u may
/// exceed the gap by O(width^2). Cells much narrower than 1/M see the functions of the pair, not the
/// structure.
///
/// The active set of `start` (N force samples) is tried first; where it cycles or start is empty, a spring is
/// stiffened until its active set is that of the obstacle. O(cells N log N + active^3 per iteration). Throws
/// std::invalid_argument for a gap that is not finite and for cells that do not ascend from 0.
CellResponse cell_response(CondensedProblem& problem, double gap, const ForceCells& cells,
                           const NewtonOptions& options = {}, const Eigen::VectorXd& start = {});

/// When the refinement of force cells starts, refines and ends.
struct AdaptiveRigidOptions {
  int first_cells = 16;     ///< equal ones of the first round; divides N
  double tolerance = 1e-4;  ///< on the relative rms change of the displacement from one round to the next
  int max_cells = 256;
  int max_rounds = 40;
  double fraction = 0.8;  ///< share of the indicator that the cells bisected hold, 0..1
  NewtonOptions newton;
};

/// One round of the refinement of force cells.
struct AdaptiveCellRound {
  CellResponse response;
  double estimate = 1.0;  ///< relative rms change against the round before
};

/// Every round is kept; the last one is the answer.
struct AdaptiveCellResponse {
  std::vector<AdaptiveCellRound> rounds;
  bool met_tolerance = false;
};

/// Solve, estimate, mark, bisect. A cell is marked by width^3 times its largest force jump to a neighbour
/// squared: what the jump costs the displacement, which integrates the force once. Cells are not bisected
/// below 1/M, M the functions of the pair.
AdaptiveCellResponse adaptive_rigid_response(CondensedProblem& problem, double gap,
                                             const AdaptiveRigidOptions& options = {});

}  // namespace wavebalance::solvers

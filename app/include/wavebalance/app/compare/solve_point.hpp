#pragma once
#include <string>
#include <vector>

#include "wavebalance/app/compare/basis_pair.hpp"
#include "wavebalance/solvers/linalg/missing.hpp"

namespace wavebalance::app {

/// One way to compute a scene's response, and what came of it. Numbers that have no meaning are NaN.
struct SolvePoint {
  std::string method = "weighted_residual";  ///< or "phases", or a baseline of bench
  BasisPair pair = {};
  std::string inner_products = {};      ///< "exact" or "quadrature"
  int functions = 0;                    ///< M, of the balance that phases start from; 0 where there is none
  int points = 0;                       ///< N
  double tolerance = solvers::missing;  ///< of phases and time stepping
  double construction_seconds = solvers::missing;
  double seconds = solvers::missing;  ///< least of several solves from the linear response, plans made before
  double error = solvers::missing;    ///< that which decides: one of the following or, of both, the larger
  double displacement_error = solvers::missing;  ///< relative rms of all contacts against the reference
  double force_error = solvers::missing;         ///< the same of their forces
  bool converged = false;
  std::string status = {};  ///< why not; "not_run" when smaller sizes took too long
  bool on_front = false;
};

/// Marks the converged points that no other one beats in both time and error.
void mark_front(std::vector<SolvePoint>& points);
/// The converged points of a set that no other one of the set beats, by rising time.
std::vector<SolvePoint> envelope(std::vector<SolvePoint> points);
/// The weighted residuals of one pair, or the exact solution for the pair that represents it.
std::vector<SolvePoint> points_of(const BasisPair& pair, const std::vector<SolvePoint>& points);

}  // namespace wavebalance::app

#pragma once
#include <Eigen/Core>

#include "wavebalance/solvers/continuation/arc_length.hpp"
#include "wavebalance/solvers/linalg/progress.hpp"

namespace wavebalance::solvers {

/// How far a residual homotopy is followed.
struct ResidualHomotopyOptions {
  int max_points = 1500;
  /// Up to 1536 samples, beyond in proportion to them up to 2.5 times as many; 1e10 take one to three
  /// seconds.
  double max_operations = 3e9;
  Observer observer;  ///< called after each point with p

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// How it ended.
enum class HomotopyStatus { arrived, lost, effort_limit, cancelled };

/// Follows R(u) = p R(start) by arc length, through folds and contact events, from p = 1, which `start`
/// solves, to a solution at p = 0 [E. L. Allgower, K. Georg, Introduction to Numerical Continuation Methods,
/// 2003, chapter 1: global or Newton homotopy]. `u` becomes the solution when it arrived and stays `start`
/// otherwise. The system is left without an added motion. O(points (active^3 + N log N)).
HomotopyStatus residual_homotopy(ContactSystem& system, Eigen::VectorXd& u,
                                 const ResidualHomotopyOptions& options);

}  // namespace wavebalance::solvers

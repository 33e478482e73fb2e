#pragma once
#include <Eigen/Core>

#include "collocation/collocation_newton.hpp"
#include "wavebalance/solvers/exact/problem_family.hpp"

namespace wavebalance::solvers::detail {

/// The unknown that is fixed while the parameter of the family is solved for instead.
struct Held {
  enum class Kind { parameter, passage, force };
  Kind kind = Kind::parameter;
  Eigen::Index index = 0;  ///< number of the passage, or of the node

  /// Its number among n forces, the passages and the parameter.
  Eigen::Index number(Eigen::Index forces, Eigen::Index passages) const;
};

/// A solution with one unknown held.
struct HeldSolution {
  CollocationResult newton;
  double value = 0.0;  ///< of the parameter
  /// Changes of all unknowns along the curve of solutions: n forces at fixed times, the passages, the
  /// parameter. The change of the fixed unknown is 1. Empty if not known.
  Eigen::VectorXd direction;
};

/// Newton's method on the forces at q nodes of each panel, the passages and the parameter but the unknown
/// held. `length`, m: as of CollocationModel. The derivative by the parameter is a difference.
HeldSolution solve_held(const ProblemFamily& family, double length, double value, CollocationIterate start,
                        const LegendreNodes& nodes, const Held& held, const NewtonLimits& limits);

}  // namespace wavebalance::solvers::detail

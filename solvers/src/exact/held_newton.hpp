#pragma once
#include <Eigen/Core>

#include "collocation/collocation_newton.hpp"
#include "wavebalance/solvers/exact/problem_family.hpp"

namespace wavebalance::solvers::detail {

/// The unknown that is held while the parameter of the family is sought in its place.
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
  /// How all unknowns change along the curve of solutions: n forces at fixed times, the passages, the
  /// parameter. That of the unknown held is 1. Empty where it is not known.
  Eigen::VectorXd direction;
};

/// Newton's method on the forces at q nodes of each panel, the passages and the parameter but the unknown
/// held. `length`, m: as of CollocationModel. The derivative by the parameter is a difference.
HeldSolution solve_held(const ProblemFamily& family, double length, double value, CollocationIterate start,
                        const LegendreNodes& nodes, const Held& held, const NewtonLimits& limits);

}  // namespace wavebalance::solvers::detail

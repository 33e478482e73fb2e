#pragma once
#include <Eigen/Core>

namespace wavebalance::solvers {

/// A quadrature rule on [0, 1].
struct QuadratureRule {
  Eigen::VectorXd points, weights;
};

/// Gauss and Legendre's rule with `count` >= 1 points, by GSL. O(count^2).
QuadratureRule gauss_rule(int count);

}  // namespace wavebalance::solvers

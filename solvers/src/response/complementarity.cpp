#include "wavebalance/solvers/response/complementarity.hpp"

#include <algorithm>

namespace wavebalance::solvers {

Complementarity complementarity(const Eigen::VectorXd& displacement, const Eigen::VectorXd& force,
                                const Eigen::VectorXd& gaps) {
  const Eigen::Index points = displacement.size() / gaps.size();
  const Eigen::VectorXd opening = gaps.transpose().replicate(points, 1).reshaped() - displacement;
  Complementarity result{-opening.minCoeff(), force.minCoeff(), 0.0};
  const double size = std::max(opening.cwiseAbs().maxCoeff(), displacement.cwiseAbs().maxCoeff());
  const double largest = force.cwiseAbs().maxCoeff();
  if (largest > 0.0 && size > 0.0)
    result.product = (force / largest).cwiseProduct(opening / size).cwiseAbs().maxCoeff();
  return result;
}

}  // namespace wavebalance::solvers

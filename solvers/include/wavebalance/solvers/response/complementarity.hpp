#pragma once
#include <Eigen/Core>

namespace wavebalance::solvers {

/// Violation of u <= gap, force >= 0 and product 0 at the samples, over all contacts. In the force form a
/// rigid law holds for all weighting functions, and these are discretisation errors.
struct Complementarity {
  double max_penetration = 0.0;  ///< max(u - gap), m; negative when nothing touches
  double min_force = 0.0;        ///< N
  /// max |force (gap - u)| over max force and the larger of max |gap - u| and max |u|; 0 without contact.
  double product = 0.0;
};

/// For samples of contacts with one gap each, contact-major. O(samples).
Complementarity complementarity(const Eigen::VectorXd& displacement, const Eigen::VectorXd& force,
                                const Eigen::VectorXd& gaps);

}  // namespace wavebalance::solvers

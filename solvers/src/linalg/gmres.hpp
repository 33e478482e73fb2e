#pragma once
#include <Eigen/Core>
#include <functional>

namespace wavebalance::solvers {

/// y = A v of a square matrix that is known by its products.
using LinearMap = std::function<void(const Eigen::VectorXd& v, Eigen::VectorXd& product)>;

struct GmresResult {
  bool solved = false;    ///< the residual is at most the target
  int iterations = 0;     ///< products with A
  double residual = 0.0;  ///< ||right - A x||
};

/// GMRES without restarts: x from the Krylov space of `right` with the least ||right - A x||, until that is
/// at most `target` or until `max_iterations` products. Never divides by a vanishing number: where the space
/// is exhausted or a value is not finite it stops with solved = false.
/// O(iterations) products and O(n iterations^2); holds iterations + 1 vectors. (Y. Saad, M. H. Schultz, SIAM
/// J. Sci. Stat. Comput. 7, 1986, doi:10.1137/0907058.)
GmresResult gmres(const LinearMap& map, const Eigen::VectorXd& right, double target, int max_iterations,
                  Eigen::VectorXd& x);

}  // namespace wavebalance::solvers

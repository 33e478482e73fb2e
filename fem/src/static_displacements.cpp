#include "wavebalance/fem/static_displacements.hpp"

#include "require.hpp"
#include "symmetric_factor.hpp"

namespace wavebalance::fem {

Eigen::MatrixXd static_displacements(const Eigen::SparseMatrix<double>& stiffness,
                                     const Eigen::MatrixXd& loads) {
  detail::require_square(stiffness, "static_displacements", "stiffness", stiffness.rows());
  detail::require_symmetric(stiffness, "static_displacements", "stiffness");
  detail::require_count("static_displacements", "the number of rows of loads", loads.rows(),
                        stiffness.rows());
  const detail::SymmetricFactor factor(stiffness);
  if (!factor.positive_definite())
    throw std::domain_error("static_displacements: the stiffness is not positive definite");
  return factor.solve(loads);
}

}  // namespace wavebalance::fem

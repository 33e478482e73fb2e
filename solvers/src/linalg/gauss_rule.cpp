#include "linalg/gauss_rule.hpp"

#include <gsl/gsl_integration.h>

#include <memory>

namespace wavebalance::solvers {

QuadratureRule gauss_rule(int count) {
  const auto size = static_cast<std::size_t>(count);
  const std::unique_ptr<gsl_integration_glfixed_table, void (*)(gsl_integration_glfixed_table*)> table(
      gsl_integration_glfixed_table_alloc(size), gsl_integration_glfixed_table_free);
  QuadratureRule rule{Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (std::size_t i = 0; i < size; ++i)
    gsl_integration_glfixed_point(0.0, 1.0, i, &rule.points[Eigen::Index(i)], &rule.weights[Eigen::Index(i)],
                                  table.get());
  return rule;
}

}  // namespace wavebalance::solvers

#include "linalg/gauss_rule.hpp"

#include <gsl/gsl_integration.h>

#include <cmath>
#include <memory>

namespace wavebalance::solvers {
namespace {

using Table = std::unique_ptr<gsl_integration_glfixed_table, void (*)(gsl_integration_glfixed_table*)>;

// Legendre's polynomial of degree `degree` >= 1 and its derivative at |x| < 1.
struct Legendre {
  double value, slope;
};
Legendre legendre(int degree, double x) {
  double before = 1.0, value = x;
  for (int k = 1; k < degree; ++k) {
    const double next = (double(2 * k + 1) * x * value - double(k) * before) / double(k + 1);
    before = value;
    value = next;
  }
  return {value, double(degree) * (before - x * value) / (1.0 - x * x)};
}

}  // namespace

// GSL's nodes are tabulated for some numbers and accurate to 1e-10 only for others; a step of Newton's method
// brings them to rounding.
QuadratureRule gauss_rule(int count) {
  const Table table(gsl_integration_glfixed_table_alloc(static_cast<std::size_t>(count)),
                    gsl_integration_glfixed_table_free);
  QuadratureRule rule{Eigen::VectorXd(count), Eigen::VectorXd(count)};
  for (int i = 0; i < count; ++i) {
    double x = 0.0, weight = 0.0;
    gsl_integration_glfixed_point(-1.0, 1.0, static_cast<std::size_t>(i), &x, &weight, table.get());
    const Legendre at = legendre(count, x);
    x -= at.value / at.slope;
    const double slope = legendre(count, x).slope;
    rule.points[i] = 0.5 * (1.0 + x);
    rule.weights[i] = 1.0 / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

}  // namespace wavebalance::solvers

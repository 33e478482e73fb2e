#pragma once
#include <gtest/gtest.h>

#include <random>

#include "support/small_problems.hpp"
#include "wavebalance/solvers/balance/contact_system.hpp"

/// Checks of Newton's systems for every kind of law and pair.
namespace wavebalance::solvers::testing {

/// J x at a state by central differences of the residual, at which the system is left evaluated.
inline Eigen::VectorXd derivative_along(ContactSystem& system, const Eigen::VectorXd& state,
                                        const Eigen::VectorXd& x, double largest_step) {
  const double step = largest_step / x.cwiseAbs().maxCoeff();
  system.evaluate(state + step * x);
  const Eigen::VectorXd ahead = system.residual();
  system.evaluate(state - step * x);
  const Eigen::VectorXd along = (ahead - system.residual()) / (2.0 * step);
  system.evaluate(state);
  return along;
}

inline void expect_solve_inverts_derivative(ContactSystem& system, const Eigen::VectorXd& state,
                                            std::mt19937& generator, double largest_step) {
  const Eigen::VectorXd right = random_vector(state.size(), generator);
  system.evaluate(state);
  ASSERT_TRUE(system.factorize());
  Eigen::VectorXd x;
  ASSERT_TRUE(system.solve(right, x));
  EXPECT_LE((derivative_along(system, state, x, largest_step) - right).norm(),
            1e-6 * (right.norm() + x.norm()));
}

/// With and without a border.
inline void expect_gmres_equals_lu(ContactSystem& system, Eigen::Index samples, std::mt19937& generator) {
  const Eigen::VectorXd r = random_vector(samples, generator), b = random_vector(samples, generator),
                        c = random_vector(samples, generator);
  Eigen::VectorXd plain[2], bordered[2];
  double last[2] = {0.0, 0.0};
  for (const int i : {0, 1}) {
    system.set_linear_solver(i == 0 ? LinearSolver::dense : LinearSolver::krylov);
    ASSERT_TRUE(system.factorize() && system.solve(r, plain[i], 1e-12));
    ASSERT_TRUE(system.factorize_bordered(b, c, 0.7));
    ASSERT_TRUE(system.solve_bordered(r, -0.4, bordered[i], last[i], 1e-12));
  }
  EXPECT_LE((plain[0] - plain[1]).norm(), 1e-9 * plain[0].norm());
  EXPECT_LE((bordered[0] - bordered[1]).norm(), 1e-9 * bordered[0].norm());
  EXPECT_NEAR(last[0], last[1], 1e-9 * std::abs(last[0]));
  EXPECT_NEAR(c.dot(bordered[1]) + 0.7 * last[1], -0.4, 1e-9 * c.norm() * bordered[1].norm());
}

}  // namespace wavebalance::solvers::testing

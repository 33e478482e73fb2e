#include <rapidcheck/gtest.h>

#include "quadratic_program.hpp"
#include "random_values.hpp"
#include "testing.hpp"

namespace wavebalance::contact {
namespace {

int any_count(int least, int greatest) {
  return *rc::gen::resize(rc::kNominalSize, rc::gen::inRange(least, greatest + 1));
}

Eigen::MatrixXd any_matrix(int rows, int columns) {
  Eigen::MatrixXd result(rows, columns);
  for (Eigen::Index i = 0; i < result.size(); ++i) result.data()[i] = any_between(-1, 1);
  return result;
}

struct SolvedProgram {
  QuadraticProgram program;
  Eigen::VectorXd x, lambda, mu;
};

// Independent constraints, fewer than unknowns: then the multipliers are unique.
SolvedProgram any_program() {
  const int n = any_count(3, 8), inequalities = any_count(1, n - 2), equalities = any_count(0, 1);
  const Eigen::MatrixXd root = any_matrix(n, n);
  const Eigen::MatrixXd hessian = root.transpose() * root + Eigen::MatrixXd::Identity(n, n);
  Eigen::MatrixXd rows = 0.2 * any_matrix(inequalities + equalities, n);
  rows.leftCols(rows.rows()) += Eigen::MatrixXd::Identity(rows.rows(), rows.rows());
  Eigen::VectorXd lambda(inequalities);
  for (double& value : lambda) value = *rc::gen::element(0.0, 1.0) * any_between(0.01, 3);
  const Eigen::VectorXd x = any_matrix(n, 1), mu = any_matrix(equalities, 1);
  return {QuadraticProgram::with_solution(hessian, rows.topRows(inequalities), rows.bottomRows(equalities), x,
                                          lambda, mu, any_between(0.01, 1)),
          x, lambda, mu};
}

RC_GTEST_PROP(MultiplierUpdateProperty, FindsTheSolutionAndTheMultipliersOfAConvexProgram, ()) {
  const SolvedProgram solved = any_program();
  const double penalty = std::pow(10.0, any_between(-1, 4));
  MultiplierUpdate outer(std::vector<double>(solved.lambda.size(), penalty),
                         std::vector<double>(solved.mu.size(), penalty));
  const OuterIterations run = solve(solved.program, outer);
  RC_ASSERT(run.converged());
  RC_ASSERT((run.x - solved.x).norm() < 1e-8);
  RC_ASSERT((as_vector(outer.inequality_multipliers()) - solved.lambda).norm() < 1e-6);
  RC_ASSERT((as_vector(outer.equality_multipliers()) - solved.mu).norm() < 1e-6);
}

RC_GTEST_PROP(MultiplierUpdateProperty, AcceptedMeasuresFallPenaltiesRiseAndMultipliersStayAdmissible, ()) {
  const SolvedProgram solved = any_program();
  MultiplierUpdate outer(std::vector<double>(solved.lambda.size(), std::pow(10.0, any_between(-2, 2))),
                         std::vector<double>(solved.mu.size(), 1.0));
  Eigen::VectorXd x = Eigen::VectorXd::Zero(solved.x.size());
  double accepted = std::numeric_limits<double>::infinity();
  for (int j = 0; j < 100; ++j) {
    solved.program.solve_inner(x, outer);
    const MultiplierUpdate before = outer;
    const MultiplierStep step = outer.update(as_span(solved.program.g(x)), as_span(solved.program.h(x)));
    const bool updated = step.inequality == MultiplierAction::multipliers_updated ||
                         step.inequality == MultiplierAction::multipliers_and_penalties_updated;
    if (updated) {
      RC_ASSERT(step.inequality_measure < accepted);
      accepted = step.inequality_measure;
    }
    for (int i = 0; i < outer.inequalities(); ++i) {
      const double multiplier = outer.inequality_multipliers()[i], old = before.inequality_multipliers()[i];
      RC_ASSERT(outer.inequality_penalties()[i] >= before.inequality_penalties()[i]);
      RC_ASSERT(outer.inequality_shifts()[i] >= 0.0);
      if (!updated) RC_ASSERT(std::abs(multiplier - old) <= 4 * eps * old);
    }
    if (step.converged()) return;
  }
  RC_FAIL("not converged");
}

// An updated multiplier is the contact force of the inner problem just solved.
RC_GTEST_PROP(MultiplierUpdateProperty, MultipliersAreTheForcesOfTheInnerProblem, ()) {
  const int n = any_count(1, 10);
  MultiplierUpdate outer(std::vector<double>(n, std::pow(10.0, any_between(-3, 3))));
  std::vector<double> first(n), g(n), force(n), tangent(n);
  for (double& value : first) value = any_between(0, 1);
  for (double& value : g) value = any_between(-1, 1);
  outer.restart(first);
  outer.inequality_force(g, force, tangent);
  outer.update(g);
  for (int i = 0; i < n; ++i)
    RC_ASSERT(std::abs(outer.inequality_multipliers()[i] - force[i]) <=
              8 * eps * (first[i] + outer.inequality_penalties()[i]));
}

}  // namespace
}  // namespace wavebalance::contact

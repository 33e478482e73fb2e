#pragma once
#include <Eigen/Cholesky>
#include <Eigen/Core>

#include <span>
#include <vector>

#include "wavebalance/contact/multipliers.hpp"

namespace wavebalance::contact {

inline std::span<const double> as_span(const Eigen::VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}
inline std::span<double> as_span(Eigen::VectorXd& v) {
  return {v.data(), static_cast<std::size_t>(v.size())};
}
inline Eigen::VectorXd as_vector(const std::vector<double>& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

/// min 1/2 x' H x - f' x subject to A x <= b and C x = d; H positive definite.
struct QuadraticProgram {
  Eigen::MatrixXd hessian;
  Eigen::VectorXd load;
  Eigen::MatrixXd inequality;
  Eigen::VectorXd inequality_bound;
  Eigen::MatrixXd equality;
  Eigen::VectorXd equality_bound;

  /// One whose solution and multipliers (>= 0 for inequalities; where zero, the constraint is open by slack)
  /// are these.
  static QuadraticProgram with_solution(const Eigen::MatrixXd& hessian, const Eigen::MatrixXd& inequality,
                                        const Eigen::MatrixXd& equality, const Eigen::VectorXd& x,
                                        const Eigen::VectorXd& lambda, const Eigen::VectorXd& mu,
                                        double slack) {
    QuadraticProgram program{
        hessian,    hessian * x + inequality.transpose() * lambda + equality.transpose() * mu,
        inequality, inequality * x,
        equality,   equality * x};
    for (Eigen::Index i = 0; i < lambda.size(); ++i)
      if (lambda[i] == 0.0) program.inequality_bound[i] += slack;
    return program;
  }

  Eigen::VectorXd g(const Eigen::VectorXd& x) const { return inequality * x - inequality_bound; }
  Eigen::VectorXd h(const Eigen::VectorXd& x) const { return equality * x - equality_bound; }
  double value(const Eigen::VectorXd& x) const { return 0.5 * x.dot(hessian * x) - load.dot(x); }

  double augmented_value(const Eigen::VectorXd& x, const MultiplierUpdate& outer) const {
    return value(x) + outer.inequality_term(as_span(g(x))) + outer.equality_term(as_span(h(x)));
  }

  /// Minimises the augmented Lagrangian from x by Newton's method with line search: exact in finitely many
  /// steps, as the functional is convex and piecewise quadratic. False after 200 steps.
  bool solve_inner(Eigen::VectorXd& x, const MultiplierUpdate& outer) const {
    const Eigen::VectorXd penalty =
        Eigen::Map<const Eigen::VectorXd>(outer.equality_penalties().data(), outer.equalities());
    Eigen::VectorXd force(outer.inequalities()), tangent(outer.inequalities()), pull(outer.equalities());
    for (int iteration = 0; iteration < 200; ++iteration) {
      outer.inequality_force(as_span(g(x)), as_span(force), as_span(tangent));
      outer.equality_force(as_span(h(x)), as_span(pull));
      const Eigen::VectorXd gradient =
          hessian * x - load + inequality.transpose() * force + equality.transpose() * pull;
      const Eigen::MatrixXd curvature = hessian + inequality.transpose() * tangent.asDiagonal() * inequality +
                                        equality.transpose() * penalty.asDiagonal() * equality;
      const Eigen::VectorXd step = curvature.llt().solve(-gradient);
      if (step.norm() <= 1e-14 * (1.0 + x.norm())) return true;
      const double before = augmented_value(x, outer), descent = gradient.dot(step);
      double length = 1.0;
      while (length > 1e-10 && augmented_value(x + length * step, outer) >
                                   before + 1e-4 * length * descent + 1e-13 * std::abs(before))
        length *= 0.5;
      x += length * step;
    }
    return false;
  }
};

struct OuterIterations {
  std::vector<MultiplierStep> steps;
  Eigen::VectorXd x;
  bool converged() const { return !steps.empty() && steps.back().converged(); }
};

/// [LL10, Algorithm 3] with that inner problem, from x = 0.
inline OuterIterations solve(const QuadraticProgram& program, MultiplierUpdate& outer, int most = 100) {
  OuterIterations result;
  result.x = Eigen::VectorXd::Zero(program.load.size());
  for (int j = 0; j < most; ++j) {
    program.solve_inner(result.x, outer);
    result.steps.push_back(outer.update(as_span(program.g(result.x)), as_span(program.h(result.x))));
    if (result.converged() || result.steps.back().stalled()) break;
  }
  return result;
}

}  // namespace wavebalance::contact

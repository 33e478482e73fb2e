#include "wavebalance/solvers/balance/contact_system.hpp"

#include <cmath>
#include <limits>

#include "balance/jacobian_solver.hpp"
#include "linalg/safe_norm.hpp"

namespace wavebalance::solvers {

namespace {

// A power of two that brings numbers whose products leave the range of double precision to the order of 1.
double border_scale(const Eigen::VectorXd& values) {
  const double largest = values.size() > 0 ? values.cwiseAbs().maxCoeff() : 1.0;
  const bool extreme = std::isfinite(largest) && largest > 0.0 && (largest < 1e-100 || largest > 1e100);
  return extreme ? std::ldexp(1.0, -std::ilogb(largest)) : 1.0;
}

}  // namespace

ContactSystem::ContactSystem(CondensedProblem& problem, ContactLaws laws)
    : problem_(&problem),
      laws_(std::move(laws)),
      force_(problem.samples()),
      tangent_(problem.samples()),
      jacobian_(std::make_unique<JacobianSolver>()) {
  laws_.require(problem.contacts());
  if (problem.regularization().size() > 0) laws_ = laws_.resolvents(problem.regularization());
  gaps_ = laws_.gaps(problem.contacts());
}
ContactSystem::ContactSystem(ContactSystem&&) noexcept = default;
ContactSystem& ContactSystem::operator=(ContactSystem&&) noexcept = default;
ContactSystem::~ContactSystem() = default;

double ContactSystem::evaluate(const Eigen::VectorXd& displacement) {
  laws_.evaluate(problem_->contacts(), displacement, force_, tangent_);
  return evaluate_residual(displacement);
}

double ContactSystem::evaluate(const Eigen::VectorXd& displacement, const ActiveMask& presses) {
  laws_.evaluate(problem_->contacts(), displacement, force_, tangent_);
  for (int l = 0; l < displacement.size(); ++l) {
    const double beyond = displacement[l] - gap_at(l);
    if (presses[l] == (beyond > 0.0) && beyond != 0.0) continue;
    tangent_[l] = presses[l] ? law_at(l).tangent(gap_at(l)) : 0.0;
    force_[l] = tangent_[l] * beyond;
  }
  return evaluate_residual(displacement);
}

double ContactSystem::evaluate_residual(const Eigen::VectorXd& displacement) {
  const Eigen::VectorXd& free = problem_->contact_free_response();
  if (force_.isZero(0.0)) {
    product_.setZero(displacement.size());
  } else {
    problem_->apply(force_, product_);
    const double contacts = problem_->contacts(), points = problem_->points();
    products_ += contacts * points * (20.0 * std::log2(points + 1.0) + 8.0 * contacts);
  }
  residual_ = displacement - free + product_;
  if (added_motion_.size() > 0) residual_ -= added_motion_;
  relative_residual_ = relative_to(safe_norm(free) + safe_norm(product_), safe_norm(residual_));
  if (!std::isfinite(relative_residual_)) relative_residual_ = std::numeric_limits<double>::infinity();
  return relative_residual_;
}

void ContactSystem::set_linear_solver(LinearSolver method) { jacobian_->set_method(method); }

bool ContactSystem::factorize() { return jacobian_->factorize(*problem_, tangent_); }

bool ContactSystem::solve(const Eigen::VectorXd& r, Eigen::VectorXd& x, double reduction) {
  return jacobian_->solve(*problem_, r, reduction, x);
}

double ContactSystem::operations() const { return products_ + jacobian_->operations(); }

double ContactSystem::condition() { return jacobian_->condition(*problem_); }

bool ContactSystem::factorize_bordered(const Eigen::VectorXd& b, const Eigen::VectorXd& c, double d) {
  column_scale_ = border_scale(b);
  row_scale_ = border_scale(c);
  return jacobian_->factorize_bordered(*problem_, tangent_, column_scale_ * b, row_scale_ * c,
                                       column_scale_ * d * row_scale_);
}

bool ContactSystem::solve_bordered(const Eigen::VectorXd& r, double s, Eigen::VectorXd& x, double& y,
                                   double reduction) {
  const bool solved = jacobian_->solve_bordered(*problem_, r, row_scale_ * s, reduction, x, y);
  y *= column_scale_;
  return solved;
}

int ContactSystem::determinant_sign() const { return jacobian_->determinant_sign(); }

}  // namespace wavebalance::solvers

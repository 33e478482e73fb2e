#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "linalg/damped_newton.hpp"
#include "linalg/enum_table.hpp"
#include "linalg/option_checks.hpp"
#include "linalg/safe_norm.hpp"
#include "wavebalance/solvers/balance/newton.hpp"

namespace wavebalance::solvers {

std::string_view to_string(SolveStatus status) {
  using enum SolveStatus;
  return detail::name_in<SolveStatus>({{converged, "converged"},
                                       {stalled, "stalled"},
                                       {iteration_limit, "iteration_limit"},
                                       {effort_limit, "effort_limit"},
                                       {singular, "singular"},
                                       {unbalanced, "unbalanced"},
                                       {inaccurate, "inaccurate"},
                                       {cancelled, "cancelled"}},
                                      status);
}

void NewtonOptions::validate() const {
  constexpr const char* who = "NewtonOptions";
  detail::require_positive(who, "tolerance", tolerance);
  detail::require_at_least(who, "max_iterations", max_iterations, 0);
  detail::require_positive(who, "min_step", min_step);
  detail::require_at_least(who, "memory", memory, 1);
  if (!(max_operations > 0.0)) detail::reject(who, "max_operations", max_operations, "positive");
}

namespace {

// Relative residual to which a Newton system is solved by iteration. It is small enough for the active sets
// and steps of exact solves, and not below what the tolerance needs.
double forcing_term(double residual, double tolerance) {
  constexpr double exact_enough = 1e-8, share = 0.1, least = 1e-12;
  return std::max({least, share * tolerance / residual, exact_enough * std::min(1.0, 100.0 * residual)});
}

// Target for force_defect(), and the value above which a small residual is not trusted.
constexpr double sought_defect = 1e-9, largest_defect = 1e-7;

// The force f gives the motion u - R, at which the law has the force f - D R; u is rounded, too. Returns this
// difference of forces, over the largest force, times the force's share of the motion.
double force_defect(ContactSystem& system, const Eigen::VectorXd& u) {
  constexpr double eps = std::numeric_limits<double>::epsilon();
  const double largest = system.force().cwiseAbs().maxCoeff();
  if (!(largest > 0.0)) return 0.0;
  const Eigen::VectorXd& free = system.problem().linear_response();
  const double share = safe_norm(u - free) / (safe_norm(u) + safe_norm(free));
  const auto error = system.residual().cwiseAbs() + eps * u.cwiseAbs();
  return share * system.tangent().cwiseProduct(error).maxCoeff() / largest;
}

// R(u) = 0 for damped_newton().
class ContactEquation {
 public:
  ContactEquation(ContactSystem& system, const NewtonOptions& options) : system_(system), options_(options) {}

  double evaluate(const Eigen::VectorXd& u) {
    system_.evaluate(u);
    return norm();
  }
  double norm() const { return safe_norm(system_.residual()); }

  // The force of a stiff law is improved further, as far as rounding allows.
  bool is_solved() {
    const double before = std::exchange(residual_, system_.relative_residual());
    history_.push_back(residual_);
    const bool settled = residual_ > 0.5 * before || force_defect(system_, *u_) <= sought_defect;
    return residual_ <= options_.tolerance && settled;
  }
  bool is_acceptable() const {
    return residual_ <= options_.tolerance && force_defect(system_, *u_) <= largest_defect;
  }

  bool direction(Eigen::VectorXd& direction) {
    factorized_ = true;
    singular_ = !system_.factorize();
    return !singular_ &&
           system_.solve(system_.residual(), direction, forcing_term(residual_, options_.tolerance));
  }
  bool goes_on(int iterations) {
    exhausted_ = system_.operations() - first_operations_ > options_.max_operations;
    return !exhausted_ &&
           solvers::goes_on(options_.observer, {"Newton", iterations, residual_, "relative residual"});
  }

  NewtonResult solve(Eigen::VectorXd& u) {
    u_ = &u;
    first_operations_ = system_.operations();
    const detail::NewtonRun run =
        detail::damped_newton(*this, u, options_.max_iterations, options_.min_step, options_.memory);
    NewtonResult result;
    result.status = is_acceptable() ? SolveStatus::converged
                    : exhausted_    ? SolveStatus::effort_limit
                                    : status_of(run.end);
    result.iterations = run.iterations;
    result.residual = residual_;
    result.residual_history = std::move(history_);
    if (factorized_)
      result.condition = singular_ ? std::numeric_limits<double>::infinity() : system_.condition();
    return result;
  }

 private:
  static SolveStatus status_of(detail::NewtonEnd end) {
    using enum detail::NewtonEnd;
    return end == iteration_limit ? SolveStatus::iteration_limit
           : end == singular      ? SolveStatus::singular
           : end == cancelled     ? SolveStatus::cancelled
                                  : SolveStatus::stalled;
  }

  ContactSystem& system_;
  const NewtonOptions& options_;
  const Eigen::VectorXd* u_ = nullptr;
  double residual_ = std::numeric_limits<double>::infinity();
  std::vector<double> history_;
  double first_operations_ = 0.0;
  bool factorized_ = false, singular_ = false, exhausted_ = false;
};

}  // namespace

NewtonResult newton(ContactSystem& system, Eigen::VectorXd& u, const NewtonOptions& options) {
  options.validate();
  system.set_linear_solver(options.linear_solver);
  return ContactEquation(system, options).solve(u);
}

}  // namespace wavebalance::solvers

#include "balance/jacobian_solver.hpp"

#include <cmath>

namespace wavebalance::solvers {
namespace {

// Beyond this many active samples of one contact GMRES is faster than LU.
constexpr Eigen::Index crossover = 144;

// With several contacts the preconditioner holds few harmonics of each, so LU is used up to more samples.
constexpr Eigen::Index crossover_of_several = 256;

// Failures of GMRES in a row after which LU is used from then on.
constexpr int most_failures = 3;

// The largest LU, also as a fallback of GMRES.
constexpr Eigen::Index largest_dense = 4096;

ComplianceOperator compliance_of(CondensedProblem& problem) {
  return {problem.contacts(), problem.points(),
          [&problem](const Eigen::VectorXd& f, Eigen::VectorXd& u) { problem.apply(f, u); },
          [&problem](const Eigen::VectorXd& v, Eigen::VectorXd& u) { problem.apply_transposed(v, u); },
          [&problem](int n) { return problem.harmonic_response(n); }};
}

}  // namespace

void JacobianSolver::choose(const CondensedProblem& problem, const PeriodSlopes& slopes) {
  active_.set(slopes, rates_, problem.frequency());
  // In the force form K does not decay over harmonics, and nor does what the preconditioner leaves out.
  const bool decays = problem.regularization().size() == 0;
  const Eigen::Index limit = !decays                   ? largest_dense
                             : problem.contacts() == 1 ? crossover
                                                       : crossover_of_several;
  const bool large = active_.count() > limit;
  const bool given_up = krylov_failures_ >= most_failures && active_.count() <= largest_dense;
  const bool krylov =
      method_ == LinearSolver::krylov || (method_ == LinearSolver::automatic && large && !given_up);
  used_ = krylov ? Used::krylov : Used::dense;
  if (!krylov) count_dense();
}

bool JacobianSolver::may_fall_back() const {
  return method_ == LinearSolver::automatic && active_.count() <= largest_dense;
}

void JacobianSolver::count_dense() {
  const auto active = static_cast<double>(active_.count());
  operations_ += 2.0 / 3.0 * active * active * active;
}

void JacobianSolver::count_krylov(const CondensedProblem& problem, int iterations) {
  const double points = problem.points();
  const double contacts = problem.contacts(), coarse = double(krylov_.size());
  operations_ += 2.0 / 3.0 * coarse * coarse * coarse + 4.0 * contacts * coarse * coarse;
  operations_ += (10.0 * points * std::log2(points + 1.0) * contacts) * iterations;
}

bool JacobianSolver::factorize(CondensedProblem& problem, const PeriodSlopes& slopes) {
  choose(problem, slopes);
  if (used_ == Used::dense) return dense_.factorize(problem, active_);
  return krylov_.factorize(compliance_of(problem), active_, slopes, problem.frequency());
}

bool JacobianSolver::solve(CondensedProblem& problem, const Eigen::VectorXd& r, double reduction,
                           Eigen::VectorXd& x) {
  if (used_ == Used::krylov) {
    const KrylovBlock::Outcome outcome = krylov_.solve(compliance_of(problem), r, reduction, x);
    count_krylov(problem, outcome.iterations);
    krylov_failures_ = outcome.solved ? 0 : krylov_failures_ + 1;
    if (outcome.solved) return true;
    count_dense();
    if (!may_fall_back() || !dense_.factorize(problem, active_)) return false;
    used_ = Used::dense;
  }
  dense_.solve(problem, r, x);
  return true;
}

bool JacobianSolver::factorize_bordered(CondensedProblem& problem, const PeriodSlopes& slopes,
                                        const Eigen::VectorXd& b, const Eigen::VectorXd& c, double d) {
  choose(problem, slopes);
  if (used_ == Used::dense) return dense_.factorize_bordered(problem, active_, b, c, d);
  border_column_ = b;
  border_row_ = c;
  border_corner_ = d;
  return krylov_.factorize_bordered(compliance_of(problem), active_, slopes, problem.frequency(), b, c, d);
}

bool JacobianSolver::solve_bordered(CondensedProblem& problem, const Eigen::VectorXd& r, double s,
                                    double reduction, Eigen::VectorXd& x, double& y) {
  if (used_ == Used::krylov) {
    const KrylovBlock::Outcome outcome =
        krylov_.solve_bordered(compliance_of(problem), r, s, reduction, x, y);
    count_krylov(problem, outcome.iterations);
    krylov_failures_ = outcome.solved ? 0 : krylov_failures_ + 1;
    if (outcome.solved) return true;
    count_dense();
    if (!may_fall_back() ||
        !dense_.factorize_bordered(problem, active_, border_column_, border_row_, border_corner_))
      return false;
    used_ = Used::dense;
  }
  dense_.solve_bordered(problem, r, s, x, y);
  return true;
}

double JacobianSolver::condition(CondensedProblem& problem) {
  if (used_ == Used::none) return 0.0;
  return used_ == Used::dense ? dense_.condition() : krylov_.condition(compliance_of(problem));
}

}  // namespace wavebalance::solvers

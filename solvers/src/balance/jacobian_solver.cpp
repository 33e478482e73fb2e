#include "balance/jacobian_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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

// Up to this many coefficients an LU of them bounds the time of laws with memory, where GMRES may need many
// iterations or fail.
constexpr Eigen::Index few_functions = 1000;

Eigen::Index most_samples(const ContactOperator& contact) {
  // In the force form K does not decay over harmonics, and nor does what the preconditioner leaves out.
  if (contact.is_force_form()) return largest_dense;
  return contact.problem().contacts() == 1 ? crossover : crossover_of_several;
}

}  // namespace

bool JacobianSolver::takes_functions(const ContactOperator& contact) const {
  if (!remembers_ || contact.is_force_form() || method_ != LinearSolver::automatic) return false;
  return active_.count() > std::max(most_samples(contact), FunctionReduction::size(contact.problem()));
}

Eigen::Index JacobianSolver::dense_size(const ContactOperator& contact) const {
  return takes_functions(contact) ? FunctionReduction::size(contact.problem()) : active_.count();
}

Reduction& JacobianSolver::reduce(ContactOperator& contact) {
  count_dense(contact);
  if (takes_functions(contact)) {
    functions_.set(contact, active_);
    return functions_;
  }
  samples_.set(contact, active_);
  return samples_;
}

void JacobianSolver::choose(const ContactOperator& contact, const PeriodSlopes& slopes) {
  active_.set(slopes, rates_, contact.problem().frequency());
  remembers_ = !slopes.others.empty();
  const bool large = active_.count() > most_samples(contact);
  const bool given_up = krylov_failures_ >= most_failures && dense_size(contact) <= largest_dense;
  const bool few = takes_functions(contact) && dense_size(contact) <= few_functions;
  const bool krylov =
      method_ == LinearSolver::krylov || (method_ == LinearSolver::automatic && large && !given_up && !few);
  used_ = krylov ? Used::krylov : Used::dense;
}

bool JacobianSolver::may_fall_back(const ContactOperator& contact) const {
  return method_ == LinearSolver::automatic && dense_size(contact) <= largest_dense;
}

void JacobianSolver::count_dense(const ContactOperator& contact) {
  const auto size = static_cast<double>(dense_size(contact));
  operations_ += 2.0 / 3.0 * size * size * size;
}

void JacobianSolver::count_krylov(const ContactOperator& contact, int iterations) {
  const double points = contact.problem().points();
  const double contacts = contact.problem().contacts(), coarse = double(krylov_.size());
  const int made = krylov_.renewals() - counted_renewals_;
  counted_renewals_ = krylov_.renewals();
  operations_ += made * (2.0 / 3.0 * coarse * coarse * coarse + 4.0 * contacts * coarse * coarse);
  operations_ += (10.0 * points * std::log2(points + 1.0) * contacts) * iterations;
}

bool JacobianSolver::factorize(ContactOperator& contact, const PeriodSlopes& slopes, Border border) {
  choose(contact, slopes);
  if (used_ == Used::dense) return dense_.factorize(reduce(contact), std::move(border));
  return krylov_.factorize(contact, active_, slopes, std::move(border));
}

bool JacobianSolver::solve(ContactOperator& contact, const Eigen::VectorXd& r, double s, double reduction,
                           Eigen::VectorXd& x, double& y) {
  if (used_ == Used::krylov) {
    const KrylovBlock::Outcome outcome = krylov_.solve(contact, r, s, reduction, x, y);
    count_krylov(contact, outcome.iterations);
    krylov_failures_ = outcome.solved ? 0 : krylov_failures_ + 1;
    if (outcome.solved) return true;
    if (!may_fall_back(contact) || !dense_.factorize(reduce(contact), krylov_.border())) return false;
    used_ = Used::dense;
  }
  dense_.solve(r, s, x, y);
  return true;
}

double JacobianSolver::condition(ContactOperator& contact) {
  if (used_ == Used::none) return 0.0;
  return used_ == Used::dense ? dense_.condition() : krylov_.condition(contact);
}

}  // namespace wavebalance::solvers

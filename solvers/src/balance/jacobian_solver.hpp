#pragma once
#include <Eigen/Core>

#include "balance/dense_block.hpp"
#include "balance/function_reduction.hpp"
#include "balance/krylov_block.hpp"
#include "balance/sample_reduction.hpp"
#include "wavebalance/solvers/balance/contact_system.hpp"

namespace wavebalance::solvers {

/// Solves with J = I + K D, D the slopes of the contact forces, plain or bordered, by LU of the active
/// samples or by GMRES, chosen by their number. Where GMRES does not converge and an LU is affordable, the
/// LU is used, and after three times in a row from then on. For laws with memory in the displacement form
/// the unknowns are the coefficients of the functions if these are fewer. A few coefficients are preferred
/// to GMRES, whose preconditioner ignores memory.
class JacobianSolver {
 public:
  /// `rates` gives the velocities of motions and is kept; null where no law reads them.
  explicit JacobianSolver(RateMap* rates) : rates_(rates) {}

  void set_method(LinearSolver method) { method_ = method; }

  /// False when singular to working precision.
  bool factorize(ContactOperator& contact, const PeriodSlopes& slopes, Border border = {});
  /// Solves J x + b y = r, c.x + d y = s, or J x = r with y = 0, to `reduction` of r on the active samples,
  /// by LU exactly. False when that was not reached.
  bool solve(ContactOperator& contact, const Eigen::VectorXd& r, double s, double reduction,
             Eigen::VectorXd& x, double& y);

  /// 1 or -1: the sign of the determinant of the matrix last factorized; 0 when there is no LU of it.
  int determinant_sign() {
    return used_ == Used::dense ? dense_.determinant_sign() : krylov_.determinant_sign();
  }

  /// Floating-point operations so far: 2/3 size^3 per LU, four transforms per iteration of GMRES.
  double operations() const { return operations_; }

  /// Condition of the matrix last factorized, as in NewtonResult; 0 before any.
  double condition(ContactOperator& contact);

 private:
  enum class Used { none, dense, krylov };
  void choose(const ContactOperator& contact, const PeriodSlopes& slopes);
  bool takes_functions(const ContactOperator& contact) const;
  Reduction& reduce(ContactOperator& contact);
  bool may_fall_back(const ContactOperator& contact) const;
  Eigen::Index dense_size(const ContactOperator& contact) const;
  void count_dense(const ContactOperator& contact);
  void count_krylov(const ContactOperator& contact, int iterations);

  LinearSolver method_ = LinearSolver::automatic;
  Used used_ = Used::none;
  RateMap* rates_;
  ActiveSlopes active_;
  bool remembers_ = false;  // whether forces depend on other samples than their own
  int krylov_failures_ = 0;
  int counted_renewals_ = 0;  // of the preconditioner, in operations_
  double operations_ = 0.0;
  SampleReduction samples_;
  FunctionReduction functions_;
  DenseBlock dense_;
  KrylovBlock krylov_;
};

}  // namespace wavebalance::solvers

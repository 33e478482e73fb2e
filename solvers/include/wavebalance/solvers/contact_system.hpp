#pragma once
#include <Eigen/Core>
#include <Eigen/LU>
#include <vector>

#include "wavebalance/solvers/condensed_problem.hpp"
#include "wavebalance/solvers/contact_law.hpp"

namespace wavebalance::solvers {

/// The nonlinear system of a CondensedProblem and a contact law at one state u (N displacement samples, m):
///   R(u) = u - u0 + K s f_c(u),   J = I + K D,   D = diag(s f_c'(u)),
/// s a factor on the law (homotopy in contact stiffness; 1 otherwise). A linear solve with J reduces exactly
/// to the active samples, those where D is not zero: x = r - K D x, an LU of their number and one product
/// with K.
class ContactSystem {
 public:
  ContactSystem(CondensedProblem& problem, AnyContactLaw law);

  CondensedProblem& problem() { return *problem_; }
  const AnyContactLaw& law() const { return law_; }
  void set_stiffness_factor(double factor) { factor_ = factor; }

  /// Computes force, tangent and residual at `displacement`. Returns relative_residual(). O(N log N).
  double evaluate(const Eigen::VectorXd& displacement);

  const Eigen::VectorXd& force() const { return force_; }        ///< s f_c(u), N
  const Eigen::VectorXd& tangent() const { return tangent_; }    ///< D, N/m
  const Eigen::VectorXd& residual() const { return residual_; }  ///< R, m
  /// ||R|| / (||u0|| + ||K f||); infinity when not finite.
  double relative_residual() const { return relative_residual_; }

  /// Overrides the tangent of a sample: the side of the kink from which J is taken there.
  void set_tangent(int sample, double value) { tangent_[sample] = factor_ * value; }

  /// Factorizes J restricted to the active samples. False when singular to working precision. O(active^3).
  bool factorize();
  /// x = J^-1 r.
  void solve(const Eigen::VectorXd& r, Eigen::VectorXd& x);

  /// Factorizes the bordered matrix [J b; c^T d], which stays regular where the curve turns. False when
  /// singular.
  bool factorize_bordered(const Eigen::VectorXd& b, const Eigen::VectorXd& c, double d);
  /// Solves J x + b y = r, c.x + d y = s.
  void solve_bordered(const Eigen::VectorXd& r, double s, Eigen::VectorXd& x, double& y);

 private:
  void collect_active();
  void fill_active_matrix(Eigen::MatrixXd& matrix);
  void complete(const Eigen::VectorXd& r, const Eigen::VectorXd& active_values, Eigen::VectorXd& x);

  CondensedProblem* problem_;
  AnyContactLaw law_;
  double factor_ = 1.0;
  double relative_residual_ = 0.0;
  Eigen::VectorXd force_, tangent_, residual_, product_;
  std::vector<int> active_;
  Eigen::MatrixXd matrix_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
  Eigen::VectorXd border_column_, border_row_;  // b and c of the last bordered factorization
  double border_corner_ = 0.0;
};

}  // namespace wavebalance::solvers

#pragma once
#include <functional>

#include "linalg/dense.hpp"
#include "wavebalance/solvers/balance/contact_operator.hpp"

namespace wavebalance::solvers {

/// The position of a structure that is free to move, in the Newton matrix: J = A - U V^T with A = I + K D,
/// the responses U of CondensedProblem::hold_response() and V^T x the position that a change x of the unknown
/// and D x of its force make. Systems with J, bordered or not, follow from those with A by Woodbury's
/// identity [Golub & Van Loan, section 2.1.4].
class RigidPosition {
 public:
  /// x and y of A x + b y = r, c.x + d y = 0, or of A x = r with y = 0. False when not solved.
  using Solve = std::function<bool(const Eigen::VectorXd& r, Eigen::VectorXd& x, double& y)>;

  /// False when J is singular, as it is where nothing resists the motion. One solve per rigid motion.
  bool factorize(ContactOperator& contact, const Eigen::VectorXd& tangent, const Solve& solve);
  /// Turns the solution of the system with A into that with J.
  void correct(const ContactOperator& contact, const Eigen::VectorXd& tangent, Eigen::VectorXd& x,
               double& y) const;
  /// The sign of det J / det A, 1 or -1.
  int sign() const { return capacitance_.determinant_sign(); }

 private:
  Eigen::MatrixXd responses_;  // A^-1 U, samples x q
  Eigen::VectorXd borders_;    // their y
  detail::Lu<double> capacitance_;
};

}  // namespace wavebalance::solvers

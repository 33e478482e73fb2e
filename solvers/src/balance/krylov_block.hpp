#pragma once
#include <Eigen/Core>
#include <vector>

#include "balance/harmonic_coarse_space.hpp"
#include "linalg/dense.hpp"
#include "linalg/gmres.hpp"

namespace wavebalance::solvers {

/// Solves with J = I + K D, D diagonal, plain or bordered [J b; c^T d], without the matrix over the active
/// samples (those where D is not zero): GMRES with FFT products.
///
/// K decays over harmonics and over the directions of the contacts at each, so that J is the identity plus a
/// part of few of them, U V D. The preconditioner
///   P = I + U V D   (bordered: with b, c, d as J)
/// leaves out the rest of K; its inverse costs two FFTs per contact and a dense solve of the size s of the
/// coarse space. J P^-1 = I + (K - U V) D P^-1 is then the identity plus what is small and compact, and the
/// number of iterations does not grow with the number of samples or contacts.
/// An iteration costs two products with K, factorize() O(C N log N + C^2 M + C s^2 + s^3).
class KrylovBlock {
 public:
  /// Iterations and residual of the last solve.
  struct Outcome {
    bool solved = false;
    int iterations = 0;      ///< products of GMRES
    double reduction = 0.0;  ///< ||r - J x|| over ||r|| on the active samples
  };

  /// Makes the preconditioner for the diagonal `tangent` of D. False when it is singular to working precision
  /// or D is not finite.
  bool factorize(const ComplianceOperator& compliance, const Eigen::VectorXd& tangent);
  /// x = J^-1 r until the residual on the active samples is at most `reduction` of r; it vanishes on the
  /// others.
  Outcome solve(const ComplianceOperator& compliance, const Eigen::VectorXd& r, double reduction,
                Eigen::VectorXd& x);

  bool factorize_bordered(const ComplianceOperator& compliance, const Eigen::VectorXd& tangent,
                          const Eigen::VectorXd& b, const Eigen::VectorXd& c, double d);
  /// J x + b y = r, c.x + d y = s to `reduction` of r - b y or of x, whichever is larger on the active
  /// samples; the last equation holds for x = r - K D x - b y to rounding.
  Outcome solve_bordered(const ComplianceOperator& compliance, const Eigen::VectorXd& r, double s,
                         double reduction, Eigen::VectorXd& x, double& y);

  /// 1 or -1: the sign of det P. That of det J is the same where K - U V is small.
  int determinant_sign() const { return lu_.determinant_sign(); }
  /// Lower bound of the condition number, in the 2-norm, of J on the active samples: the largest over the
  /// smallest ||J z|| / ||z|| of all z multiplied since the last factorisation, and of a few power iterations
  /// with J and P^-1. Three further products.
  double condition(const ComplianceOperator& compliance);

  /// Unknowns of the preconditioner.
  Eigen::Index size() const { return coarse_.size(); }

 private:
  /// Active values z and, when bordered, y.
  struct Unknown {
    Eigen::VectorXd z;
    double y = 0.0;
  };

  bool prepare(const ComplianceOperator& compliance, const Eigen::VectorXd& tangent);
  bool factorize_coarse();
  void precondition(const Eigen::VectorXd& v, double s, Unknown& unknown);
  void multiply(const ComplianceOperator& compliance, const Unknown& unknown, Eigen::VectorXd& product);
  Outcome solve_active(const ComplianceOperator& compliance, const Eigen::VectorXd& r, double s,
                       double reduction, Unknown& unknown);
  double size_of_terms(double right, const Eigen::VectorXd& z) const;
  void complete(const ComplianceOperator& compliance, const Eigen::VectorXd& r, double reduction,
                const Eigen::VectorXd& z, Eigen::VectorXd& x, Outcome& outcome);
  Eigen::VectorXd gather(const Eigen::VectorXd& samples) const;
  void scatter_weighted(const Eigen::VectorXd& active);

  std::vector<int> active_;
  Eigen::VectorXd stiffness_;  // D at the active samples
  HarmonicCoarseSpace coarse_;
  Eigen::MatrixXd matrix_;
  detail::Lu<double> lu_;
  Eigen::VectorXd weighted_, samples_, coefficients_;  // work
  double largest_gain_ = 0.0, smallest_gain_ = 0.0;    // extremes of ||J z|| / ||z||
  bool bordered_ = false;
  Eigen::VectorXd column_, row_;   // b and c over all samples
  Eigen::VectorXd active_column_;  // b at the active samples
  Eigen::VectorXd active_row_;     // c^T (x - r) of the active values: -D K^T c
  double corner_ = 0.0;            // d - c.b
};

}  // namespace wavebalance::solvers

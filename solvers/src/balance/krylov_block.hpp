#pragma once
#include <Eigen/Core>
#include <vector>

#include "balance/active_slopes.hpp"
#include "balance/harmonic_coarse_space.hpp"
#include "balance/reduction.hpp"
#include "linalg/dense.hpp"
#include "linalg/gmres.hpp"

namespace wavebalance::solvers {

/// Solves with J = I + K D, D = S B (ActiveSlopes), plain or bordered [J b; c^T d], without the matrix over
/// the active samples: GMRES with FFT products for the z of x = r - K S z, (I + B K S) z = B r.
///
/// K decays over harmonics and over the directions of the contacts at each, so that J is the identity plus a
/// part of few of them, U V D. The preconditioner
///   P = I + B U V S   (bordered: with b, c, d as J)
/// leaves out the rest of K; its inverse costs two FFTs per contact and a dense solve with I + V D U of the
/// size s of the coarse space. The rest is then small and compact, and the number of iterations does not
/// grow with the number of samples or contacts. I + V D U ignores the entries of D between different
/// samples. An iteration costs two products with K, a new preconditioner O(C N log N + C^2 M + C s^2 +
/// s^3). The preconditioner of a previous state is kept as long as its additional iterations cost less than
/// a new one, which is never the case for one contact. GMRES always solves with the present J.
class KrylovBlock {
 public:
  struct Outcome {
    bool solved = false;
    int iterations = 0;  ///< products of GMRES
  };

  /// Makes the preconditioner for D = `slopes`, of which `active` was set, at the frequency of the problem,
  /// or keeps the last one. `contact`, `active` and `slopes` must outlive the solves as they are. False when
  /// it is singular to working precision or D is not finite.
  bool factorize(ContactOperator& contact, ActiveSlopes& active, const PeriodSlopes& slopes, Border border);
  const Border& border() const { return border_; }
  /// x = J^-1 r and y = 0 until the residual on the active samples is at most `reduction` of r; it vanishes
  /// on the others. With a border J x + b y = r, c.x + d y = s to `reduction` of r - b y or of x, whichever
  /// is larger on the active samples; the last equation holds for x = r - K S z - b y to rounding.
  Outcome solve(ContactOperator& contact, const Eigen::VectorXd& r, double s, double reduction,
                Eigen::VectorXd& x, double& y);

  /// 1 or -1: the sign of det P, which is made anew where it was kept. det J has the same sign if K - U V
  /// is small.
  int determinant_sign();
  /// Lower bound of the condition number, in the 2-norm, of J on the active samples: the largest over the
  /// smallest ||J z|| / ||z|| of all z multiplied since the last factorisation, and of a few power iterations
  /// with J and P^-1. Three further products.
  double condition(ContactOperator& contact);

  /// Unknowns of the preconditioner, and how often it was made.
  Eigen::Index size() const { return coarse_.size(); }
  int renewals() const { return renewals_; }

 private:
  /// Active values z and, when bordered, y.
  struct Unknown {
    Eigen::VectorXd z;
    double y = 0.0;
  };

  double iterations_of_renewal(const ContactOperator& contact) const;
  bool may_be_kept(const ContactOperator& contact) const;
  bool renew();
  bool keep();
  void set_coarse(ContactOperator& contact, const PeriodSlopes& slopes);
  void read_border();
  Eigen::VectorXd border_row();
  Eigen::VectorXd solve_coarse(const Eigen::VectorXd& right) const;
  void precondition(const Eigen::VectorXd& v, double s, Unknown& unknown);
  void multiply(ContactOperator& contact, const Unknown& unknown, Eigen::VectorXd& product);
  Outcome solve_active(ContactOperator& contact, const Eigen::VectorXd& r, double s, double reduction,
                       Unknown& unknown);
  double size_of_terms(double right, const Eigen::VectorXd& z) const;
  void complete(ContactOperator& contact, const Eigen::VectorXd& r, double reduction,
                const Eigen::VectorXd& z, Eigen::VectorXd& x, Outcome& outcome);

  ContactOperator* contact_ = nullptr;
  ActiveSlopes* active_ = nullptr;
  const PeriodSlopes* slopes_ = nullptr;
  HarmonicCoarseSpace coarse_;
  double coarse_frequency_ = 0.0;  // Hz, at which the coarse space was set
  CoarseSize coarse_wanted_;
  Eigen::MatrixXd matrix_;
  detail::Lu<double> lu_;
  bool made_ = false, made_with_border_ = false, kept_ = false;  // kept_: made for a state before
  int renewals_ = 0, iterations_ = 0, least_iterations_ = 0;     // of the last solve, and least with this LU
  Eigen::VectorXd row_change_, row_influence_;                   // of the last row since, with a border
  double row_pivot_ = 1.0, made_slopes_ = 0.0;                   // the latter: the norm of S then
  Eigen::VectorXd weighted_, samples_, coefficients_;            // work
  double largest_gain_ = 0.0, smallest_gain_ = 0.0;              // extremes of ||J z|| / ||z||
  Border border_;                                                // over all samples
  Eigen::VectorXd active_column_;                                // B b
  Eigen::VectorXd active_row_;                                   // c^T (x - r) of the active values: -S K^T c
};

}  // namespace wavebalance::solvers

#pragma once
#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/balance/contact_operator.hpp"

namespace wavebalance::solvers {

class JacobianSolver;
class RateMap;
class RigidPosition;
struct Border;

/// The piece of its law that each sample lies on: the number of kinks below its displacement. With one kink,
/// at the gap, 1 in contact and 0 outside.
using LawSegments = Eigen::ArrayXi;

/// A displacement at which the slope of a law jumps.
struct LawKink {
  double at = 0.0;      ///< m
  double force = 0.0;   ///< N, at rest
  double below = 0.0;   ///< N/m, slope on the lower side, at rest
  double beyond = 0.0;  ///< N/m, slope on the upper side, at rest
};

/// How systems with the Newton matrix J are solved.
enum class LinearSolver {
  automatic,  ///< LU for few active samples, GMRES for many
  dense,      ///< LU of the active samples, O(active^3)
  krylov  ///< GMRES with FFT products and J on its low harmonics as preconditioner, O(N log N) per iteration
};

/// The nonlinear system of a CondensedProblem and its contact laws at one state u (samples() displacements,
/// m, contact-major):
///   R(u) = u - u0 + K f_c(u),   J = I + K D,   D = df_c/du.
/// D has one block per sample for laws of one instant, and few entries per row for laws over a period. A
/// velocity f V u of the motion u is read by D_u + D_v f V. A linear solve with J reduces exactly to the
/// active samples, those whose force changes with u: x = r - K D x, an LU of their number and one product
/// with K. Many active samples are solved for by GMRES, which forms no matrix over them. In the force form
/// (ContactOperator) u denotes its unknown v, and the laws are their resolvents. Laws that depend on the
/// frequency are evaluated at the frequency of the problem.
class ContactSystem {
 public:
  /// Throws std::invalid_argument when there are neither one law nor one for each contact, for a law that
  /// depends on the velocity where the trial functions have no pointwise derivative, and for one that depends
  /// on the velocity or acts over a period in the force form, and as ContactOperator does for the
  /// `series_flexibility` of its form. Keeps a reference to the problem.
  ContactSystem(CondensedProblem& problem, ContactLaws laws, Eigen::VectorXd series_flexibility = {});
  ContactSystem(ContactSystem&&) noexcept;
  ContactSystem& operator=(ContactSystem&&) noexcept;
  ~ContactSystem();

  CondensedProblem& problem() { return operator_.problem(); }
  /// ContactOperator::series_flexibility() of its form.
  const Eigen::VectorXd& series_flexibility() const { return operator_.series_flexibility(); }
  /// The laws of its form, at the frequency of the last evaluation.
  const ContactLaws& laws() const { return laws_; }
  /// The kinks of the law of the contact that a sample belongs to, ascending.
  std::span<const LawKink> kinks_at(int sample) const {
    return kinks_[static_cast<std::size_t>(sample / operator_.problem().points())];
  }
  /// The piece of that law at a displacement, m; at a kink the lower one.
  int piece_at(int sample, double displacement) const;
  /// The piece in which a contact is open or, of a law that acts everywhere, at rest.
  int rest_piece(int sample) const {
    return rest_pieces_[static_cast<std::size_t>(sample / operator_.problem().points())];
  }

  /// Computes force, its slopes and residual at `displacement`. Returns relative_residual(). One product with
  /// K.
  double evaluate(const Eigen::VectorXd& displacement);
  /// The same with every sample kept on one segment of its law, samples() values, which is continued beyond
  /// its kinks by the tangents there. Equal to evaluate() if the segments belong to `displacement`, and
  /// smooth across the kinks.
  double evaluate(const Eigen::VectorXd& displacement, const LawSegments& pieces);

  const Eigen::VectorXd& force() const { return forces_.force; }  ///< f_c(u), N
  /// CondensedProblem::force_on_held_structure() of the state: force() where the structure is held.
  Eigen::VectorXd force_on_held_structure() const;
  /// ContactOperator::unknown_coefficients() of the state.
  Eigen::MatrixXcd unknown_coefficients() {
    return operator_.unknown_coefficients(force(), force_on_held_structure());
  }
  /// The slopes of each force by the displacement of the same sample, N/m: D of laws of the displacement
  /// only.
  const Eigen::VectorXd& tangent() const { return forces_.slopes.displacement; }
  /// D.
  const PeriodSlopes& slopes() const { return forces_.slopes; }
  /// The pieces of laws over a period, as ContactForces has them.
  const Eigen::ArrayXi& period_pieces() const { return forces_.pieces; }
  const Eigen::VectorXd& residual() const { return residual_; }  ///< R, m
  /// ||R|| / (||u0|| + ||K f||), 1 where only R is not zero; infinity when not finite.
  double relative_residual() const { return relative_residual_; }

  /// Adds a motion to the linear response in the residual, m, samples() values; empty for none. A curve
  /// of states leads from an approximate motion, which solves the system with its residual added, to a
  /// solution.
  void set_added_motion(Eigen::VectorXd motion) { added_motion_ = std::move(motion); }

  /// Scales the contact forces and their slopes at each evaluation, to follow a solution from soft to stiff
  /// contacts in the displacement form; 1 at first.
  void set_force_share(double share) { force_share_ = share; }

  /// Adds to `slope` the derivative by frequency (m/Hz) that a residual at fixed samples has through the
  /// velocities. It is zero where no law depends on them.
  void add_velocity_slope(Eigen::VectorXd& slope);
  /// The same through laws that follow the frequency, by a difference at the displacements of the last
  /// evaluate().
  void add_law_slope(Eigen::VectorXd& slope);

  /// Overrides the tangent of a sample.
  void set_tangent(int sample, double value) { forces_.slopes.displacement[sample] = value; }
  /// Takes J at a sample that lies at a kink of its law from one side of it.
  void take_side(int sample, int kink, bool beyond);

  /// Chooses the solver of factorize() and solve() and of their bordered forms; automatic is the default.
  void set_linear_solver(LinearSolver method);

  /// Factorizes J restricted to the active samples, or its preconditioner. False when singular to working
  /// precision. O(active^3), or O(N log N) for many.
  bool factorize();
  /// x = J^-1 r, with GMRES until the residual is at most `reduction` of r on the active samples. False when
  /// that was not reached: J is singular or nearly so.
  bool solve(const Eigen::VectorXd& r, Eigen::VectorXd& x, double reduction = 1e-10);

  /// Factorizes the bordered matrix [J b; c^T d], which is regular at folds of a curve, too. False when
  /// singular.
  bool factorize_bordered(const Eigen::VectorXd& b, const Eigen::VectorXd& c, double d);
  /// Solves J x + b y = r, c.x + d y = s.
  bool solve_bordered(const Eigen::VectorXd& r, double s, Eigen::VectorXd& x, double& y,
                      double reduction = 1e-10);
  /// 1 or -1: the sign of the determinant of the matrix last factorized; 0 when GMRES was used instead of
  /// LU.
  int determinant_sign() const;

  /// Condition of the matrix last factorized, as in NewtonResult; 0 before any.
  double condition();

  /// Floating-point operations that linear systems have taken so far.
  double operations() const;

 private:
  double evaluate_residual(const Eigen::VectorXd& displacement);
  void evaluate_laws(const Eigen::VectorXd& displacement);
  void scale_forces();
  void take_laws();
  void follow_frequency();
  void take_side(int sample, const ForceSlopes& side);
  ForceSlopes side_of(int sample, const LawKink& kink, bool beyond) const;
  void continue_piece(int sample, double displacement, const LawKink& kink, bool beyond);
  bool factorize(const Border& border);

  ContactOperator operator_;
  ContactLaws given_, laws_;                 // of any frequency, and in the form at laws_at_
  double laws_at_ = 0.0;                     // Hz of the load
  std::vector<std::vector<LawKink>> kinks_;  // of each contact
  std::vector<int> rest_pieces_;
  Eigen::VectorXd added_motion_;
  double force_share_ = 1.0;
  double relative_residual_ = 0.0;
  double column_scale_ = 1.0, row_scale_ = 1.0;  // of the border last factorized
  double products_ = 0.0;                        // operations of products with K
  ContactForces forces_;
  Eigen::VectorXd velocity_;   // m/s; empty where no law reads it
  Eigen::VectorXd evaluated_;  // m, of the last evaluation; empty where laws do not follow the frequency
  Eigen::VectorXd residual_, product_;
  Eigen::VectorXd state_;                    // of a free structure
  std::unique_ptr<RigidPosition> position_;  // of a free structure
  std::unique_ptr<RateMap> rates_;           // null where no law depends on the velocity
  std::unique_ptr<JacobianSolver> jacobian_;
};

}  // namespace wavebalance::solvers

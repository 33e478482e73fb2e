#pragma once
#include <Eigen/Core>
#include <complex>
#include <memory>
#include <vector>

#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::solvers {

/// How the modes of a structure are found.
struct ContactDynamicsOptions {
  /// Up to this many degrees of freedom all modes are computed; larger structures are reduced first.
  int max_size = 400;
  /// Vectors of the reduction; 0: 80, and at least 12 for each contact.
  int reduced_size = 0;

  /// Throws std::invalid_argument for a number out of its range.
  void validate() const;
};

/// An exponent lambda of the linear structure, Im lambda >= 0, and its contribution to the compliance of
/// the contacts: residue shape left^T / (s - lambda), and its conjugate where Im lambda > 0.
struct ContactPole {
  std::complex<double> exponent;  ///< 1/s
  std::complex<double> residue;   ///< with the shape: m/(N s)
  Eigen::VectorXcd shape;         ///< C, the mode along the contact directions
  Eigen::VectorXcd left;          ///< C, its left mode along them; shape where M, C and K are symmetric
};

/// The compliance of the contacts, S (s^2 M + s C + K)^-1 S^T, at any complex exponent s, by the modes of the
/// structure, and the exponents of the structure without contact.
///
/// Modes that decouple the damping are used if they exist, otherwise the 2n complex ones. C and K need not
/// be symmetric: the left modes are then rows of the inverse of the matrix of right ones. Structures of
/// more than max_size degrees of freedom are projected on the block Krylov space of K^-1 M from the static
/// deflections K^-1 S^T [R. R. Craig, A. L. Hale, J. Guid. Control Dyn. 11, 1988, doi:10.2514/3.20353].
/// Without symmetry the space of K^-1 M and K^-1 C is used, from K^-1 S^T and K^-T S^T. Statics are then
/// exact. Neglected is the dynamics of modes that the contacts hardly excite or that are above the
/// frequencies which the vectors span; exponents() has the others. reduced() reports it, and a comparison
/// with Condensation::dynamic_compliance() at the highest harmonic measures it.
///
/// Immutable; may be shared between threads.
class ContactDynamics {
 public:
  /// Throws std::invalid_argument as LinearStructure::validate does, for options out of range, and where no
  /// modes are found: neither mass nor stiffness positive definite and, with more than max_size degrees of
  /// freedom or a damping that couples the modes, a stiffness that is not. O(n^3), or for a reduced structure
  /// one factorization of K and O(n reduced_size^2).
  explicit ContactDynamics(const LinearStructure& structure, const ContactDynamicsOptions& options = {});

  /// An undamped structure in its r linear modes: omega_squared (r, 1/s^2, > 0) and the mass-normalised
  /// shapes (C x r, kg^-1/2) along the contact directions. The first `dynamic` modes have poles, in their
  /// order; the others are springs at the contacts, constant(). Throws std::invalid_argument for other sizes
  /// or a value that is not positive. O(r C^2).
  static ContactDynamics undamped(const Eigen::VectorXd& omega_squared, const Eigen::MatrixXd& shapes,
                                  Eigen::Index dynamic);

  /// The same with springs, constant(), instead of the poles beyond a modulus (1/s). Exact in statics; the
  /// error grows with the square of a frequency over that modulus. O(poles C^2).
  ContactDynamics with_springs_beyond(double modulus) const;

  int contacts() const { return static_cast<int>(constant_.rows()); }  ///< C
  /// Whether the structure was reduced, so that exponents() is not complete.
  bool reduced() const { return reduced_; }
  /// kappa, N/m, of springs along all contacts that hold a structure which is free to move, so that no pole
  /// is zero; 0 for others. held_stiffness() removes them.
  double holding() const { return holding_; }
  /// Whether the structure has a loss factor, which is left out here: stability is then unknown.
  bool structurally_damped() const { return structurally_damped_; }
  /// The poles, each conjugate pair once.
  const std::vector<ContactPole>& poles() const { return poles_; }
  /// The limit of the compliance for |s| -> infinity, C x C, m/N: zero unless contacts have neither mass nor
  /// damping.
  const Eigen::MatrixXd& constant() const { return constant_; }

  /// The compliance without constant(), and its derivative by s.
  struct Values {
    Eigen::MatrixXcd compliance;  ///< K x C^2, m/N: entry (c, d) in column c + C d
    Eigen::MatrixXcd slope;       ///< K x C^2, m s/N; empty without with_slope
  };
  /// Both at K exponents s (1/s) of equal real part. O(K n C^2).
  Values compliance(double real, const Eigen::VectorXd& imaginary, bool with_slope = true) const;

  /// A mode or a conjugate pair in the compliance, (linear s + constant) / (a2 s^2 + a1 s + a0).
  struct Section {
    Eigen::Vector3d denominator;  // (a2, a1, a0)
    Eigen::MatrixXd constant;     // C x C
    Eigen::MatrixXd linear;       // C x C; empty where zero
  };

 private:
  ContactDynamics() = default;
  void set_sections(const std::vector<Section>& sections);

  std::vector<ContactPole> poles_;
  Eigen::MatrixXd constant_;
  double holding_ = 0.0;
  bool reduced_ = false, structurally_damped_ = false;
  Eigen::MatrixX3d denominator_;        // one row per section
  Eigen::MatrixXd constant_numerator_;  // sections x C^2
  Eigen::MatrixXd linear_numerator_;    // sections x C^2; empty where all are zero
};

/// The dynamics of a structure along a curve: those given, or of a structure that turns those at each
/// frequency. One object per thread.
class DynamicsAlong {
 public:
  /// Dynamics of a structure that does not turn; must outlive the object.
  DynamicsAlong(const ContactDynamics& dynamics)
      : given_(std::shared_ptr<const ContactDynamics>(), &dynamics) {}

  /// The dynamics at its speed (TurningParts::speed). The last ones are kept, others need O(n^3). Throws as
  /// ContactDynamics does.
  std::shared_ptr<const ContactDynamics> at(const LinearStructure& structure);

 private:
  struct AtSpeed {
    double speed;
    std::shared_ptr<const ContactDynamics> dynamics;
  };
  std::shared_ptr<const ContactDynamics> given_;
  std::vector<AtSpeed> last_;  // latest first
};

}  // namespace wavebalance::solvers

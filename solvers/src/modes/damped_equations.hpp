#pragma once
#include <Eigen/Core>
#include <complex>
#include <vector>

#include "modes/pair_transform.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/continuation/curve_corrector.hpp"
#include "wavebalance/solvers/modes/damped_mode.hpp"

namespace wavebalance::solvers {

/// Data of the equations of a damped mode: the structure in its linear modes with the contacts as at rest,
/// normalised by its stiffness there, X^T (K + S^T D S) X = 1. Immutable.
struct DampedProblem {
  int mode = 0;                    ///< of the columns, from 0: natural frequencies ascend
  Eigen::VectorXd shape_inertia;   ///< r, X^T M X times omega_m^2: 1 of mode m, 0 of one without mass
  Eigen::MatrixXd shape_damping;   ///< r x r, X^T C X omega_m
  Eigen::MatrixXd shape_loss;      ///< r x r, eta X^T K X; empty without structural damping
  Eigen::MatrixXd shapes;          ///< n x r, X
  Eigen::MatrixXd contact_shapes;  ///< C x r, S X
  double omega = 0.0;              ///< rad/s, of the linear mode
  double reach = 0.0;              ///< the largest contact displacement of the mode's shape
  double wave = 0.0;               ///< amplitude of the first harmonic of a unit Re a(1)
  Eigen::VectorXd rest_state;      ///< n, displacements under the static loads
  Eigen::VectorXd rest;            ///< C, m, of the contacts
  Eigen::VectorXd rest_force;      ///< C, N
  Eigen::MatrixXd rest_slope;      ///< C x C, N/m: D
  DampedTransform transform;
  ContactLaws laws;

  int contacts() const { return static_cast<int>(rest.size()); }
  int rows() const { return transform.pair.rows(); }
  int unknowns() const { return contacts() * rows() + 2; }
  int highest() const { return transform.pair.highest(); }
  int points() const { return static_cast<int>(transform.pair.synthesis.rows()); }
  /// xi over omega_m of the linear mode, where damping does not couple it to the others.
  double linear_damping() const;
  /// C, the contacts' displacements of the linear mode at a unit amplitude.
  Eigen::VectorXd linear_shape() const { return contact_shapes.col(mode) / reach; }
};

/// Throws as DampedMode's constructor does.
DampedProblem damped_problem(const LinearStructure& structure, const TimePair& pair, ContactLaws laws,
                             int mode);

/// The balance of M q'' + (C - xi M) q' + K q + S^T f(S q) = static loads, condensed on the contacts, at an
/// amplitude A of mode m:
///
///   u(k) - [k = 1] A h + G(k) psi(k) = 0,   t A + l^T psi(1) = 0,
///
/// psi the coefficients of the force without its value and slope at rest. h, G, t and l follow from the
/// modes but m, whose equation is the last one and whose coefficient is real; all are regular at omega_m.
/// Real and imaginary parts of the last equation determine omega and xi.
///
/// A point of the curve holds the coefficients of the contacts over A, omega / omega_m and xi / omega_m;
/// the parameter is ln A. Lengths are the rms of the samples over A, and the others over the scales of
/// options.
class DampedMotions {
 public:
  struct Pieces {};

  DampedMotions(const DampedProblem& problem, const DampedBackboneOptions& options);

  double evaluate(const CurvePoint& point, const Pieces*);
  const Eigen::VectorXd& residual() const { return residual_; }
  bool solve_bordered(const Eigen::VectorXd& row, double last, const Eigen::VectorXd& right,
                      double last_right, Eigen::VectorXd& change, double& parameter_change) const;
  int determinant_sign() const { return 0; }
  Eigen::VectorXd weighted(const Eigen::VectorXd& change) const { return metric_.cwiseProduct(change); }
  double squared_parameter_scale() const { return 1.0; }
  double tolerance() const { return options_.tolerance; }
  int max_corrections(bool) const { return 20; }
  bool lowers_residual() const { return true; }

  const DampedProblem& problem() const { return problem_; }
  /// Displacements and forces at the samples, N x C, of the state last evaluated.
  const Eigen::MatrixXd& displacement() const { return samples_; }
  Eigen::MatrixXd force() const;

  /// Coefficients of the modes in a motion of the curve, r x (K + 1), relative to rest. O(M r^3).
  Eigen::MatrixXcd modal_coefficients(const DampedPoint& point) const;

  /// The derivatives of the residual by the unknowns, and by the parameter in the last column.
  Eigen::MatrixXd jacobian() const;

 private:
  struct Block {  // of psi's coefficients of one contact by another
    int force, displacement;
    Eigen::MatrixXd slope;
  };
  struct Harmonic {  // G(k), and its derivatives by omega and xi over omega_m
    Eigen::MatrixXcd gain, by_frequency, by_damping;
  };

  struct Stiffness {  // Z(k), with its derivatives by omega and xi over omega_m
    Eigen::MatrixXcd value, by_frequency;
    Eigen::VectorXcd by_damping;  // a diagonal
  };

  Stiffness stiffness_at(int k, double frequency, double damping) const;
  void set_gains(double frequency, double damping);
  void set_first(Stiffness first);
  void set_forces(const Eigen::VectorXd& unknowns);
  std::vector<Block> force_slopes() const;
  std::complex<double> force_coefficient(const Eigen::MatrixXd& coefficients, int contact, int k) const;
  void add_row(Eigen::MatrixXd& matrix, int row, int k, std::complex<double> factor,
               const Block& block) const;

  const DampedProblem& problem_;
  DampedBackboneOptions options_;
  Eigen::VectorXd metric_, unknowns_, residual_;
  double amplitude_ = 0.0;
  std::vector<Harmonic> harmonics_;
  Eigen::MatrixXcd shape_;              // C x 3: h and its derivatives
  Eigen::MatrixXcd last_row_;           // C x 3: l and its derivatives
  Eigen::Vector3cd last_;               // t and its derivatives
  Eigen::MatrixXd samples_, velocity_;  // N x C
  ContactForces forces_;
  Eigen::MatrixXd psi_, psi_by_frequency_;  // R x C, over A
};

}  // namespace wavebalance::solvers

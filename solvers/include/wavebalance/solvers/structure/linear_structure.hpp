#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <vector>

#include "wavebalance/solvers/structure/periodic_force.hpp"

namespace wavebalance::solvers {

/// The directions S of C contacts, C x n, one row each: contact c has the displacement u_c = S_c x, towards
/// its obstacle where positive, and its force f_c acts on the structure as -S_c^T f_c. A row may select a
/// degree of freedom, or hold the relative motion of two bodies or the normal of a surface. Rows S_c and -S_c
/// are obstacles on both sides.
using ContactDirections = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// The S whose row c selects degree of freedom dofs[c] of `size`. O(C + n). Throws std::invalid_argument for
/// one that is out of 0..size-1 or listed twice.
ContactDirections contact_rows(const std::vector<int>& dofs, int size);

/// The largest entry of A - A^T over the largest entry of a square A, 0 for none. O(entries).
double asymmetry(const Eigen::SparseMatrix<double>& matrix);
/// Whether that is at most 1e-12, the rounding of a matrix that was assembled as a symmetric one.
bool is_symmetric(const Eigen::SparseMatrix<double>& matrix);

/// Additions of rotation to damping and stiffness at the speed Omega of the load, 2 pi f with f its
/// frequency: Omega G and Omega^2 K_s. LinearStructure holds damping and stiffness at one speed, at_speed()
/// converts them to another.
struct TurningParts {
  Eigen::SparseMatrix<double> gyroscopic = {};  ///< G, n x n, N s^2/m; empty without
  Eigen::SparseMatrix<double> stiffness = {};   ///< K_s, n x n, symmetric, N s^2/m; empty without
  double speed = 0.0;                           ///< rad/s, speed of the structure's damping and stiffness
};

/// The linear part of a vibrating structure, M x'' + C x' + K x = load cos(2 pi f t) + forces - S^T f(S x),
/// with f the contact forces. SI units or any other consistent set.
struct LinearStructure {
  Eigen::SparseMatrix<double> mass;        ///< n x n, kg
  Eigen::SparseMatrix<double> damping;     ///< n x n, N s/m; its skew part is gyroscopic
  Eigen::SparseMatrix<double> stiffness;   ///< n x n, N/m; its skew part is circulatory
  Eigen::VectorXd load;                    ///< n, N, amplitude of the cosine load
  ContactDirections contact_directions;    ///< S, C x n: at least one row, none of them zero
  std::vector<PeriodicForce> forces = {};  ///< in addition to `load`: static, other harmonics, phases and
                                           ///< places
  /// eta of structural damping: K (1 + i eta) at the positive harmonics of a periodic motion, K at rest.
  double loss_factor = 0.0;
  /// n x r with K R = 0 and R^T M R = 1: the motions along which the structure is free [find_rigid_modes];
  /// empty for one that is held.
  Eigen::MatrixXd rigid_modes = {};
  /// Parts of damping and stiffness that follow the frequency of the load; empty for matrices that stay.
  TurningParts turning = {};

  int size() const { return static_cast<int>(load.size()); }
  int contacts() const { return static_cast<int>(contact_directions.rows()); }
  /// Whether mass, damping and stiffness are symmetric, at any speed. O(entries).
  bool symmetric() const;
  /// Whether damping or stiffness follows the frequency of the load.
  bool turns() const { return turning.gyroscopic.size() > 0 || turning.stiffness.size() > 0; }
  /// The structure with its damping and stiffness at a speed, rad/s; itself where it does not turn.
  LinearStructure at_speed(double speed) const;
  /// The shapes of load and forces, n x (1 + number of forces), `load` first.
  Eigen::MatrixXd load_shapes() const;
  int load_count() const { return 1 + static_cast<int>(forces.size()); }
  /// Multiplies each shape by transformation^T, as for x = transformation y. Other members do not change.
  void transform_loads(const Eigen::MatrixXd& transformation);
  /// The series of load and forces by harmonics of their period, of which the period of `harmonics`, the
  /// series of the load, has `repeats` at a frequency (Hz), with all but the static one times `factor`: a
  /// row for each column of load_shapes(), a column for each harmonic, N.
  Eigen::MatrixXcd load_series(const Eigen::VectorXcd& harmonics, int repeats, double frequency,
                               double factor = 1.0) const;
  /// The degree of freedom that row `contact` selects with the coefficient 1, or -1 for any other direction.
  /// O(entries of the row).
  int selected_dof(int contact) const;
  /// Whether it has rigid_modes.
  bool is_free() const { return rigid_modes.cols() > 0; }
  /// Throws std::invalid_argument for a loss factor that is negative or not finite, and naming the member
  /// whose size does not fit, with both sizes, or the direction that is zero or not finite.
  void validate() const;
};

}  // namespace wavebalance::solvers

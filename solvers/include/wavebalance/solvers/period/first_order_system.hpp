#pragma once
#include <Eigen/Core>
#include <span>
#include <vector>

#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::solvers {

/// The equation of motion M u'' + C u' + K u = load cos(2 pi f t) + forces - S^T f(S u, S u') [JL14, eq. (7)]
/// as 2n first-order equations dy/ds = F(s, y) in the number of periods s = f t. The state holds y = (2 pi f
/// u, u'), both in m/s, so that one absolute tolerance suits displacements and velocities alike.
///
/// Dense: O(n^2) memory, O(n^3) construction; immutable afterwards and safe to share between threads.
class FirstOrderSystem {
 public:
  /// Throws std::invalid_argument when the structure's sizes or the number of laws do not fit, when
  /// frequency_hz (Hz) is not positive and finite, or when the mass matrix is not positive definite.
  FirstOrderSystem(const LinearStructure& structure, ContactLaws laws, double frequency_hz);

  int dofs() const { return static_cast<int>(load_.size()); }                  ///< n
  int states() const { return 2 * dofs(); }                                    ///< 2n
  const ContactDirections& contact_directions() const { return directions_; }  ///< S, C x n
  double angular_frequency() const { return angular_frequency_; }              ///< 2 pi f, rad/s

  /// F(s, y): state and derivative hold 2n values each, m/s. O(n^2).
  void derivative(double periods, std::span<const double> state, std::span<double> derivative) const;

  /// dF/dy, 2n x 2n row by row, and dF/ds, 2n values. On the kink of the law its right-hand slope is taken.
  /// O(n^2).
  void jacobian(double periods, std::span<const double> state, std::span<double> state_derivative,
                std::span<double> time_derivative) const;

  /// The state (2n, m/s) of a displacement (n, m) and a velocity (n, m/s).
  Eigen::VectorXd state(const Eigen::VectorXd& displacement, const Eigen::VectorXd& velocity) const;

  const ContactLaws& laws() const { return laws_; }

 private:
  using RowMajorMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  // The displacement u_c (m) and the velocity (m/s) of a contact in a state.
  struct ContactState {
    double displacement, velocity;
  };
  ContactState contact_state(int contact, std::span<const double> state) const;

  ContactLaws laws_;
  ContactDirections directions_;
  double angular_frequency_;
  RowMajorMatrix linear_;                       // 2n x 2n, dF/dy without contact
  Eigen::VectorXd load_;                        // T M^-1 load, m/s
  Eigen::MatrixXd force_shapes_;                // n x forces, T M^-1 shape, m/s per unit of the series
  std::vector<Eigen::VectorXcd> force_series_;  // amplitudes at the frequency
  Eigen::MatrixXd contact_inertia_;             // T M^-1 S^T, n x contacts, s/kg
};

}  // namespace wavebalance::solvers

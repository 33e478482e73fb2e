#pragma once
#include <Eigen/Core>

#include "wavebalance/solvers/structure/linear_structure.hpp"

namespace wavebalance::oracle {

/// Throws std::invalid_argument naming `caller` when there is not exactly one contact.
void require_single_contact(const solvers::LinearStructure& structure, const char* caller);

/// The structure in its undamped modes, mass-normalised, with the periodic response to the load without
/// contact.
struct ModalStructure {
  /// Throws std::invalid_argument when the mass is not positive definite, the modes do not decouple the
  /// damping, or an undamped mode is loaded at its own frequency. O(n^3).
  ModalStructure(const solvers::LinearStructure& structure, double frequency_hz);

  int size() const { return static_cast<int>(stiffness.size()); }

  double angular_frequency;    // rad/s
  Eigen::VectorXd stiffness;   // n, 1/s^2, squared natural angular frequencies
  Eigen::VectorXd damping;     // n, 1/s
  Eigen::MatrixXd shapes;      // n x n, columns are modes
  Eigen::MatrixXd projection;  // n x n, modal coordinates of a displacement, shapes^T M
  Eigen::VectorXd contact;     // n, the modes along the contact's direction
  // n x (H + 1): without contact q(t) = Re sum_m linear_response[:, m] exp(i m omega t).
  Eigen::MatrixXcd linear_response;
};

}  // namespace wavebalance::oracle

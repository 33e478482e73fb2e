#include "period_oracle/shooting_modes.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>

#include "linalg/dense.hpp"

namespace wavebalance::oracle {

using Eigen::Index, solvers::LinearStructure;

namespace {

/// A coupling counts where rounding of the matrices and of the modes does not explain it.
void require_modal_damping(const Eigen::MatrixXd& modal) {
  const Eigen::VectorXd sizes = modal.diagonal().cwiseAbs();
  const double largest = sizes.maxCoeff();
  double worst = 0.0;
  bool coupled = false;
  for (Index j = 0; j < modal.cols(); ++j)
    for (Index i = 0; i < modal.rows(); ++i) {
      const double rounding = std::max(1e-9 * largest, 1e-8 * std::sqrt(sizes[i] * sizes[j]));
      if (i == j || std::abs(modal(i, j)) <= rounding) continue;
      coupled = true;
      worst = std::max(worst, std::abs(modal(i, j)));
    }
  if (!coupled) return;
  throw std::invalid_argument(
      "shoot: damping couples the undamped modes (largest coupling " + std::to_string(worst) +
      " 1/s, largest modal damping " + std::to_string(largest) +
      " 1/s); it must be proportional or modal. integrate_by_events takes any damping");
}

}  // namespace

void require_single_contact(const solvers::LinearStructure& structure, const char* caller) {
  if (structure.contacts() == 1) return;
  throw std::invalid_argument(std::string(caller) + ": contact_directions has " +
                              std::to_string(structure.contacts()) + " rows; this solver takes exactly 1");
}

ModalStructure::ModalStructure(const LinearStructure& structure, double frequency_hz)
    : angular_frequency(2.0 * std::numbers::pi * frequency_hz) {
  const Eigen::MatrixXd mass = structure.mass;
  if (!solvers::detail::cholesky(mass))
    throw std::invalid_argument("shoot: mass (" + std::to_string(structure.size()) + " x " +
                                std::to_string(structure.size()) +
                                ") is not positive definite; every degree of freedom needs a mass");
  if (structure.loss_factor != 0.0)
    throw std::invalid_argument("shoot: structural damping has no equation in time");
  if (!solvers::is_symmetric(structure.stiffness))
    throw std::invalid_argument(
        "shoot: stiffness is not symmetric, so that no real modes decouple the structure; "
        "integrate_by_events takes any damping and stiffness");
  const auto modes = solvers::detail::symmetric_eigen(Eigen::MatrixXd(structure.stiffness), mass);
  if (!modes)
    throw std::invalid_argument("shoot: no modes found; mass and stiffness must be symmetric and finite");
  stiffness = modes->values;
  shapes = modes->vectors;
  const Eigen::MatrixXd modal_damping = shapes.transpose() * (structure.damping * shapes);
  require_modal_damping(modal_damping);
  damping = modal_damping.diagonal();
  projection = shapes.transpose() * structure.mass;
  require_single_contact(structure, "shoot");
  const Eigen::MatrixXd along = structure.contact_directions * shapes;
  contact = along.row(0).transpose();
  const Eigen::MatrixXcd loads = structure.load_amplitudes(frequency_hz);
  linear_response = Eigen::MatrixXcd::Zero(size(), loads.cols());
  for (Index m = 0; m < loads.cols(); ++m) {
    linear_response.col(m).real() = shapes.transpose() * loads.col(m).real();
    linear_response.col(m).imag() = shapes.transpose() * loads.col(m).imag();
  }
  for (Index m = 0; m < linear_response.cols(); ++m) {
    const double omega = double(m) * angular_frequency;
    for (Index k = 0; k < linear_response.rows(); ++k)
      if (linear_response(k, m) != 0.0)
        linear_response(k, m) /= std::complex<double>(stiffness[k] - omega * omega, omega * damping[k]);
  }
  if (!linear_response.allFinite())
    throw std::invalid_argument("shoot: an undamped mode is loaded at its own frequency, " +
                                std::to_string(frequency_hz) +
                                " Hz or a multiple; the response without contact is unbounded");
}

}  // namespace wavebalance::oracle

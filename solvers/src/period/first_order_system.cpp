#include "wavebalance/solvers/period/first_order_system.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

#include "linalg/dense.hpp"
#include "linalg/option_checks.hpp"

namespace wavebalance::solvers {
namespace {

constexpr double two_pi = 2.0 * std::numbers::pi;

// The lower Cholesky factor of the mass.
Eigen::MatrixXd factor_mass(const LinearStructure& structure) {
  const auto factor = detail::cholesky(Eigen::MatrixXd(structure.mass));
  if (!factor)
    throw std::invalid_argument(
        "FirstOrderSystem: mass (" + std::to_string(structure.size()) + " x " +
        std::to_string(structure.size()) +
        ") is not positive definite; time integration needs a mass on every degree of freedom");
  return *factor;
}

}  // namespace

FirstOrderSystem::FirstOrderSystem(const LinearStructure& structure, ContactLaws laws, double frequency_hz)
    : laws_(std::move(laws)),
      directions_(structure.contact_directions),
      angular_frequency_(two_pi * frequency_hz) {
  structure.validate();
  structure.require_causal_damping("FirstOrderSystem");
  laws_.require(structure.contacts());
  detail::require_positive("FirstOrderSystem", "frequency_hz", frequency_hz);
  const double period = 1.0 / frequency_hz;
  const int n = structure.size();
  const Eigen::MatrixXd lower = factor_mass(structure);
  const auto divide_by_mass = [&](const Eigen::MatrixXd& right) -> Eigen::MatrixXd {
    return detail::solve_lower_transposed(lower, detail::solve_lower(lower, right));
  };
  load_ = period * divide_by_mass(structure.load);
  force_shapes_ = period * divide_by_mass(structure.load_shapes().rightCols(structure.load_count() - 1));
  for (const PeriodicForce& force : structure.forces) force_series_.push_back(force.amplitudes(frequency_hz));
  contact_inertia_ = period * divide_by_mass(Eigen::MatrixXd(directions_.transpose()));
  linear_ = RowMajorMatrix::Zero(2 * n, 2 * n);
  linear_.topRightCorner(n, n).diagonal().setConstant(two_pi);
  linear_.bottomLeftCorner(n, n) =
      -period / angular_frequency_ * divide_by_mass(Eigen::MatrixXd(structure.stiffness));
  linear_.bottomRightCorner(n, n) = -period * divide_by_mass(Eigen::MatrixXd(structure.damping));
}

FirstOrderSystem::ContactState FirstOrderSystem::contact_state(int contact,
                                                               std::span<const double> state) const {
  const auto n = static_cast<std::size_t>(dofs());
  double displacement = 0.0, velocity = 0.0;
  for (ContactDirections::InnerIterator entry(directions_, contact); entry; ++entry) {
    displacement += entry.value() * state[static_cast<std::size_t>(entry.col())];
    velocity += entry.value() * state[n + static_cast<std::size_t>(entry.col())];
  }
  return {displacement / angular_frequency_, velocity};
}

void FirstOrderSystem::derivative(double periods, std::span<const double> state,
                                  std::span<double> derivative) const {
  const int n = dofs();
  const Eigen::Map<const Eigen::VectorXd> y(state.data(), 2 * n);
  Eigen::Map<Eigen::VectorXd> rate(derivative.data(), 2 * n);
  rate.head(n) = two_pi * y.tail(n);
  rate.tail(n).noalias() = linear_.bottomRows(n) * y;
  rate.tail(n) += std::cos(two_pi * periods) * load_;
  for (std::size_t l = 0; l < force_series_.size(); ++l)
    rate.tail(n) += series_value(force_series_[l], periods) * force_shapes_.col(Eigen::Index(l));
  for (int c = 0; c < contact_inertia_.cols(); ++c) {
    const ContactState at = contact_state(c, state);
    rate.tail(n) -= laws_[c].force(at.displacement, at.velocity) * contact_inertia_.col(c);
  }
}

void FirstOrderSystem::jacobian(double periods, std::span<const double> state,
                                std::span<double> state_derivative, std::span<double> time_derivative) const {
  const int n = dofs();
  Eigen::Map<RowMajorMatrix> by_state(state_derivative.data(), 2 * n, 2 * n);
  Eigen::Map<Eigen::VectorXd> by_time(time_derivative.data(), 2 * n);
  by_state = linear_;
  for (int c = 0; c < contact_inertia_.cols(); ++c) {
    const ContactState at = contact_state(c, state);
    const ForceSlopes law = laws_[c].at(at.displacement, at.velocity);
    const double slope = law.tangent / angular_frequency_;
    for (ContactDirections::InnerIterator entry(directions_, c); entry; ++entry) {
      by_state.col(entry.col()).tail(n) -= slope * entry.value() * contact_inertia_.col(c);
      if (law.damping != 0.0)
        by_state.col(n + entry.col()).tail(n) -= law.damping * entry.value() * contact_inertia_.col(c);
    }
  }
  by_time.head(n).setZero();
  by_time.tail(n) = -two_pi * std::sin(two_pi * periods) * load_;
  for (std::size_t l = 0; l < force_series_.size(); ++l)
    by_time.tail(n) += series_slope(force_series_[l], periods) * force_shapes_.col(Eigen::Index(l));
}

Eigen::VectorXd FirstOrderSystem::state(const Eigen::VectorXd& displacement,
                                        const Eigen::VectorXd& velocity) const {
  Eigen::VectorXd result(states());
  result << angular_frequency_ * displacement, velocity;
  return result;
}

}  // namespace wavebalance::solvers

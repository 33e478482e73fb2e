#pragma once
#include <Eigen/Core>
#include <complex>
#include <numbers>
#include <optional>
#include <vector>

#include "linalg/dense.hpp"
#include "support/rigid_law.hpp"
#include "support/structure.hpp"
#include "wavebalance/solvers/flow/attractor_motion.hpp"
#include "wavebalance/solvers/impacts/impact_motion.hpp"

namespace wavebalance::solvers::testing {

/// A rigid obstacle with a restitution.
struct Obstacle : Rigid {
  Obstacle(double gap, double share) : Rigid{gap}, rebound(share) {}
  std::optional<double> restitution() const { return rebound; }
  double rebound;
};

inline ContactLaws obstacles(const Eigen::VectorXd& gaps, double restitution) {
  std::vector<AnyContactLaw> laws;
  for (const double gap : gaps) laws.emplace_back(Obstacle(gap, restitution));
  return {std::move(laws)};
}

/// M x'' + C x' + K x = load cos(omega t) against rigid obstacles, S x <= gaps.
struct ImpactScene {
  Eigen::MatrixXd mass, damping, stiffness;
  Eigen::VectorXd load;
  Eigen::MatrixXd contacts;
  Eigen::VectorXd gaps;
  double restitution = 1.0;
  double omega = 1.0;  ///< rad/s

  LinearStructure structure() const { return testing::structure(mass, damping, stiffness, load, contacts); }
  double frequency() const { return omega / (2.0 * std::numbers::pi); }
  /// All degrees of freedom without contact, n.
  Eigen::VectorXcd free_amplitudes() const {
    const std::complex<double> rate(0.0, omega);
    const Eigen::MatrixXcd impedance = rate * rate * mass.cast<std::complex<double>>() +
                                       rate * damping.cast<std::complex<double>>() +
                                       stiffness.cast<std::complex<double>>();
    return detail::Lu<std::complex<double>>(impedance).solve(
        Eigen::VectorXcd(load.cast<std::complex<double>>()));
  }
  ContactLaws laws() const { return obstacles(gaps, restitution); }
  ExactProblem problem(const ContactDynamics& dynamics) const {
    ExactProblem result{dynamics, laws(), Eigen::MatrixXcd::Zero(contacts.rows(), 2), frequency()};
    result.linear_motion.col(1) = contacts * free_amplitudes();
    return result;
  }
};

/// x'' + c x' + x = cos(omega t), x <= gap.
inline ImpactScene impact_oscillator(double damping, double gap, double restitution, double omega) {
  const auto one = [](double value) { return Eigen::MatrixXd::Constant(1, 1, value); };
  return {one(1.0),    one(damping),
          one(1.0),    Eigen::VectorXd::Ones(1),
          one(1.0),    Eigen::VectorXd::Constant(1, gap),
          restitution, omega};
}

/// Two masses of 1 between three springs of 1, the load on the second, the obstacle before the first.
inline ImpactScene two_masses_with_impacts(double gap, double restitution, double omega) {
  ImpactScene scene;
  scene.mass = Eigen::Matrix2d::Identity();
  scene.damping = 0.05 * scene.mass;
  scene.stiffness = (Eigen::Matrix2d() << 2.0, -1.0, -1.0, 2.0).finished();
  scene.load = Eigen::Vector2d(0.0, 1.0);
  scene.contacts = Eigen::RowVector2d(1.0, 0.0);
  scene.gaps = Eigen::VectorXd::Constant(1, gap);
  scene.restitution = restitution;
  scene.omega = omega;
  return scene;
}

/// A bar fixed at one end, EA = rho A = L = 1, of lumped elements with C = damping K, and at the other end a
/// mass, the load and the obstacle.
inline ImpactScene lumped_bar(int elements, double tip_mass, double damping, double gap, double restitution,
                              double omega) {
  ImpactScene scene;
  const double length = 1.0 / elements;
  scene.mass = length * Eigen::MatrixXd::Identity(elements, elements);
  scene.mass(elements - 1, elements - 1) = 0.5 * length + tip_mass;
  scene.stiffness = Eigen::MatrixXd::Zero(elements, elements);
  for (int i = 0; i < elements; ++i) {
    scene.stiffness(i, i) = (i + 1 < elements ? 2.0 : 1.0) / length;
    if (i > 0) scene.stiffness(i, i - 1) = scene.stiffness(i - 1, i) = -1.0 / length;
  }
  scene.damping = damping * scene.stiffness;
  scene.load = Eigen::VectorXd::Unit(elements, elements - 1);
  scene.contacts = Eigen::RowVectorXd::Unit(elements, elements - 1);
  scene.gaps = Eigen::VectorXd::Constant(1, gap);
  scene.restitution = restitution;
  scene.omega = omega;
  return scene;
}

}  // namespace wavebalance::solvers::testing

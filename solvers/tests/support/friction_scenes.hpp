#pragma once
#include <Eigen/Core>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include "support/structure.hpp"
#include "wavebalance/contact/coulomb_law.hpp"
#include "wavebalance/solvers/balance/contact_laws.hpp"
#include "wavebalance/solvers/structure/linear_structure.hpp"

// Structures with friction whose exact motions are known from event-driven integration.
namespace wavebalance::solvers::testing {

struct FrictionScene {
  LinearStructure structure;
  std::vector<contact::CoulombLaw> laws;
  double omega = 1.0;                          // rad/s
  std::vector<contact::LinearLaw> stops = {};  // one each in the last rows, after the rows of the laws

  double frequency() const { return omega / (2.0 * std::numbers::pi); }
  ContactLaws contact_laws() const {
    std::vector<AnyContactLaw> all(laws.begin(), laws.end());
    all.insert(all.end(), stops.begin(), stops.end());
    return all;
  }
};

inline FrictionScene friction_scene(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& damping,
                                    const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& rows,
                                    const Eigen::VectorXd& load, double omega,
                                    std::vector<contact::CoulombLaw> laws) {
  return {structure(mass, damping, stiffness, load, rows), std::move(laws), omega};
}

// x'' + 0.05 x' + x + f = F cos(omega t).
inline FrictionScene slider_on_oscillator(double load, double kt, double omega, double limit = 1.0) {
  const Eigen::MatrixXd one = Eigen::MatrixXd::Ones(1, 1);
  return friction_scene(one, 0.05 * one, one, one, Eigen::VectorXd::Constant(1, load), omega,
                        {contact::CoulombLaw({1.0, kt, limit})});
}

// Two unit masses between springs of 1, damping 0.02 K, the load on the second, the slider on the first.
inline FrictionScene rubbing_masses(double load, double kt, double limit, double omega,
                                    double damper_on_second = 0.0) {
  const Eigen::Matrix2d stiffness{{2.0, -1.0}, {-1.0, 2.0}};
  Eigen::Matrix2d damping = 0.02 * stiffness;
  damping(1, 1) += damper_on_second;
  return friction_scene(Eigen::Matrix2d::Identity(), damping, stiffness, Eigen::RowVector2d(1.0, 0.0),
                        Eigen::Vector2d(0.0, load), omega, {contact::CoulombLaw({1.0, kt, limit})});
}

// Three unit masses, a slider between the first and the ground and one between the first two.
inline FrictionScene chain_of_three(double load, double omega) {
  const Eigen::Matrix3d stiffness{{2.0, -1.0, 0.0}, {-1.0, 2.0, -1.0}, {0.0, -1.0, 2.0}};
  const Eigen::MatrixXd rows{{1.0, 0.0, 0.0}, {-1.0, 1.0, 0.0}};
  const contact::CoulombLaw slider({1.0, 20.0, 1.0});
  return friction_scene(Eigen::Matrix3d::Identity(), 0.02 * stiffness, stiffness, rows,
                        Eigen::Vector3d(0.0, load, 0.0), omega, {slider, slider});
}

// A mass that moves along x and towards an obstacle along y, on which it rubs: rows y, x.
inline FrictionScene lift_off(double load_x, double load_y, double normal_load, double mu, double omega) {
  const Eigen::Matrix2d stiffness{{12.0, -3.0}, {-3.0, 10.0}}, rows{{0.0, 1.0}, {1.0, 0.0}};
  FrictionScene scene =
      friction_scene(Eigen::Matrix2d::Identity(), 0.35 * Eigen::Matrix2d::Identity(), stiffness, rows,
                     Eigen::Vector2d(load_x, 0.0), omega,
                     {contact::CoulombLaw({mu, 5.0, normal_load}, contact::LinearLaw(21.0, 0.0))});
  Eigen::VectorXcd harmonics(2);
  harmonics << normal_load, std::polar(load_y, -0.7);
  scene.structure.forces.push_back({Eigen::Vector2d(0.0, 1.0), harmonics});
  return scene;
}

// A mass that slips in a plane under a constant limit.
inline FrictionScene slip_in_a_plane(double limit, double omega) {
  const Eigen::Matrix2d stiffness{{1.0, 0.2}, {0.2, 1.6}};
  FrictionScene scene = friction_scene(Eigen::Matrix2d::Identity(), 0.04 * Eigen::Matrix2d::Identity(),
                                       stiffness, Eigen::Matrix2d::Identity(), Eigen::Vector2d(1.0, 0.0),
                                       omega, {contact::CoulombLaw({1.0, 3.0, limit, 2})});
  Eigen::VectorXcd harmonics(2);
  harmonics << 0.0, std::polar(0.8, -1.1);
  scene.structure.forces.push_back({Eigen::Vector2d(0.0, 1.0), harmonics});
  return scene;
}

// A cantilever of four Euler-Bernoulli elements, transverse and rotational, with a slider at its second node.
inline FrictionScene cantilever(double load, double kt, double limit, double frequency) {
  constexpr int elements = 4;
  constexpr double length = 2.0 / elements, modulus = 185e9, inertia = 0.3 * 0.1 * 0.1 * 0.1 / 12.0,
                   line_mass = 7830.0 * 0.1 * 0.3;
  const double l = length, ei = modulus * inertia / (l * l * l), m = line_mass * l / 420.0;
  Eigen::Matrix4d k, mm;
  k << 12, 6 * l, -12, 6 * l, 6 * l, 4 * l * l, -6 * l, 2 * l * l, -12, -6 * l, 12, -6 * l, 6 * l, 2 * l * l,
      -6 * l, 4 * l * l;
  mm << 156, 22 * l, 54, -13 * l, 22 * l, 4 * l * l, 13 * l, -3 * l * l, 54, 13 * l, 156, -22 * l, -13 * l,
      -3 * l * l, -22 * l, 4 * l * l;
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(10, 10), mass = stiffness;
  for (int e = 0; e < elements; ++e) {
    stiffness.block(2 * e, 2 * e, 4, 4) += ei * k;
    mass.block(2 * e, 2 * e, 4, 4) += m * mm;
  }
  const Eigen::MatrixXd held = stiffness.bottomRightCorner(8, 8);
  Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(8);
  row[2] = 1.0;
  Eigen::VectorXd tip = Eigen::VectorXd::Zero(8);
  tip[6] = load;
  return friction_scene(mass.bottomRightCorner(8, 8), 2e-4 * held, held, row, tip,
                        2.0 * std::numbers::pi * frequency, {contact::CoulombLaw({1.0, kt, limit})});
}

/// 2/T times the integral of u exp(i omega t), of samples from t = 0 on.
inline std::complex<double> first_harmonic(const Eigen::VectorXd& samples) {
  std::complex<double> sum = 0.0;
  for (Eigen::Index l = 0; l < samples.size(); ++l)
    sum += samples[l] * std::polar(1.0, 2.0 * std::numbers::pi * double(l) / double(samples.size()));
  return 2.0 / double(samples.size()) * sum;
}

}  // namespace wavebalance::solvers::testing

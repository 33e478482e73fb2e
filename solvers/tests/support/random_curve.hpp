#pragma once
#include <Eigen/Eigenvalues>
#include <cmath>
#include <random>

#include "constants.hpp"
#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/problem/contact_problem.hpp"

namespace wavebalance::solvers::testing {

/// A chain on supports or between stops over a range of frequencies about a resonance, with a static load of
/// none, two or twenty times the vibrating one and stops 10 to 1000 times as stiff as the chain itself.
struct RandomCurve {
  LinearStructure structure;
  ContactLaws laws;
  double from = 0.0, to = 0.0;  // Hz
  double static_share = 0.0;    // static over vibrating load

  ContactProblem problem(int functions, int samples) const {
    return ContactProblem(fourier_pair(functions, samples), structure, laws);
  }
};

inline LinearStructure damped_chain(int size, double damping_ratio, std::mt19937& generator) {
  LinearStructure chain = random_chain(size, generator);
  const Eigen::MatrixXd mass = chain.mass, stiffness = chain.stiffness;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(stiffness, mass);
  const Eigen::VectorXd diagonal = 2.0 * damping_ratio * modes.eigenvalues().cwiseSqrt();
  const Eigen::MatrixXd shapes = mass * modes.eigenvectors();
  chain.damping = (shapes * diagonal.asDiagonal() * shapes.transpose()).sparseView();
  return chain;
}

inline RandomCurve random_curve(unsigned seed) {
  std::mt19937 generator(9001 + seed);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  const int size = 1 + int(4.0 * any(generator)), contacts = 1 + (size > 1 && any(generator) < 0.4 ? 1 : 0);
  const double ratio = std::pow(10.0, -2.3 + 1.2 * any(generator));
  RandomCurve drawn{damped_chain(size, ratio, generator), AnyContactLaw(), 0.0, 0.0, 0.0};
  LinearStructure& chain = drawn.structure;
  const Eigen::MatrixXd mass = chain.mass, stiffness = chain.stiffness;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(stiffness, mass);
  const int mode = any(generator) < 0.7 ? 0 : std::min(1, size - 1);
  const double omega = std::sqrt(modes.eigenvalues()[mode]);
  chain.load = Eigen::VectorXd::Unit(size, int(any(generator) * size));
  std::vector<int> dofs;
  for (int c = 0; c < contacts; ++c) dofs.push_back((size - 1 + c) % size);
  chain.contact_directions = contact_rows(dofs, size);
  for (int c = 0; c < contacts; ++c)
    if (any(generator) < 0.5) chain.contact_directions.row(c) *= -1.0;
  const double shares[] = {0.0, 2.0, 20.0};
  drawn.static_share = shares[int(3.0 * any(generator))];
  const Eigen::VectorXd weight = drawn.static_share * (any(generator) < 0.5 ? 1.0 : -1.0) * chain.load;
  Eigen::VectorXcd constant(1);
  constant << 1.0;
  if (drawn.static_share > 0.0) chain.forces.push_back({weight, constant});
  const Eigen::VectorXd at_rest = chain.contact_directions * stiffness.ldlt().solve(weight);
  const Eigen::MatrixXd inverse = stiffness.inverse();
  std::vector<AnyContactLaw> laws;
  for (int c = 0; c < contacts; ++c) {
    const Eigen::VectorXd row = Eigen::VectorXd(chain.contact_directions.row(c).transpose());
    const double shape = std::abs(row.dot(modes.eigenvectors().col(mode)));
    const double resonant =
        shape * std::abs(modes.eigenvectors().col(mode).dot(chain.load)) / (2.0 * ratio * omega * omega);
    const double own = 1.0 / row.dot(inverse * row), stiff = own * std::pow(10.0, 1.0 + 2.0 * any(generator));
    const bool on_support = drawn.static_share > 0.0 && any(generator) < 0.5;
    laws.push_back(
        LinearContact{stiff, on_support ? 0.0 : at_rest[c] + resonant * (0.1 + 0.8 * any(generator))});
  }
  drawn.laws = ContactLaws(laws);
  drawn.from = (0.35 + 0.45 * any(generator)) * omega / two_pi;
  drawn.to = (1.2 + any(generator)) * omega / two_pi;
  if (any(generator) < 0.3) std::swap(drawn.from, drawn.to);
  return drawn;
}

}  // namespace wavebalance::solvers::testing

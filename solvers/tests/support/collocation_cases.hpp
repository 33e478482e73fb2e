#pragma once
#include <gtest/gtest.h>

#include <random>

#include "constants.hpp"
#include "support/condensation_cases.hpp"
#include "support/oscillator.hpp"
#include "support/small_problems.hpp"
#include "wavebalance/solvers/balance/condensed_problem.hpp"
#include "wavebalance/solvers/collocation/collocation_motion.hpp"
#include "wavebalance/solvers/stability/contact_dynamics.hpp"

/// Structures, laws and checks that the tests of collocation share.
namespace wavebalance::solvers::testing {

inline Eigen::VectorXd uniform_times(int count) {
  return Eigen::VectorXd::LinSpaced(count, 0.0, 1.0 - 1.0 / count);
}

inline double distance(const Eigen::MatrixXd& values, const Eigen::MatrixXd& exact) {
  return (values - exact).norm() / exact.norm();
}

/// Checks of any motion: forces follow from the law at the displacements, the displacements outside contact
/// intervals are on the other side of the gap, and the work of load, damping and contacts is zero.
inline void expect_motion(const ExactSolution& motion, const ContactLaws& laws, double tolerance) {
  const Eigen::VectorXd times = uniform_times(257);
  const Eigen::MatrixXd u = motion.displacement(times), v = motion.velocity(times), f = motion.force(times);
  const double size = f.cwiseAbs().maxCoeff();
  for (Eigen::Index c = 0; c < u.rows(); ++c)
    for (Eigen::Index k = 0; k < times.size(); ++k)
      EXPECT_NEAR(f(c, k), laws[static_cast<int>(c)].force(u(c, k), v(c, k)), tolerance * size)
          << "contact " << c << " at " << times[k];
}

//// The multipliers of both lists, by falling modulus, where they are above 1e-6.
inline void expect_same(const Eigen::VectorXcd& found, const Eigen::VectorXcd& expected, double tolerance) {
  for (const std::complex<double> multiplier : expected) {
    if (std::abs(multiplier) < 1e-6) continue;
    const double nearest = (found.array() - multiplier).abs().minCoeff();
    EXPECT_LT(nearest, tolerance) << multiplier;
  }
}

/// Kelvin and Voigt's stop, whose force jumps where contact begins and ends.
struct DampedStop {
  double stiffness, dashpot, start;
  double force(double u, double v) const { return u > start ? stiffness * (u - start) + dashpot * v : 0.0; }
  double tangent(double u, double) const { return u >= start ? stiffness : 0.0; }
  double damping(double u, double) const { return u >= start ? dashpot : 0.0; }
  double potential(double u) const { return u > start ? 0.5 * stiffness * (u - start) * (u - start) : 0.0; }
  double gap() const { return start; }
};

/// That stop where it does not pull. The dashpot may rise over a depth, as in the catalogue's law.
struct PushingStop {
  double stiffness, dashpot, start, depth = 0.0;

  double share(double u) const {
    const double x = depth > 0.0 ? std::min((u - start) / depth, 1.0) : 1.0;
    return x * x * (3.0 - 2.0 * x);
  }
  double rise(double u) const {
    const double x = depth > 0.0 ? (u - start) / depth : 1.0;
    return x < 1.0 ? 6.0 * x * (1.0 - x) / depth : 0.0;
  }
  double force(double u, double v) const {
    return u > start ? std::max(stiffness * (u - start) + dashpot * share(u) * v, 0.0) : 0.0;
  }
  bool pushes(double u, double v) const { return force(u, v) > 0.0; }
  double tangent(double u, double v) const { return pushes(u, v) ? stiffness + dashpot * rise(u) * v : 0.0; }
  double damping(double u, double v) const { return pushes(u, v) ? dashpot * share(u) : 0.0; }
  double potential(double u) const { return u > start ? 0.5 * stiffness * (u - start) * (u - start) : 0.0; }
  double gap() const { return start; }
  std::vector<double> breakpoints() const {
    return depth > 0.0 ? std::vector{start, start + depth} : std::vector{start};
  }
};

/// Hunt and Crossley's law, which does not pull.
struct HuntCrossley {
  double stiffness, power, dissipation, start;

  bool pushes(double u, double v) const { return u > start && 1.0 + dissipation * v > 0.0; }
  double force(double u, double v) const {
    return pushes(u, v) ? stiffness * std::pow(u - start, power) * (1.0 + dissipation * v) : 0.0;
  }
  double tangent(double u, double v) const {
    return pushes(u, v) ? power * stiffness * std::pow(u - start, power - 1.0) * (1.0 + dissipation * v)
                        : 0.0;
  }
  double damping(double u, double v) const {
    return pushes(u, v) ? dissipation * stiffness * std::pow(u - start, power) : 0.0;
  }
  double potential(double u) const {
    return u > start ? stiffness / (power + 1.0) * std::pow(u - start, power + 1.0) : 0.0;
  }
  double gap() const { return start; }
};

/// A random chain with contacts along random directions, and a balance of it.
struct RandomCase {
  RandomCase(std::mt19937& generator, int contacts)
      : structure(random_chain(std::max(contacts, 2) + 2, generator)) {
    structure.contact_directions = random_directions(contacts, structure.size(), generator);
    std::vector<AnyContactLaw> list;
    const ContactDynamics linear(structure);
    double lowest = infinity;
    for (const ContactPole& pole : linear.poles())
      if (pole.exponent.imag() > 0.0) lowest = std::min(lowest, pole.exponent.imag());
    frequency = 0.8 * lowest / two_pi;
    CondensedProblem free(fourier_pair(15, 64), structure, cosine_load());
    free.set_frequency(frequency);
    const double size = free.linear_response().cwiseAbs().maxCoeff();
    for (int c = 0; c < contacts; ++c)
      list.emplace_back(LinearContact{(1.0 + c) / free.contact_compliance()[c], (0.3 + 0.1 * c) * size});
    laws = ContactLaws(std::move(list));
  }

  LinearStructure structure;
  ContactLaws laws;
  double frequency = 0.0;
};

/// The stops of a case with dashpots, of `share` times the stiffness over the frequency.
inline ContactLaws with_dashpots(const RandomCase& random, double share) {
  std::vector<AnyContactLaw> laws;
  for (int c = 0; c < random.structure.contacts(); ++c) {
    const double gap = random.laws[c].gap(), stiffness = random.laws[c].tangent(2.0 * gap);
    laws.emplace_back(DampedStop{stiffness, share * stiffness / random.frequency, gap});
  }
  return ContactLaws(std::move(laws));
}

/// Two masses with a spring and a dashpot between them that nothing holds but a stop on either side.
inline LinearStructure free_pair() {
  const Eigen::Matrix2d coupling{{1.0, -1.0}, {-1.0, 1.0}}, sides{{1.0, 0.0}, {0.0, -1.0}};
  LinearStructure structure =
      testing::structure(Eigen::Vector2d(1.0, 0.7).asDiagonal(), 0.8 * coupling, 100.0 * coupling,
                         Eigen::Vector2d(1.0, 0.3), Eigen::MatrixXd(sides));
  structure.rigid_modes = Eigen::MatrixXd::Constant(2, 1, 1.0 / std::sqrt(1.7));
  return structure;
}

/// A chain of three masses whose ends are held by springs, and contacts without mass on springs before two of
/// its masses, which also deflect each other.
inline LinearStructure with_massless_contacts(double dashpot = 0.0) {
  Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(5, 5), damping = stiffness, mass = stiffness;
  const auto spring = [&](int i, int j, double k, double c) {
    for (auto [matrix, value] : {std::pair{&stiffness, k}, {&damping, c}}) {
      (*matrix)(i, i) += value;
      if (j < 0) continue;
      (*matrix)(j, j) += value;
      (*matrix)(i, j) -= value;
      (*matrix)(j, i) -= value;
    }
  };
  spring(0, -1, 90.0, 0.4);
  spring(0, 1, 100.0, 0.4);
  spring(1, 2, 110.0, 0.4);
  spring(2, -1, 80.0, 0.4);
  spring(3, 0, 300.0, dashpot);
  spring(4, 2, 350.0, dashpot);
  spring(3, 4, 40.0, 0.0);
  mass.diagonal().head(3) << 1.0, 0.8, 1.2;
  Eigen::MatrixXd directions = Eigen::MatrixXd::Zero(2, 5);
  directions(0, 3) = 1.0;
  directions(1, 4) = -1.0;
  return structure(mass, damping, stiffness, Eigen::VectorXd::Unit(5, 1), directions);
}

}  // namespace wavebalance::solvers::testing

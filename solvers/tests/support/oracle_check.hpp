#pragma once
#include <algorithm>

#include "support/friction_oracle.hpp"
#include "wavebalance/solvers/phases/structure_phases.hpp"

namespace wavebalance::solvers::testing {

// The state of a motion at the start of the period.
inline FrictionOracle::State state_of(CondensedProblem& problem, const PhaseMotion& motion,
                                      const FrictionOracle& oracle) {
  using Does = FrictionOracle::Does;
  const StructurePhases whole =
      structure_phases(problem, motion, 1, {.tolerance = 1e-13, .first_harmonics = 8192});
  std::vector<Does> does;
  Eigen::VectorXd tangential(Eigen::Index(motion.friction.size()));
  for (std::size_t c = 0; c < motion.friction.size(); ++c) {
    const FrictionAlong& contact = motion.friction[c];
    const auto now = std::find_if(contact.parts.begin(), contact.parts.end(), [](const FrictionPart& part) {
      return part.begin <= 0.0 || part.end > 1.0;
    });
    does.push_back(now->state == FrictionPart::State::open    ? Does::open
                   : now->state == FrictionPart::State::stick ? Does::stick
                   : now->sign > 0.0                          ? Does::slip_up
                                                              : Does::slip_down);
    tangential[Eigen::Index(c)] =
        motion.force(Eigen::VectorXd::Zero(1))(contact.row + contact.constants.normal_rows, 0);
  }
  return oracle.start(whole.motion.displacement.col(0), whole.motion.velocity.col(0), tangential, does);
}

struct OracleCheck {
  double change = 0.0;       // of the state over a period, over its size
  double multipliers = 0.0;  // largest distance of one of the oracle's from those of the motion
};

// A motion of a scene, of which `problem` has the frequency, against the event-driven motion of a period.
inline OracleCheck check(const FrictionScene& scene, CondensedProblem& problem, const PhaseMotion& motion) {
  const FrictionOracle oracle(scene);
  const FrictionOracle::State start = state_of(problem, motion, oracle), end = oracle.period(start);
  const Eigen::Index states = oracle.states();
  const Eigen::VectorXcd exact = end.by_start.topLeftCorner(states, states).eigenvalues(),
                         own = motion.multipliers();
  OracleCheck result{(end.z - start.z).norm() / start.z.norm()};
  for (const std::complex<double> one : exact)
    if (std::abs(one) > 1e-3)
      result.multipliers = std::max(result.multipliers, (own.array() - one).abs().minCoeff());
  return result;
}

}  // namespace wavebalance::solvers::testing

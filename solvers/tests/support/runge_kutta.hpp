#pragma once
#include "dense_algebra.hpp"

namespace wavebalance::solvers::testing {

/// The state after `steps` steps of the classical method of Runge and Kutta with rate(time, state), from time
/// zero on.
template <class State, class Rate>
State runge_kutta(const Rate& rate, State state, double length, int steps) {
  const double h = length / steps;
  for (int i = 0; i < steps; ++i) {
    const State a = rate(i * h, state), b = rate((i + 0.5) * h, State(state + 0.5 * h * a)),
                c = rate((i + 0.5) * h, State(state + 0.5 * h * b)),
                d = rate((i + 1) * h, State(state + h * c));
    state += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return state;
}

/// The state after one period from `start`, and the multipliers of differences of neighbouring motions.
template <class State>
struct PeriodMap {
  template <class Rate>
  PeriodMap(const Rate& rate, const State& start, double period, int steps)
      : end(runge_kutta(rate, start, period, steps)) {
    Eigen::Matrix<double, State::RowsAtCompileTime, State::RowsAtCompileTime> map;
    constexpr double small = 1e-6;
    for (Eigen::Index i = 0; i < start.size(); ++i)
      map.col(i) = (runge_kutta(rate, State(start + small * State::Unit(i)), period, steps) - end) / small;
    multipliers = oracle::eigenvalues(map);
  }

  auto unstable() const { return (multipliers.cwiseAbs().array() > 1.0).count(); }

  State end;
  Eigen::VectorXcd multipliers;
};

}  // namespace wavebalance::solvers::testing

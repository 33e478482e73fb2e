#pragma once

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

}  // namespace wavebalance::solvers::testing

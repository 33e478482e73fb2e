"""An integration of piecewise linear systems of the tests' own: exact flows between events, none of the product's code."""

import numpy as np
from scipy.linalg import expm


def mode(stiffness, damping, load=(), constant=None, exits=(), held=()):
    """A mode of masses of 1: x'' + damping x' + stiffness x = load cos(w t) + constant, some masses held where they are; an exit is a
    guard, positive within the mode, over (x, v, cos, sin, 1), the next mode, and a map of (x, v) or none."""
    size = len(stiffness)
    rates = np.zeros((2 * size + 3, 2 * size + 3))
    rates[:size, size:2 * size] = np.eye(size)
    rates[size:2 * size, :size] = -np.asarray(stiffness)
    rates[size:2 * size, size:2 * size] = -np.asarray(damping)
    rates[size:2 * size, 2 * size] = load
    rates[size:2 * size, -1] = np.zeros(size) if constant is None else constant
    for one in held:
        rates[[one, size + one]] = 0.0
    return rates, [(np.asarray(guard, float), target, jump) for guard, target, jump in exits]


class Flow:
    """Runs modes from event to event. `choose` may send a mode that is entered on to another one by its state."""

    def __init__(self, modes, omega, choose=lambda name, state: name, steps=600):
        self.omega, self.period, self.choose, self.modes = omega, 2 * np.pi / omega, choose, {}
        self.step = self.period / steps
        for name, (rates, exits) in modes.items():
            rates = rates.copy()
            rates[-3, -2], rates[-2, -3] = -omega, omega
            self.modes[name] = rates, exits, {}

    def advanced(self, name, state, time):
        """The state after a time in a mode; the flows of whole steps and of their halves are kept."""
        rates, _, kept = self.modes[name]
        if time not in kept:
            if time < self.step and np.log2(self.step / time) % 1:
                return expm(rates * time) @ state
            kept[time] = expm(rates * time)
        return kept[time] @ state

    def event(self, name, state, high, guard):
        """The time at which a guard that is negative after `high` becomes zero, by Newton's method within a bracket."""
        rates, low, time = self.modes[name][0], 0.0, high
        for _ in range(60):
            after = self.advanced(name, state, time)
            value = guard @ after
            low, high = (time, high) if value > 0 else (low, time)
            slope = guard @ rates @ after
            step = value / slope if slope < 0 else np.inf
            time = time - step if low < time - step < high else 0.5 * (low + high)
            if abs(step) < 1e-16 * self.period or high - low < 1e-16 * self.period:
                break
        later = (time + share * self.period for share in (0.0, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12))
        return next((one for one in later if guard @ self.advanced(name, state, one) <= 0), high)

    def run(self, start, name, periods=1, phase=0.0):
        """From a state (x, v) at a share `phase` of the period on: the last state, its mode, the derivative by the start, the events as
        (share, mode before, mode after, state before) and a path of (share, mode, state)."""
        size = len(start)
        angle = 2 * np.pi * phase
        state = np.array([*start, np.cos(angle), np.sin(angle), 1.0])
        derivative, events, path = np.eye(size), [], [(phase, name, state)]
        time, end, step = 0.0, periods * self.period, self.step
        while time < end:
            step = min(step, end - time)
            after = self.advanced(name, state, step)
            crossed = [(guard, target, jump) for guard, target, jump in self.modes[name][1] if guard @ after < 0]
            if crossed:
                step, (guard, target, jump) = min(((self.event(name, state, step, one[0]), one) for one in crossed), key=lambda one: one[0])
                after = self.advanced(name, state, step)
            rates = self.modes[name][0]
            derivative = expm(rates * step)[:size, :size] @ derivative
            time += step
            state, step = after, min(2 * step, self.step) if not crossed else self.step / 1024
            if crossed:
                if len(events) > 100 * periods + 100:
                    raise RuntimeError("events follow one another without end")
                path.append((phase + time / self.period, name, state))
                state, name, derivative = self.crossing(name, guard, target, jump, state, derivative, events, phase + time / self.period)
            path.append((phase + time / self.period, name, state))
        return state[:size], name, derivative, events, path

    def crossing(self, name, guard, target, jump, state, derivative, events, share):
        """The state, mode and derivative behind an event."""
        size = len(derivative)
        reset = np.eye(len(state))
        if jump is not None:
            reset[:size, :size] = jump
        after = reset @ state
        target = self.choose(target, after)
        before_rate, after_rate = self.modes[name][0] @ state, self.modes[target][0] @ after
        salted = reset + np.outer(after_rate - reset @ before_rate, guard) / (guard @ before_rate)
        events.append((share, name, target, state))
        return after, target, salted[:size, :size] @ derivative

    def periodic(self, start, name, periods=1, phase=0.0):
        """The periodic motion near a start by Newton's method: its state, and what `run` returns."""
        state = np.array(start, float)
        for _ in range(30):
            ran = self.run(state, name, periods, phase)
            rest = ran[0] - state
            if np.linalg.norm(rest) < 1e-11 * (1 + np.linalg.norm(state)):
                return state, ran
            state = state - np.linalg.lstsq(ran[2] - np.eye(len(state)), rest, rcond=1e-12)[0]
        raise RuntimeError(f"no periodic motion near the start, which returns within {np.linalg.norm(rest):.1e}")

    def largest(self, path, row=0):
        """The largest displacement of a mass along a path, where its velocity passes zero."""
        size = (len(path[0][2]) - 3) // 2
        guard = np.eye(len(path[0][2]))[size + row]
        found = [state[row] for _, _, state in path]
        for (begin, _, state), (end, name, after) in zip(path, path[1:]):
            if guard @ state > 0 > guard @ after and end > begin:
                found.append(self.advanced(name, state, self.event(name, state, (end - begin) * self.period, guard))[row])
        return max(found)

    def settled(self, start, name, periods):
        """The motion after many periods, and one more period of it."""
        state, name, *_ = self.run(start, name, periods)
        return state, self.run(state, name)

"""Periodic motions by matrix exponentials and Newton's method on the map of a period, without any time basis.

A structure with a linear stop has two linear flows, open and closed, joined where its contact reaches the gap.
"""

import math

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq


class Oscillator:
    """A mass of 1 kg on a spring of 1 N/m, u'' + damping u' + u + stop max(u - gap, 0) = load cos(2 pi f t)."""

    def __init__(self, load, frequency, damping=0.05, stop=2.0, gap=1.0, steps=1024):
        self.gap, self.stop, self.steps = gap, stop, steps
        omega = 2.0 * math.pi * frequency
        # Of displacement, velocity, cosine, sine and one.
        self.rates = np.zeros((2, 5, 5))
        self.rates[:, 0, 1], self.rates[:, 1, 0], self.rates[:, 1, 1], self.rates[:, 1, 2] = 1.0, -1.0, -damping, load
        self.rates[:, 2, 3], self.rates[:, 3, 2] = -omega, omega
        self.rates[1, 1, 0] -= stop
        self.rates[1, 1, 4] = stop * gap
        self.step = 1.0 / (frequency * steps)
        self.flow = [expm(rate * self.step) for rate in self.rates]

    def period(self, state):
        """The samples of a period from a state, the state at its end, and the derivative of that by the state."""
        y, derivative = np.array([*state, 1.0, 0.0, 1.0]), np.eye(2)
        samples = np.empty((self.steps, 2))
        for i in range(self.steps):
            samples[i] = y[:2]
            y, across = self._advance(y)
            derivative = across[:2, :2] @ derivative
        return samples, y[:2], derivative

    def _advance(self, y):
        side = int(y[0] > self.gap)
        end = self.flow[side] @ y
        if int(end[0] > self.gap) == side:
            return end, self.flow[side]
        at = brentq(lambda time: (expm(self.rates[side] * time) @ y)[0] - self.gap, 0.0, self.step, xtol=1e-15)
        across = expm(self.rates[1 - side] * (self.step - at)) @ expm(self.rates[side] * at)
        return across @ y, across

    def periodic(self, state, tolerance=1e-11):
        """Displacement and contact force of the periodic motion that Newton's method finds from a state."""
        for _ in range(30):
            samples, end, derivative = self.period(state)
            if np.linalg.norm(end - state) <= tolerance * np.linalg.norm(state):
                return samples[:, 0], self.stop * np.maximum(samples[:, 0] - self.gap, 0.0)
            state = state + np.linalg.solve(np.eye(2) - derivative, end - state)
        raise AssertionError("Newton's method on the map of the period does not converge")

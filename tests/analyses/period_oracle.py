"""Periodic motions by matrix exponentials and Newton's method on the map of a period, without any time basis.

A structure with a linear stop has two linear flows, open and closed, joined where its contact reaches the gap.
"""

import math

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq


def bar_matrices(elements):
    """Mass and stiffness of the bar of 1 m that tests share, clamped at one end, of linear elements."""
    length = 1.0 / elements
    mass, stiffness = np.zeros((2, elements + 1, elements + 1))
    for i in range(elements):
        mass[i : i + 2, i : i + 2] += 2700 * 25e-4 * length / 6.0 * np.array([[2.0, 1.0], [1.0, 2.0]])
        stiffness[i : i + 2, i : i + 2] += 70e9 * 25e-4 / length * np.array([[1.0, -1.0], [-1.0, 1.0]])
    return mass[1:, 1:], stiffness[1:, 1:]


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


class RigidTip:
    """A damped structure whose last degree of freedom, without mass, touches a rigid obstacle.

    Closing transfers no impulse. The tip is free, or closed until the force falls to zero. State: displacements with
    mass, their velocities over a bound of the natural angular frequencies, displacement of the tip, cosine and sine of
    the load; time as a fraction of the period. The matrix exponential loses the digits by which displacements and
    velocities differ in size.
    """

    HALVINGS = 32

    def __init__(self, mass, damping, stiffness, load, gap, frequency, points=1024):
        n = len(mass) - 1
        self.n, self.gap, self.points = n, gap, points
        force = np.zeros(2 * n + 3)
        force[:n], force[n : 2 * n] = -stiffness[n, :n], -damping[n, :n]
        force[2 * n], force[-2] = -stiffness[n, n], load
        inner = np.zeros((n, 2 * n + 3))
        inner[:, :n], inner[:, n : 2 * n], inner[:, 2 * n] = -stiffness[:n, :n], -damping[:n, :n], -stiffness[:n, n]
        fastest = math.sqrt(np.linalg.norm(np.linalg.solve(mass[:n, :n], stiffness[:n, :n])))
        self.steps = []
        for tip in (force / damping[n, n], np.zeros(2 * n + 3)):
            rate = np.zeros((2 * n + 3, 2 * n + 3))
            rate[:n, n : 2 * n] = np.eye(n)
            rate[n : 2 * n] = np.linalg.solve(mass[:n, :n], inner - np.outer(damping[:n, n], tip))
            rate[2 * n] = tip
            rate[n : 2 * n] /= fastest
            rate[:, n : 2 * n] *= fastest
            rate /= frequency
            rate[-2, -1], rate[-1, -2] = -2.0 * math.pi, 2.0 * math.pi
            self.steps.append([expm(rate * 2.0**-h / points) for h in range(self.HALVINGS + 1)])
        self.force = force
        self.force[n : 2 * n] *= fastest

    def _leaves(self, state, closed):
        return self.force @ state < 0.0 if closed else state[2 * self.n] > self.gap

    def _sample(self, state, closed):
        """One sample ahead, through any number of switches, found by bisection to 2^-32 of it."""
        done, whole = 0, 2**self.HALVINGS
        while done < whole:
            for h in range(self.HALVINGS + 1):
                if done + (whole >> h) > whole:
                    continue
                ahead = self.steps[closed][h] @ state
                leaves = self._leaves(ahead, closed)
                if leaves and h < self.HALVINGS:
                    continue
                state, done = ahead, done + (whole >> h)
                if leaves:
                    closed = 1 - closed
                    if closed:
                        state[2 * self.n] = self.gap
                    break
        return state, closed

    def displacement(self, tolerance=1e-11, most_periods=1000):
        """Of the tip, at uniform instants of the period; periods are run from rest until the state repeats."""
        state, closed, found = np.eye(2 * self.n + 3)[-2], 0, np.empty(self.points)
        for _ in range(most_periods):
            before = state
            for i in range(self.points):
                found[i] = state[2 * self.n]
                state, closed = self._sample(state, closed)
            state[-2:] = 1.0, 0.0
            if np.linalg.norm(state - before) <= tolerance * np.linalg.norm(state):
                return found
        raise AssertionError("the structure does not settle")

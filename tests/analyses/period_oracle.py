"""Periodic motions of a tip without mass at a rigid obstacle by matrix exponentials, without any time basis."""

import math

import numpy as np
from scipy.linalg import expm


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
        """Motion of the tip at uniform instants of the period; periods are run from rest until the state repeats."""
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

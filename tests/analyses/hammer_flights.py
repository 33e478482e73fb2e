"""An oscillator that strikes a rigid stop, by exact flights from impact to impact: u'' + 2 z w0 u' + w0^2 u = -a cos(w t), u <= gap."""

import numpy as np
from scipy.optimize import brentq

MASS, OWN, RATIO, GAP, REBOUND = 0.05, 20.0, 0.02, 2e-3, 0.7  # kg, Hz, m
LOAD = 12.0  # Hz
STRUCTURE = f"""
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
contact_dofs = [1]
modal_damping = {RATIO}
[contact]
law = "rigid"
restitution = {REBOUND}
gap = {GAP}
[forcing]
frequency = {LOAD}
[[forcing.terms]]
kind = "base_acceleration"
dofs = [1]
amplitude = 20.0
"""
STIFFNESS = MASS * (2.0 * np.pi * OWN) ** 2


class Hammer:
    """Its state at the beginning of a period of the load, from rest on; `amplitude` in m/s^2."""

    def __init__(self, amplitude, displacement=0.0, velocity=0.0):
        self.u, self.v = displacement, velocity
        self.w0, self.w = 2.0 * np.pi * OWN, 2.0 * np.pi * LOAD
        self.decay, self.wd = RATIO * self.w0, self.w0 * np.sqrt(1.0 - RATIO**2)
        self.response = -amplitude / (self.w0**2 - self.w**2 + 2j * self.decay * self.w)
        self.period = 1.0 / LOAD

    def _flight(self, begin, u, v):
        """Displacement and velocity a time after the beginning of a flight."""
        wave = lambda t: self.response * np.exp(1j * self.w * t)
        a = u - wave(begin).real
        b = (v - (1j * self.w * wave(begin)).real + self.decay * a) / self.wd

        def displacement(s):
            own = np.exp(-self.decay * s) * (a * np.cos(self.wd * s) + b * np.sin(self.wd * s))
            return own + wave(begin + s).real

        def velocity(s):
            cosine, sine = np.cos(self.wd * s), np.sin(self.wd * s)
            own = np.exp(-self.decay * s) * (-self.decay * (a * cosine + b * sine) + self.wd * (b * cosine - a * sine))
            return own + (1j * self.w * wave(begin + s)).real

        return displacement, velocity

    def period_on(self, samples=0):
        """Goes on by a period; the speeds of its impacts, and the displacement at uniform times."""
        begin, speeds, values = 0.0, [], []
        times = self.period * np.arange(samples) / max(1, samples)
        while begin < self.period:
            displacement, velocity = self._flight(begin, self.u, self.v)
            left = self.period - begin
            grid = np.linspace(1e-9, left, 200)
            path = displacement(grid)
            hits = np.nonzero((path[:-1] < GAP) & (path[1:] >= GAP))[0]
            last = brentq(lambda s: displacement(s) - GAP, grid[hits[0]], grid[hits[0] + 1], xtol=1e-16) if len(hits) else left
            inside = times[(times >= begin) & (times < begin + last)]
            values.extend(displacement(inside - begin))
            self.u, self.v = float(displacement(last)), float(velocity(last))
            if len(hits):
                speeds.append(self.v)
                self.u, self.v = GAP, -REBOUND * self.v
            begin += last
        return speeds, np.array(values)

    def section(self, transient, points):
        for _ in range(transient):
            self.period_on()
        found = []
        for _ in range(points):
            found.append((self.u, self.v))
            self.period_on()
        return np.array(found)


def mean_with_error(values, batches=40):
    """The mean, and twice its standard error by batches."""
    length = len(values) // batches
    means = np.asarray(values)[: batches * length].reshape(batches, length).mean(axis=1)
    return means.mean(), 2.0 * means.std(ddof=1) / np.sqrt(batches)

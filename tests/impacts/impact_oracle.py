"""Motions that have given impacts, by matrix exponentials of the whole structure, which share nothing with the package."""

import math
from collections import namedtuple

import numpy as np
from scipy.linalg import expm

Strike = namedtuple("Strike", "contact time velocity impulse")  # s, m/s, N s


def strikes_of(impacts, period):
    """Impacts from the columns of impacts.csv, for a motion with this period."""
    return [Strike(int(c) - 1, t * period, v, p) for c, t, v, p in zip(
        impacts["contact"], impacts["time_fraction"], impacts["velocity_before_m_per_s"], impacts["impulse_Ns"])]


class ImpactOracle:
    """State: displacements and velocities."""

    def __init__(self, structure):
        self.structure, n = structure, len(structure.mass)
        self.n, self.inverse = n, np.linalg.inv(structure.mass)
        self.rates = np.block([[np.zeros((n, n)), np.eye(n)],
                               [-self.inverse @ structure.stiffness, -self.inverse @ structure.damping]])
        self.impulses = np.vstack([np.zeros((n, len(structure.contacts))), self.inverse @ structure.contacts.T])
        self.rows = np.hstack([structure.contacts, np.zeros_like(structure.contacts)])
        self.speeds = np.roll(self.rows, n, axis=1)
        self.amplitudes = structure.free_amplitudes()
        self.load_period = 2.0 * math.pi / structure.omega

    def free(self, times):
        """The state without contact, a column an instant."""
        phase = np.exp(1j * self.structure.omega * np.atleast_1d(times))
        return np.vstack([np.outer(self.amplitudes, phase).real,
                          np.outer(1j * self.structure.omega * self.amplitudes, phase).real])

    def periodic(self, strikes, periods, times):
        """States at instants of the motion that repeats after `periods` of the load and has these impacts."""
        whole, size = periods * self.load_period, 2 * self.n
        once = np.linalg.inv(np.eye(size) - expm(whole * self.rates))
        states = self.free(times)
        for strike in strikes:
            blow = strike.impulse * once @ self.impulses[:, strike.contact]
            for k, since in enumerate((np.atleast_1d(times) - strike.time) % whole):
                states[:, k] -= expm(since * self.rates) @ blow
        return states

    def multipliers(self, strikes, periods):
        """Multipliers of a periodic motion with these impacts: exponentials, and the saltation of each impact."""
        whole, size = periods * self.load_period, 2 * self.n
        monodromy, e, rate = np.eye(size), self.structure.restitution, self.structure.omega
        after = np.roll([strike.time for strike in strikes], -1)
        for k, strike in enumerate(strikes):
            c, row, speed = strike.contact, self.rows[strike.contact], self.speeds[strike.contact]
            just = self.periodic(strikes, periods, strike.time)[:, 0]  # behind the impact
            blow = self.impulses[:, c]
            before = just + strike.impulse * blow
            jump = np.eye(size) - (1.0 + e) * np.outer(blow, speed) / (speed @ blow)
            pull = np.r_[np.zeros(self.n), self.inverse[:, self.structure.loaded] * math.cos(rate * strike.time)]
            came, goes = self.rates @ before + pull, self.rates @ just + pull
            saltation = jump + np.outer(goes - jump @ came, row) / (speed @ before)
            flight = (after[k] - strike.time) % whole or whole
            monodromy = expm(flight * self.rates) @ saltation @ monodromy
        if not strikes:
            monodromy = expm(whole * self.rates)
        return np.linalg.eigvals(monodromy)

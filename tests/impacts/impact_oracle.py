"""Motions with impacts by matrix exponentials of the whole structure, which share nothing with the package.

An impact is where a contact that was below its gap is above it, looked for on a fixed grid of instants.
"""

import math
from collections import namedtuple

import numpy as np
from scipy.linalg import expm

Strike = namedtuple("Strike", "contact time velocity impulse")  # s, m/s, N s


def strikes_of(impacts, period):
    """Of the columns of impacts.csv, of a motion with this period."""
    return [Strike(int(c) - 1, t * period, v, p) for c, t, v, p in zip(
        impacts["contact"], impacts["time_fraction"], impacts["velocity_before_m_per_s"], impacts["impulse_Ns"])]


class ImpactOracle:
    """State: displacements and velocities. `own` is what is left of it without the motion that has no contact."""

    BLOCK = 1000

    def __init__(self, structure, steps=8000):
        self.structure, n = structure, len(structure.mass)
        self.n, self.inverse = n, np.linalg.inv(structure.mass)
        self.rates = np.block([[np.zeros((n, n)), np.eye(n)],
                               [-self.inverse @ structure.stiffness, -self.inverse @ structure.damping]])
        self.impulses = np.vstack([np.zeros((n, len(structure.contacts))), self.inverse @ structure.contacts.T])
        self.rows = np.hstack([structure.contacts, np.zeros_like(structure.contacts)])
        self.speeds = np.roll(self.rows, n, axis=1)
        self.amplitudes = structure.free_amplitudes()
        self.load_period = 2.0 * math.pi / structure.omega
        self.step = self.load_period / steps
        by_step, ahead = expm(self.step * self.rates), [self.rows]
        for _ in range(self.BLOCK):
            ahead.append(ahead[-1] @ by_step)
        self.ahead = np.array(ahead[1:])  # displacements at the contacts after 1, 2, ... steps

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

    def advance(self, state, time, until):
        """The state at `until`, and the impacts on the way."""
        own, strikes = state - self.free(time)[:, 0], []
        while until - time > 1e-14 * self.load_period:
            hit = self.next_hit(own, time)
            if hit is None or time + hit[0] > until:
                length = min(self.BLOCK * self.step, until - time)
                own, time = expm(length * self.rates) @ own, time + length
                continue
            after, c = hit
            own, time = expm(after * self.rates) @ own, time + after
            speed = self.speeds[c] @ (own + self.free(time)[:, 0])
            if speed > 0.0:
                impulse = (1.0 + self.structure.restitution) * speed / (self.speeds[c] @ self.impulses[:, c])
                own = own - impulse * self.impulses[:, c]
                strikes.append(Strike(c, time, speed, impulse))
        return own + self.free(until)[:, 0], strikes

    def next_hit(self, own, time):
        """Time to the first impact of the next block of steps and its contact, or None."""
        times = time + self.step * np.arange(1, self.BLOCK + 1)
        above = (self.ahead @ own).T + self.rows @ self.free(times) - self.structure.gaps[:, None]
        hits = np.argwhere(above.T > 0.0)
        if len(hits) == 0:
            return None
        k = hits[0][0]
        return min((self.crossing(own, time, k * self.step, (k + 1) * self.step, c), c)
                   for c in np.flatnonzero(above[:, k] > 0.0))

    def crossing(self, own, time, low, high, c):
        for _ in range(60):
            middle = 0.5 * (low + high)
            place = self.rows[c] @ (expm(middle * self.rates) @ own + self.free(time + middle)[:, 0])
            low, high = (low, middle) if place > self.structure.gaps[c] else (middle, high)
        return low if low > 0.0 else high

    def multipliers(self, strikes, periods):
        """Of a periodic motion with these impacts: exponentials, and the saltation of each impact."""
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

    def growth_by_differences(self, state, period, change=1e-6):
        """The largest modulus of the multipliers by differences of motions in time."""
        columns = [self.advance(state + step, 0.0, period)[0] - self.advance(state - step, 0.0, period)[0]
                   for step in change * np.eye(len(state))]
        return np.abs(np.linalg.eigvals(np.array(columns).T / (2.0 * change))).max()

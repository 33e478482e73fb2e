"""Chains on supports or between stops, over a range of frequencies about a resonance."""

import numpy as np
import wavebalance as wb
from scipy.linalg import eigh
from standard_random import StandardRandom


def chain(random, size):
    """Mass and stiffness of a chain that is clamped at its beginning."""
    mass, stiffness = np.zeros((size, size)), np.zeros((size, size))
    for i in range(size):
        spring = random.uniform(0.5, 2.0)
        stiffness[i, i] += spring
        mass[i, i] = random.uniform(0.5, 2.0)
        if i > 0:
            stiffness[i - 1, i - 1] += spring
            stiffness[i, i - 1] = stiffness[i - 1, i] = -spring
            mass[i, i - 1] = mass[i - 1, i] = 0.1 * random.uniform(0.5, 2.0)
    for _ in range(size):
        random.uniform()  # of a load that is not used
    return mass, stiffness


class RandomCurve:
    """Static loads are none, two or twenty times the vibrating one, stops 10 to 1000 times as stiff as the chain."""

    def __init__(self, seed):
        random = StandardRandom(9001 + seed)
        any = random.uniform
        size = 1 + int(4.0 * any())
        contacts = 1 + (size > 1 and any() < 0.4)
        ratio = 10.0 ** (-2.3 + 1.2 * any())
        mass, stiffness = chain(random, size)
        squares, shapes = eigh(stiffness, mass)
        damping = mass @ shapes @ np.diag(2.0 * ratio * np.sqrt(squares)) @ shapes.T @ mass
        mode = 0 if any() < 0.7 else min(1, size - 1)
        omega = np.sqrt(squares[mode])
        load = np.eye(size)[int(any() * size)]
        rows = np.eye(size)[[(size - 1 + c) % size for c in range(contacts)]]
        rows *= np.array([[-1.0 if any() < 0.5 else 1.0] for _ in range(contacts)])
        share = (0.0, 2.0, 20.0)[int(3.0 * any())]
        weight = share * (1.0 if any() < 0.5 else -1.0) * load
        at_rest = rows @ np.linalg.solve(stiffness, weight)
        self.laws = []
        for row, rest in zip(rows, at_rest):
            resonant = abs(row @ shapes[:, mode]) * abs(shapes[:, mode] @ load) / (2.0 * ratio * omega**2)
            stiff = 10.0 ** (1.0 + 2.0 * any()) / (row @ np.linalg.solve(stiffness, row))
            on_support = share > 0.0 and any() < 0.5
            self.laws.append(wb.Linear(stiff, 0.0 if on_support else rest + resonant * (0.1 + 0.8 * any())))
        ends = [(0.35 + 0.45 * any()) * omega, (1.2 + any()) * omega]
        if any() < 0.3:
            ends.reverse()
        self.begin, self.end = (end / (2.0 * np.pi) for end in ends)
        self.structure = wb.Structure(mass, damping, stiffness, load, rows, static_load=weight if share > 0.0 else None)

    def run(self, points, **analysis):
        """The record of a sweep, whose balance has 63 functions."""
        return wb.run(self.structure.scene(self.laws, pair=wb.Pair("fourier", 63, points), type="frequency_sweep",
                                           frequency_from=self.begin, frequency_to=self.end, **analysis))

    def exact(self, share_of_steps):
        """The curve of the structure itself."""
        interval = abs(self.end - self.begin)
        return self.run(512, exact=True, stability=False, first_step=share_of_steps * interval / 1000.0,
                        largest_step=share_of_steps * interval / 100.0, max_points=int(1500.0 / share_of_steps))

"""A cantilever with a crack that is stiff where it is closed: a mode of the closed crack lies 1e4 times above the load."""

import numpy as np
import scipy.linalg as la
from scipy.io import mmwrite
from scipy.optimize import brentq

CLOSED, OPEN, DAMPING = 2e5, 4e3, 0.005  # N m, N m, modal damping ratio


def beam():
    """Mass and stiffness of 12 elements, with separate rotations left and right of the crack; these two, and the
    tip."""
    modulus, density, width, height, length, count, cracked = 2.1e11, 7850.0, 0.025, 0.01, 0.6, 12, 4
    inertia, area, h = width * height**3 / 12, width * height, length / count
    bent = np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h]])
    k = modulus * inertia / h**3 * np.vstack([bent, [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]])
    m = np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h]])
    m = density * area * h / 420 * np.vstack([m, [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]])
    size = 2 * count + 3
    mass, stiffness = np.zeros((size, size)), np.zeros((size, size))
    for element in range(count):
        dofs = np.arange(2 * element, 2 * element + 4)
        if element == cracked:
            dofs[1] = size - 1
        mass[np.ix_(dofs, dofs)] += m
        stiffness[np.ix_(dofs, dofs)] += k
    across = np.zeros(size)
    across[2 * cracked + 1], across[-1] = 1.0, -1.0
    stiffness += OPEN * np.outer(across, across)
    return mass[2:, 2:], stiffness[2:, 2:], across[2:], 2 * count - 2


SCENE = """
[structure]
type = "matrices"
mass = "m.mtx"
stiffness = "k.mtx"
modal_damping = 0.005
[[contact.pairs]]
dofs = [{left}, {right}]
[contact]
law = "linear"
stiffness = 2e5
gap = 0.0
[forcing]
load_dofs = [{tip}]
amplitude = 1.0
[time]
trial = "fourier"
weight = "fourier"
functions = 63
quadrature_points = 512
[analysis]
type = "frequency_sweep"
frequency_from = 14.45
frequency_to = 14.9
"""


class Crack:
    """The motion from near rest, from one opening or closing of the crack to the next, by the modes of either state."""

    def __init__(self, frequency):
        mass, stiffness, across, tip = beam()
        squares, shapes = la.eigh(stiffness, mass)
        n = len(squares)
        self.omega, self.across = 2 * np.pi * frequency, np.r_[shapes.T @ across, np.zeros(n)]
        free = np.block([[np.zeros((n, n)), np.eye(n)], [-np.diag(squares), -np.diag(2 * DAMPING * np.sqrt(squares))]])
        held = free.copy()
        held[n:, :n] -= CLOSED * np.outer(self.across[:n], self.across[:n])
        load = np.r_[np.zeros(n), shapes[tip]]
        self.modes = [self.state(matrix, load) for matrix in (free, held)]
        self.size = 2 * n

    def state(self, matrix, load):
        values, vectors = np.linalg.eig(matrix)
        forced = np.linalg.solve(1j * self.omega * np.eye(len(load)) - matrix, load.astype(complex))
        return values, vectors, np.linalg.inv(vectors), forced

    def period(self, z):
        """The state a period later."""
        time, end = 0.0, 2 * np.pi / self.omega
        closed = self.across @ z > 0.0
        looks = np.r_[np.arange(1, 200) * 3e-7, np.geomspace(6e-5, end, 800)]  # s
        while True:
            values, vectors, inverse, forced = self.modes[int(closed)]
            own = inverse @ (z - (forced * np.exp(1j * self.omega * time)).real)
            weights, wave = self.across @ vectors * own, self.across @ forced

            def gap(since):
                return float((weights @ np.exp(values * since)).real + (wave * np.exp(1j * self.omega * (time + since))).real)

            looked = looks[looks < end - time]
            apart = (weights @ np.exp(np.outer(values, looked))).real + (wave * np.exp(1j * self.omega * (time + looked))).real
            changed = np.flatnonzero((apart > 0.0) != closed)
            if len(changed) == 0:
                since = end - time
            elif changed[0] == 0:  # it has opened or closed for less than that
                since = looked[0]
            else:
                since = brentq(gap, looked[changed[0] - 1], looked[changed[0]], xtol=1e-16)
            z = (vectors @ (own * np.exp(values * since)) + forced * np.exp(1j * self.omega * (time + since))).real
            time += since
            if len(changed) == 0:
                return z
            closed = not closed


def returns_after_a_period(frequency, periods=70):
    """By how much the state of the motion from rest changes in its last period."""
    crack = Crack(frequency)
    z = -1e-9 * crack.across  # open
    for _ in range(periods):
        before, z = z, crack.period(z)
    n = crack.size // 2
    return np.linalg.norm((z - before)[:n]) / np.linalg.norm(z[:n])


def test_a_stiff_crack_doubles_its_period_where_the_motion_from_rest_does(run, tmp_path):
    mass, stiffness, across, tip = beam()
    mmwrite(tmp_path / "m.mtx", mass)
    mmwrite(tmp_path / "k.mtx", stiffness)
    left, right = np.flatnonzero(across > 0)[0] + 1, np.flatnonzero(across < 0)[0] + 1
    record = run(SCENE.format(left=left, right=right, tip=tip + 1))
    points = np.genfromtxt(record.folder / "sweep.csv", delimiter=",", names=True)
    unstable = points["unstable"]
    assert set(unstable) == {0, 1}, "the stability of all points is known"
    doubled = points["frequency_Hz"][unstable == 1]
    assert np.all((doubled > 14.52) & (doubled < 14.82))
    # 5 % more or less in each period; 4 % of the transient are left.
    assert returns_after_a_period(0.5 * (doubled.min() + doubled.max())) > 0.5
    assert returns_after_a_period(14.47) < 0.1

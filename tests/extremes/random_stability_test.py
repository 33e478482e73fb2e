"""Counts of unstable multipliers of random responses against stops, compared with matrix exponentials."""

import functools

import numpy as np
import scipy.linalg
import scipy.optimize
from edge_bases import FourierPair
from edge_draw import Draw, campaign_seeds
from random_chains import random_structure

import wavebalance as wb

# Both counts belong to a motion of so many harmonics. With 31 of them, one in 500 differs from the exact one.
HARMONICS, POINTS = 63, 512
INSTANTS = 4096  # at which contact is looked for


def free_motion(drawn):
    """The contacts' displacements without contact, contacts x points."""
    pair, structure = FourierPair(2 * HARMONICS + 1, POINTS), drawn.structure
    motion = np.zeros((len(structure.load), HARMONICS + 1), complex)
    dynamic = structure.dynamic(pair, drawn.frequency, 1).toarray()
    motion[:, 1] = np.linalg.solve(dynamic, structure.load * pair.load()[1])
    return pair.evaluate(structure.directions @ motion)


def draw_stops(seed, drawn, free):
    """Stiffnesses of 0.3 to 10 times the static one, and gaps in the way of the free motion."""
    draw = Draw(seed + 2000000)
    flexibility = np.diag(np.linalg.inv(drawn.structure.stiffness.toarray()))[drawn.contacts]
    gaps = [draw.uniform(0.3, 1.1) * row.max() for row in free]
    return [draw.magnitude(-0.5, 1.0) / each for each in flexibility], gaps


ORDERS = 2j * np.pi * np.arange(HARMONICS + 1)


def depth(time, series, gap):
    return (series @ np.exp(ORDERS * time)).real - gap


def switches(displacement, series, gap):
    """The instants, fractions of the period, at which a motion of few harmonics reaches or leaves a gap."""
    closed = np.append(displacement, displacement[0]) > gap
    width = 1.0 / len(displacement)
    places = np.flatnonzero(closed[1:] != closed[:-1]) * width
    return [scipy.optimize.brentq(depth, place, place + width, (series, gap), xtol=1e-14) for place in places]


class Flow:
    """The structure in states v = (w, w') with w = L^T u, M = L L^T."""

    def __init__(self, structure, stops):
        lower = np.linalg.cholesky(structure.mass.toarray())
        self.stiffness = self.scaled(lower, structure.stiffness.toarray())
        self.damping = self.scaled(lower, structure.damping.toarray())
        self.directions = scipy.linalg.solve_triangular(lower, structure.directions.toarray().T, lower=True)
        self.stops = np.array(stops)

    @staticmethod
    def scaled(lower, matrix):
        half = scipy.linalg.solve_triangular(lower, matrix, lower=True)
        return scipy.linalg.solve_triangular(lower, half.T, lower=True)

    @functools.cache
    def generator(self, closed):
        pressed = self.directions @ np.diag(self.stops * np.array(closed)) @ self.directions.T
        size = len(self.stiffness)
        return np.block([[np.zeros((size, size)), np.eye(size)], [-self.stiffness - pressed, -self.damping]])

    def multipliers(self, displacement, gaps, frequency):
        """Eigenvalues of the product of the exponentials between the switches."""
        series = wb.harmonics_of(displacement, HARMONICS)
        rows = list(zip(displacement, series, gaps))
        times = sorted({0.0, 1.0, *(time for row in rows for time in switches(*row))})
        product = np.eye(2 * len(self.stiffness))
        for begin, end in zip(times, times[1:]):
            closed = tuple(depth(0.5 * (begin + end), row, gap) > 0.0 for row, gap in zip(series, gaps))
            product = scipy.linalg.expm(self.generator(closed) * ((end - begin) / frequency)) @ product
        return np.linalg.eigvals(product)


def compared(seed):
    """The counts of the package and of the exponentials, and the largest modulus; or why they are not compared."""
    drawn = random_structure(seed)
    stops, gaps = draw_stops(seed, drawn, free_motion(drawn))
    laws = [wb.Penalty(stop, gap) for stop, gap in zip(stops, gaps)]
    response = wb.forced_response(drawn.package(), laws, drawn.frequency, wb.Pair("fourier", 2 * HARMONICS + 1, POINTS),
                                  stay_near_guess=True)
    if not response.converged:
        return "not drawn"
    stability = response.stability()
    displacement = response.motion(INSTANTS).displacement
    moduli = np.abs(Flow(drawn.structure, stops).multipliers(displacement, gaps, drawn.frequency))
    if stability.status != "converged" or not np.isfinite(moduli).all():
        return "unknown"
    if (abs(moduli - 1.0) <= 0.01).any():
        return "near the circle"
    return stability.unstable, int((moduli > 1.0).sum()), moduli.max()


def test_counts_of_unstable_multipliers_of_random_responses_are_those_of_matrix_exponentials():
    seeds = campaign_seeds(60, 2000)
    found = {seed: compared(seed) for seed in seeds}
    counts = {seed: one for seed, one in found.items() if isinstance(one, tuple)}
    unstable = sum(one[1] > 0 for one in counts.values())
    others = {kind: list(found.values()).count(kind) for kind in ("not drawn", "near the circle", "unknown")}
    print(f"{len(seeds)} structures, {len(counts)} compared ({unstable} unstable), {others}")
    assert not {seed: one for seed, one in counts.items() if one[0] != one[1]}
    assert len(counts) >= len(seeds) // 3

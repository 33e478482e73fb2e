"""Stability along curves with friction of structures with more states than a map of all modes supports."""

import numpy as np
import pytest
from scipy.linalg import eigh

import wavebalance as wb

ELEMENTS = 30
CONTACTS = [18, 38, 58]  # deflections of a cantilever beam, counted from 0


def beam():
    """Mass and stiffness of a cantilever of length, mass and flexural stiffness 1: deflection and slope of each node."""
    h, n = 1.0 / ELEMENTS, 2 * ELEMENTS + 2
    mass, stiffness = np.zeros((n, n)), np.zeros((n, n))
    for e in range(ELEMENTS):
        own = slice(2 * e, 2 * e + 4)
        stiffness[own, own] += np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                                         [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]]) / h**3  # fmt: skip
        mass[own, own] += np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
                                    [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]]) * h / 420  # fmt: skip
    return mass[2:, 2:], stiffness[2:, 2:]


def counts(basis, mass, damping, stiffness, frequencies):
    """The counts of unstable multipliers along the sweep of the structure in these shapes."""
    rows = list(range(1, basis.shape[1] + 1))
    pairs = [{"dofs": rows, "coefficients": list(basis[contact])} for contact in CONTACTS]
    structure = {"type": "matrices", "mass": basis.T @ mass @ basis, "damping": basis.T @ damping @ basis, "stiffness": basis.T @ stiffness @ basis}
    contact = {"law": "coulomb", "friction": 0.5, "normal_load": 1.0, "tangential_stiffness": 20.0, "pairs": pairs}
    record = wb.run({
        "structure": structure, "contact": contact,
        "forcing": {"load_dofs": rows, "load_coefficients": list(basis[58]), "amplitude": 1.0, "frequency": frequencies[0]},
        "time": {"trial": "fourier", "weight": "fourier", "functions": 31, "quadrature_points": 256},
        "analysis": {"type": "frequency_sweep", "frequency_from": frequencies[0], "frequency_to": frequencies[1], "stability": True, "special_points": False},
    })  # fmt: skip
    return np.asarray(record.sweep["unstable"])


# Negative damping of the slow modes, which the fast ones do not have, makes motions unstable that slip long.
@pytest.mark.parametrize("gain", [0.1, 0.3])
def test_counts_are_those_of_all_modes_of_a_smaller_structure_with_the_same_slow_modes(gain):
    mass, stiffness = beam()
    squares, shapes = eigh(stiffness, mass)
    damping = 0.04 / np.sqrt(squares[2]) * stiffness - gain * mass
    frequencies = np.sqrt(squares[0]) / (2.0 * np.pi) * np.array([0.7, 1.5])
    statics = np.linalg.solve(stiffness, np.eye(len(mass))[:, CONTACTS])
    few, _ = np.linalg.qr(np.column_stack([shapes[:, :8], statics]))
    reference = counts(few, mass, damping, stiffness, frequencies)
    found = counts(np.eye(len(mass)), mass, damping, stiffness, frequencies)
    assert len(found) == len(reference) and not np.isnan(reference).any()
    known = ~np.isnan(found)
    assert np.count_nonzero(~known) <= 3  # near the circle
    assert np.array_equal(found[known], reference[known])
    assert set(reference) >= {0.0, 1.0, 2.0}

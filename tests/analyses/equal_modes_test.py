"""Modes of equal frequency, as a round pipe has them in pairs."""

import numpy as np
import pytest
import scipy.io
import wavebalance as wb
from rods_and_bars import warns

MASS = 2.0 * np.eye(3)
TOWARDS = np.array([0.6, 0.8, 0.0])


def round_mass(apart, **analysis):
    """A mass of 2 kg on springs along x and y, equal but for `apart`, against a stop; and a third mass."""
    return {
        "structure": {"type": "matrices", "mass": MASS, "stiffness": np.diag([1e6, 1e6 * (1.0 + apart), 9e6])},
        "contact": {"law": "linear", "stiffness": 1e7, "gap": 1e-4,
                    "pairs": [{"dofs": [1, 2], "coefficients": [0.6, 0.8]}]},
        "time": {"trial": "fourier", "weight": "fourier", "functions": 31},
        "analysis": {"type": "nonlinear_mode", **analysis},
    }


def shapes_of(apart, folder):
    """The first two linear modes from their motions below contact, mass-normalised, as columns."""
    columns = []
    for mode in (1, 2):
        output = folder / f"mode{mode}"
        record = wb.run(round_mass(apart, mode=mode, energy_ratio=0.25, motion_points=32), output=output)
        assert record.status == "linear"
        motion = np.asarray(scipy.io.mmread(output / "motion.mtx"))[:, 0]
        columns.append(motion / np.sqrt(motion @ MASS @ motion))
    return np.array(columns).T


def test_equal_modes_are_one_towards_the_stop_and_one_that_never_touches(tmp_path):
    shapes = shapes_of(1e-8, tmp_path)
    assert abs(TOWARDS @ shapes[:, 0]) == pytest.approx(np.sqrt(0.5), abs=1e-6)
    assert TOWARDS @ shapes[:, 1] == pytest.approx(0.0, abs=1e-6)
    assert shapes.T @ MASS @ shapes == pytest.approx(np.eye(2), abs=1e-10)
    with pytest.raises(ValueError, match="mode 3 does not move any contact point"):  # of the third mass
        wb.run(round_mass(1e-8, mode=3, energy_ratio=0.25))


def test_modes_that_differ_are_kept(tmp_path):
    assert np.abs(TOWARDS @ shapes_of(1e-3, tmp_path)) == pytest.approx(np.sqrt(0.5) * TOWARDS[:2], abs=1e-9)


@pytest.mark.parametrize("apart, part, said", [
    (1e-8, "were combined so that the first one moves the contacts most", True),
    (1e-3, "the branches may interact", True),
    (0.5, "linear frequencies", False),
])
def test_a_curve_says_that_its_frequencies_are_equal_or_near(apart, part, said):
    assert warns(wb.run(round_mass(apart, largest_energy=1.2, points=20)), part) == said

"""Random bars to a tolerance against a far finer balance near the motion that was found."""

import numpy as np
import pytest
from bars_against_stops import HARMONICS, balance_nearby, random_bar

import wavebalance as wb

POINTS = 2048
FIRST_SEED = 20140817


def refined(seed, tolerance):
    scene = random_bar(seed)
    scene["time"] = {"trial": "fourier", "weight": "fourier", "tolerance": tolerance}
    scene["analysis"] = {"phases": False, "stability": False, "output_points": POINTS}
    record = wb.run(scene)
    assert record.converged, record.status
    return scene, record


def distance(found, exact):
    return np.linalg.norm(found - exact) / np.linalg.norm(exact)


# `make bench` uses 200 motions, and 1e-6; there the largest true error is 1.8 times the tolerance, because the
# estimate is no bound.
CASES = [(seed, tolerance) for seed in range(FIRST_SEED, FIRST_SEED + 20) for tolerance in (1e-2, 1e-4)]
# The true errors of 1000 seeds once were 6.4, 5.0 and 3.3 times the tolerance: one or two of 64 points touched, near
# the maximum; and 5.8 times: a contact shorter than the highest harmonic of 63 functions. At seed 283 Newton's method
# once stalled from the harmonics of the previous level, which oscillate between samples in contact.
CASES += [(19, 1e-4), (198, 1e-4), (246, 1e-4), (704, 1e-4), (283, 1e-3)]


@pytest.mark.parametrize("seed, tolerance", CASES)
def test_a_random_bar_meets_its_tolerance(seed, tolerance):
    scene, record = refined(seed, tolerance)
    found = record.response["displacement_m"]
    coarse = balance_nearby(scene, found, HARMONICS // 2)
    assert coarse is not None, "no periodic motion near the one found"
    exact = balance_nearby(scene, coarse)
    assert distance(coarse, exact) <= 0.2 * tolerance  # the error of the finer one is below that
    assert distance(found, exact) <= tolerance, record.summary["estimated_error"]


def test_a_stiff_stop_in_long_contact_is_followed_from_level_to_level():
    # The path from the contact-free response, which it once took, lasts seconds.
    phases = set()
    with wb.progress(lambda phase, *_: phases.add(phase)):
        _, record = refined(283, 1e-3)
    assert record.summary["strategy"] == "newton"
    assert not any("continuation" in phase for phase in phases)

"""Scenes with a tolerance compared with references without a time basis; the motions are from the benchmark."""

from pathlib import Path

import numpy as np
import pytest

import wavebalance as wb

SCENES = Path(__file__).resolve().parents[2] / "reproduce" / "scenes" / "tolerance"
POINTS = 2048
# README.md claims a true error of at most 0.34 times the tolerance for these motions.
LARGEST_SHARE = 0.4
# A name, a scene and what is changed in it.
MOTIONS = {
    "case1": ("case1", {}),
    "case2": ("case2", {}),
    "no_contact": ("case1", {"contact.gap": 5e-3}),
    "linear_soft": ("linear_stop", {}),
    "linear_stiff": ("linear_stop", {"contact.stiffness": 1e10}),
    "small_gap": ("case1", {"contact.gap": 1e-5}),
    "preload": ("case1", {"contact.gap": -3e-4}),
    "pressed_all_period": ("case1", {"contact.gap": -3e-3, "forcing.amplitude": 100e3}),
    "high_damping": ("case1", {"structure.stiffness_damping": 1e-3, "forcing.frequency": 600, "contact.gap": 2e-4}),
    "near_resonance": ("case2", {"structure.stiffness_damping": 2e-5, "forcing.frequency": 1300, "contact.gap": 5e-3}),
    "second_mode": ("case2", {"forcing.frequency": 3830, "contact.gap": 1e-3, "contact.exponent": 50}),
    "near_grazing": ("case1", {"contact.gap": 1.43e-3}),
    "millimetres": ("case1", {"structure.youngs_modulus": 70e3, "structure.density": 2.7e-9, "structure.area": 2500,
                              "structure.length": 1000, "contact.exponent": 0.05, "contact.gap": 1}),
    "hard_exponent": ("case1", {"contact.exponent": 2000, "contact.constant": 1e6}),
    "soft_exponent": ("case1", {"contact.exponent": 5}),
    "massless_tip": ("case1", {"structure.massless_tip": True}),
    "third_of_resonance": ("case1", {"forcing.frequency": 420}),
}
GRAZING = ("linear_stop", {"structure.stiffness_damping": 1.1725e-5, "forcing.frequency": 389.954,
                           "contact.gap": 1.52607e-3, "contact.stiffness": 6.11416e10})
ALONE = {"analysis.phases": False, "analysis.stability": False}


def solved(motion, changes, unset=()):
    """The record of a motion, whose tip is written at the points of all records here."""
    file, own = motion
    record = wb.run(SCENES / f"{file}.toml", {**own, "analysis.output_points": POINTS, **changes}, unset=unset)
    assert record.converged, record.status
    return record


def to_tolerance(motion, tolerance, changes=()):
    return solved(motion, {"time.tolerance": tolerance, **ALONE, **dict(changes)})


def reference(motion):
    """The tip of the exact solution, whose own error is below 1e-10; a tip without mass by 511 Fourier functions and eight
    times as many points."""
    if not motion[1].get("structure.massless_tip"):
        return solved(motion, {"time.method": "exact", "time.tolerance": 1e-11}).response["displacement_m"]
    fine = {"trial": "fourier", "weight": "fourier", "functions": 511, "quadrature_points": 4096}
    changes = {**ALONE, **{f"time.{key}": value for key, value in fine.items()}}
    return solved(motion, changes, unset=["time.tolerance"]).response["displacement_m"]


def relative_error(record, exact):
    return np.linalg.norm(record.response["displacement_m"] - exact) / np.linalg.norm(exact)


# The finer tolerances are for `make bench`, where the cost is measured too.
@pytest.mark.parametrize("name", MOTIONS)
def test_a_tolerance_is_met_by_the_true_error_which_the_estimate_exceeds(name):
    exact = reference(MOTIONS[name])
    for tolerance in (1e-1, 1e-2, 1e-3, 1e-4):
        record = to_tolerance(MOTIONS[name], tolerance)
        estimate, error = record.summary["estimated_error"], relative_error(record, exact)
        assert estimate <= tolerance
        assert error <= LARGEST_SHARE * tolerance, f"estimated {estimate}"
        # The reference of the motion without shooting is good to 4e-6.
        assert error <= estimate + 5e-6, f"at tolerance {tolerance}"


def test_a_tolerance_is_met_where_one_or_two_points_of_the_first_problems_touch():
    exact = reference(GRAZING)
    for tolerance in (1e-2, 1e-3, 1e-4):
        assert relative_error(to_tolerance(GRAZING, tolerance), exact) <= tolerance


@pytest.mark.parametrize("trial, weight, tolerance", [
    ("bspline", "bspline", 1e-4), ("daubechies6", "daubechies6", 1e-3), ("haar", "fourier", 3e-2)])
def test_a_tolerance_is_met_with_a_pair_of_the_users_own(trial, weight, tolerance):
    record = to_tolerance(MOTIONS["case1"], tolerance, {"time.trial": trial, "time.weight": weight})
    assert record.summary["trial"] == trial
    assert relative_error(record, reference(MOTIONS["case1"])) <= tolerance

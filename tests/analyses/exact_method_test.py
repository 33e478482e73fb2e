"""time.method = "exact" beside time stepping and the balance."""

import numpy as np
import pytest
from solved_scenes import BALANCE_KEYS, BAR, CHAIN, SCENES, relative_rms_error, solved

import wavebalance

EXACT = {"time.method": "exact"}
PAIR = ("time.trial", "time.weight", "time.functions")  # of scenes with points by default
# The strip of the scenes with one contact and all its 72 modes. Time stepping would follow the fastest of the modes
# through its transient.
STRIP = {"structure.contact_dofs": [54], "contact.gap": 1e-3}


def strip(more, unset=()):
    return solved(SCENES / "matrices" / "strip_forced.toml", {**STRIP, **more}, ("analysis.motion_points", *unset))


def test_it_finds_the_motion_at_which_time_stepping_arrives():
    exact, stepped = solved(BAR, EXACT, BALANCE_KEYS), solved(BAR, {"analysis.type": "time_stepping"})
    assert exact.converged and stepped.converged, (exact.status, stepped.status)
    assert relative_rms_error(exact.response["displacement_m"], stepped.response["displacement_m"]) < 1e-4
    assert exact.summary["solved_by"] == "exact"


def test_it_has_the_multipliers_of_the_balance():
    exact, balance = solved(BAR, EXACT, BALANCE_KEYS), solved(BAR, {"time.functions": 255, "time.quadrature_points": 2048,
                                                        "analysis.phases": False})
    assert balance.converged, balance.status
    assert exact.summary["stability"] == balance.summary["stability"] == "stable"
    for part in ("leading_multiplier_real", "leading_multiplier_imag"):
        assert exact.summary[part] == pytest.approx(balance.summary[part], abs=1e-3)


def test_it_takes_matrices_without_reduction():
    exact, balance = strip(EXACT, PAIR), strip({"time.functions": 255, "time.quadrature_points": 1024})
    assert exact.converged and balance.converged, (exact.status, balance.status)
    assert exact.response["contact_force_N"].max() > 1.0
    assert relative_rms_error(balance.response["displacement_m"], exact.response["displacement_m"]) < 1e-3


def test_it_finds_an_unstable_motion():
    record = strip({**EXACT, "forcing.frequency": 80, "forcing.amplitude": 20}, PAIR)
    assert record.converged, record.status
    assert record.summary["residual"] < 1e-8 and record.summary["stability"] == "unstable"


def test_it_is_described_before_it_runs():
    text = wavebalance.check(BAR, EXACT, unset=BALANCE_KEYS)
    assert "exact periodic solution to a relative error of 1e-9" in text and "functions" not in text


@pytest.mark.parametrize("overrides, unset", [
    ({}, ()),
    ({"structure.damping": np.diag([50.0, 20.0, 5.0])}, ("structure.modal_damping",)),
    ({"contact.law": "kelvin_voigt", "contact.damping": 10.0}, ()),
], ids=["linear", "damping that couples the modes", "force of the velocity"])
def test_it_takes_several_contacts(overrides, unset):
    record = solved(CHAIN, {**EXACT, **overrides}, (*PAIR, *unset))
    assert record.converged, record.status
    assert len(record.contacts["contact"]) > 0

"""analysis.type = "shooting", another name for the method of phases, beside time stepping and the balance."""

import numpy as np
import pytest
from solved_scenes import BALANCE_KEYS, BAR, CHAIN, SCENES, relative_rms_error, solved

import wavebalance

SHOOTING = {"analysis.type": "shooting"}
# The strip of the scenes with one contact and all its 72 modes. Time stepping would follow the fastest of the modes
# through its transient.
STRIP = {"structure.contact_dofs": [54], "contact.gap": 1e-3}


def strip(**more):
    return solved(SCENES / "matrices" / "strip_forced.toml", {**STRIP, **more}, ("analysis.motion_points",))


def test_shooting_finds_the_motion_at_which_time_stepping_arrives():
    shot, stepped = solved(BAR, SHOOTING), solved(BAR, {"analysis.type": "time_stepping"})
    assert shot.converged and stepped.converged, (shot.status, stepped.status)
    assert relative_rms_error(shot.response["displacement_m"], stepped.response["displacement_m"]) < 1e-4
    assert shot.summary["analysis"] == "shooting"


def test_shooting_has_the_multipliers_of_the_balance():
    shot, balance = solved(BAR, SHOOTING), solved(BAR, {"time.functions": 255, "time.quadrature_points": 2048,
                                                        "analysis.phases": False})
    assert balance.converged, balance.status
    assert shot.summary["stability"] == balance.summary["stability"] == "stable"
    for part in ("leading_multiplier_real", "leading_multiplier_imag"):
        assert shot.summary[part] == pytest.approx(balance.summary[part], abs=1e-3)


def test_shooting_takes_matrices_without_reduction():
    shot, balance = strip(**SHOOTING), strip(**{"time.functions": 255, "time.quadrature_points": 1024})
    assert shot.converged and balance.converged, (shot.status, balance.status)
    assert shot.response["contact_force_N"].max() > 1.0
    assert relative_rms_error(balance.response["displacement_m"], shot.response["displacement_m"]) < 1e-3


def test_shooting_finds_an_unstable_motion():
    record = strip(**SHOOTING, **{"forcing.frequency": 80, "forcing.amplitude": 20})
    assert record.converged, record.status
    assert record.summary["residual"] < 1e-8 and record.summary["stability"] == "unstable"


def test_shooting_is_what_the_method_of_phases_finds():
    shot, phases = solved(BAR, SHOOTING), solved(BAR, {"time.method": "exact"}, BALANCE_KEYS)
    assert shot.converged and phases.converged
    np.testing.assert_array_equal(shot.response["displacement_m"], phases.response["displacement_m"])
    assert shot.summary["solved_by"] == "exact"


def test_shooting_is_described_before_it_runs():
    text = wavebalance.check(BAR, SHOOTING)
    assert "phases of contact to a relative error of 1e-9" in text and "functions" not in text


@pytest.mark.parametrize("overrides, unset", [
    ({}, ()),
    ({"structure.damping": np.diag([50.0, 20.0, 5.0])}, ("structure.modal_damping",)),
    ({"contact.law": "kelvin_voigt", "contact.damping": 10.0}, ()),
], ids=["linear", "damping that couples the modes", "force of the velocity"])
def test_shooting_takes_several_contacts(overrides, unset):
    record = solved(CHAIN, {**SHOOTING, **overrides}, unset)
    assert record.converged, record.status
    assert len(record.contacts["contact"]) > 0

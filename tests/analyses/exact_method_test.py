"""time.method = "exact" compared with time stepping and the balance."""

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
    assert "exact periodic solution to a relative error of 10⁻⁹" in text and "functions" not in text


@pytest.mark.parametrize("overrides, unset", [
    ({}, ()),
    ({"structure.damping": np.diag([50.0, 20.0, 5.0])}, ("structure.modal_damping",)),
    ({"contact.law": "kelvin_voigt", "contact.damping": 10.0}, ()),
], ids=["linear", "damping that couples the modes", "force of the velocity"])
def test_it_takes_several_contacts(overrides, unset):
    record = solved(CHAIN, {**EXACT, **overrides}, (*PAIR, *unset))
    assert record.converged, record.status
    assert len(record.contacts["contact"]) > 0


def test_a_table_of_many_points_has_all_its_motions_as_exact_as_rounding_lets_them(run, matrix, tmp_path):
    """The tip of a cantilever that taps on a sample, 2 N/m, 70 kHz, Q 150: attraction and Hertz as a table of 1801 points.

    By shooting with the law itself: 16.137770 and 14.769778 nm at most, multipliers 0.979. An unstable one is between.
    """
    stiffness, frequency, distance, contact = 2.0, 70e3, 15e-9, 0.165e-9
    mass = stiffness / (2 * np.pi * frequency) ** 2
    damping, load = np.sqrt(stiffness * mass) / 150, stiffness * 20e-9 / 150

    def force(u):
        gap = distance - u
        hertz = 4 / 3 * 1.3e9 * np.sqrt(10e-9) * np.maximum(contact - gap, 0.0) ** 1.5
        return hertz - 6.4e-20 * 10e-9 / 6 / np.maximum(gap, contact) ** 2

    rows = [np.linspace(-40e-9, 10e-9, 200), np.linspace(10e-9, 14.8e-9, 400), np.linspace(14.8e-9, 18e-9, 1200)]
    u = np.unique(np.concatenate([*rows, [distance - contact]]))
    np.savetxt(tmp_path / "sample.csv", np.c_[u, force(u)], delimiter=",", header="u_m,force_N", comments="", fmt="%.12e")
    record = run(f"""
[structure]
type = "matrices"
mass = "{matrix("m.mtx", [[mass]])}"
stiffness = "{matrix("k.mtx", [[stiffness]])}"
damping = "{matrix("c.mtx", [[damping]])}"
contact_dofs = [1]
[contact]
law = "table"
table = "sample.csv"
[forcing]
load_dofs = [1]
amplitude = {load}
frequency = {frequency}
[analysis]
type = "motions"
random_starts = 1
seed = 2
""")
    assert record.code == 0, record.text + record.errors
    stable = [one for one in record.summary["motions"] if one["stability"] == "stable"]
    largest = sorted(one["max_displacement_m"] for one in stable)
    assert largest == pytest.approx([14.769778e-9, 16.13777e-9], rel=1e-5, abs=0.0)
    for one in stable:
        assert np.hypot(one["leading_multiplier_real"], one["leading_multiplier_imag"]) == pytest.approx(0.979, abs=1e-3)
    assert len(record.summary["motions"]) == 3 and not record.summary.get("unsolved_motions")

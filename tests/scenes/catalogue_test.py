"""Every law of the catalogue in a balance, which evaluates it over samples, and from event to event, as a machine of states."""

import numpy as np
import pytest

import wavebalance as wb
from wavebalance import _core

MASS = np.diag([1.0, 0.5])
STIFFNESS = np.array([[40.0, -20.0], [-20.0, 30.0]])
BASES = {"trial": "fourier", "weight": "fourier", "functions": 255, "quadrature_points": 2048}

# Values of each row, in m, N and kg, with which the contact is felt.
LAWS = {
    "exponential": {"constant": 0.1, "exponent": 20.0, "gap": 0.02},
    "linear": {"stiffness": 60.0, "gap": 0.02},
    "bilinear": {"slopes": [5.0, 40.0], "gap": 0.02},
    "cubic": {"cubic_stiffness": 400.0},
    "polynomial": {"polynomial": [4.0, 10.0, 400.0]},
    "clearance": {"stiffness": 50.0, "gap": 0.02},
    "table": {"table": "spring.csv"},
    "hunt_crossley": {"hertz_stiffness": 200.0, "power": 1.5, "dissipation": 0.5, "gap": 0.02},
    "kelvin_voigt": {"stiffness": 50.0, "damping": 0.3, "damping_depth": 0.01, "gap": 0.02},
    "coulomb": {"friction": 0.4, "tangential_stiffness": 60.0, "normal_load": 1.0},
    "ring": {"stiffness": 60.0, "gap": 0.02, "friction": 0.1},
    "periodic_stiffness": {"stiffness": 50.0, "stiffness_harmonics": [10.0, 4.0], "gap": 0.02},
}


def solve(law, folder, analysis, time):
    (folder / "spring.csv").write_text("".join(f"{u!r},{20 * u + 300 * u**3!r}\n" for u in np.linspace(-1, 1, 41).tolist()))
    values = {key: str(folder / value) if key == "table" else value for key, value in LAWS[law].items()}
    pair = {"dofs": [1], "tangent": [2]} if law == "ring" else {"dofs": [2]}
    record = wb.run({
        "structure": {"type": "matrices", "mass": MASS, "stiffness": STIFFNESS, "modal_damping": 0.03},
        "contact": {"pairs": [pair | {"law": law} | values]},
        "forcing": {"load_dofs": [1], "amplitude": 1.5, "frequency": 0.9},
        "time": time,
        "analysis": {"type": analysis, "output_points": 512, "outputs": [1, 2]}})
    assert record.converged, record.summary["status"]
    return record


def test_every_law_with_a_balance_is_here():
    assert {row["name"] for row in _core.law_catalogue()} == set(LAWS) | {"none", "rigid"}


@pytest.mark.parametrize("law", LAWS)
def test_a_law_over_samples_and_as_a_machine_of_states_has_one_motion(law, tmp_path):
    balance = solve(law, tmp_path, "forced_response", BASES).summary
    for analysis, time in (("forced_response", {"method": "exact"}), ("time_stepping", {})):
        events = solve(law, tmp_path, analysis, time).summary
        assert events["rms_vibration_m"] == pytest.approx(balance["rms_vibration_m"], rel=1e-5)  # of 255 functions
        assert events["max_contact_force_N"] == pytest.approx(balance["max_contact_force_N"], rel=1e-3)

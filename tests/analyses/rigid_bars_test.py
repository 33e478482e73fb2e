"""Responses of a bar whose tip has no mass with a rigid obstacle."""

import numpy as np
import pytest
import wavebalance as wb
from rods_and_bars import BAR, matrices_of

RIGID = {
    **BAR,
    "structure": {**BAR["structure"], "massless_tip": True},
    "contact": {"law": "rigid", "gap": 1e-3},
    "time": {**BAR["time"], "quadrature_points": 128},
}
PLAIN = {"analysis.stability": False, "analysis.phases": False}


def test_a_tip_without_mass_gives_it_to_its_neighbour_and_keeps_the_sum():
    mass, stiffness = matrices_of(BAR["structure"])
    moved = mass.copy()
    moved[-2, -2] += mass[-1].sum() + mass[-1, -2]
    moved[-1, :] = moved[:, -1] = 0.0
    assert moved.sum() == pytest.approx(mass.sum(), rel=1e-12)
    omega, load = 2.0 * np.pi * 150.0, np.zeros(25)
    load[-1] = 250e3
    nodes = list(range(1, 26))
    for tip, expected in ((True, moved), (False, mass)):
        record = wb.run({**BAR, "contact": {"law": "none"}}, {"structure.massless_tip": tip, "analysis.outputs": nodes})
        amplitude = np.linalg.solve(stiffness * (1.0 + 1e-4j * omega) - omega**2 * expected, load)
        time = record.outputs["time_fraction"]
        motion = np.array([column for name, column in record.outputs.items() if name != "time_fraction"])
        exact = np.real(np.outer(amplitude, np.exp(2j * np.pi * time)))
        assert np.abs(motion - exact).max() < 1e-11 * np.abs(exact).max()


@pytest.mark.parametrize("trial, weight", [
    ("fourier", "fourier"), ("bspline", "bspline"), ("daubechies6", "daubechies6"), ("haar", "fourier"),
    ("daubechies6", "fourier"), ("haar", "bspline"),
])
def test_rigid_contact_holds_for_all_pairs(trial, weight):
    record = wb.run(RIGID, {**PLAIN, "time.trial": trial, "time.weight": weight})
    assert record.converged, record.status
    # The discretisation error of 64 functions, below 1 % of the gap of 1 mm.
    assert record.summary["max_penetration_m"] <= 1e-5
    assert record.summary["form"] == "force"
    assert record.summary["min_contact_force_N"] >= 0.0
    # The mean force converges to 0.0502..0.0515 amplitudes (found independently); 64 functions are near.
    assert record.response["contact_force_N"].mean() / 250e3 == pytest.approx(0.0515, abs=0.003)


def test_rigid_contact_is_the_limit_of_a_stiff_spring():
    rigid = wb.run(RIGID, PLAIN)
    stiff = wb.run({**RIGID, "contact": {"law": "linear", "stiffness": 1e13, "gap": 1e-3}}, PLAIN)
    assert rigid.converged and stiff.converged
    assert np.abs(stiff.response["displacement_m"] - rigid.response["displacement_m"]).max() < 1e-3 * 1e-3

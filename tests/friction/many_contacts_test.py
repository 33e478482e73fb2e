"""A rod held by springs and dimples that press against each other, as in a spacer grid, with friction along it."""

import json
import re

import numpy as np
import pytest
import wavebalance as wb

SPRING, DIMPLE, PRESSED = 8e4, 1e6, 8.0  # N/m, N/m, N


def grid(count, **analysis):
    """`count` masses between a spring and a dimple each; a load across, friction along. Mass `count` moves most."""
    n = 2 * count  # across, then along
    pairs = []
    for i in range(count):
        for name, side, stiffness in (("spring", -1.0, SPRING), ("dimple", 1.0, DIMPLE)):
            pairs.append({"name": f"{name} {i + 1}", "dofs": [i + 1], "coefficients": [side],
                          "tangent": [count + i + 1], "normal_stiffness": stiffness,
                          "normal_gap": -PRESSED / stiffness})
    load = np.r_[np.zeros(count), np.linspace(1.0, 2.0, count)].reshape(-1, 1)
    return {
        "structure": {"type": "matrices", "mass": np.eye(n), "damping": 8.0 * np.eye(n),
                      "stiffness": 1e4 * np.eye(n)},
        "contact": {"law": "coulomb", "friction": 0.3, "tangential_stiffness": 3e4, "wear_coefficient": 1e-14,
                    "pairs": pairs},
        "forcing": {"load": load, "amplitude": 6.0, "frequency": 30.0},
        "time": {"trial": "fourier", "weight": "fourier", "functions": 9, "quadrature_points": 64},
        "analysis": analysis,
    }


@pytest.mark.parametrize("more", [0.0, 1e-9, 1e-3])
def test_contacts_that_press_against_each_other_are_known_at_rest(more):
    scene = grid(1)
    scene["contact"]["pairs"][1]["normal_gap"] *= 1.0 + more
    record = wb.run(scene)
    assert record.converged and "rest_status" not in record.summary
    rest = record.summary["at_rest"]
    moved = -more * PRESSED / (1e4 + SPRING + DIMPLE)
    assert rest["displacement_m"][::2] == pytest.approx([-moved, moved], rel=1e-2, abs=1e-16)
    assert rest["contact_force_N"][0] == pytest.approx(PRESSED - SPRING * moved, rel=1e-12)


def test_contacts_that_always_stick_are_named_by_ranges():
    scene = grid(6)
    for i, pair in enumerate(scene["contact"]["pairs"]):
        del pair["name"]
        pair["friction"] = 0.05 if i == 8 else 30.0
    (warning,) = [text for text in wb.run(scene).warnings if "neither" in text]
    assert warning.startswith("Contacts 1 to 8, 10 to 12 neither slip nor open")


def test_work_and_wear_are_drawn_of_the_contacts_where_they_are_largest(tmp_path):
    scene = grid(5, type="frequency_sweep", frequency_from=24.0, frequency_to=36.0, stability=False, outputs=[10])
    record = wb.run(scene, output=tmp_path)
    assert record.converged
    sweep, drawn = record.sweep, (tmp_path / "outputs.figure.js").read_text()
    wears = {name: np.nanmax(sweep[f"{name.replace(' ', '_')}_wear_m3_per_s"])
             for name in (f"{kind} {i + 1}" for i in range(5) for kind in ("spring", "dimple"))}
    panel = next(one for one in json.loads(drawn[drawn.index(" = {") + 3:].rstrip(";\n"))["panels"]
                 if one["title"].startswith("Wear"))
    assert panel["title"] == "Wear, the 7 largest of 10"
    seen = {re.sub(" normal$", "", one["label"]) for one in panel["series"]}
    assert seen == set(sorted(wears, key=wears.get, reverse=True)[:7])
    words = "Stability was not computed. analysis.stability = true computes it."
    assert words in (tmp_path / "report.html").read_text()



def rubbing_beam(count, elements=30):
    """A clamped steel beam with 20 N at its tip, of which `count` nodes rub: springs of 1e6 N/m, at most 3 N."""
    modulus, density, width, height, h = 2.1e11, 7850.0, 0.03, 0.01, 0.6 / elements
    bending, mass_of_one, n = modulus * width * height**3 / 12, density * width * height * h, 2 * elements + 2
    k = bending / h**3 * np.array([[12, 6 * h, -12, 6 * h], [6 * h, 4 * h * h, -6 * h, 2 * h * h],
                                   [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h * h, -6 * h, 4 * h * h]])
    m = mass_of_one / 420 * np.array([[156, 22 * h, 54, -13 * h], [22 * h, 4 * h * h, 13 * h, -3 * h * h],
                                      [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h * h, -22 * h, 4 * h * h]])
    mass, stiffness = np.zeros((n, n)), np.zeros((n, n))
    for first in range(0, 2 * elements, 2):
        mass[first:first + 4, first:first + 4] += m
        stiffness[first:first + 4, first:first + 4] += k
    nodes = np.round(np.linspace(2, elements - 1, count)).astype(int)
    return {
        "structure": {"type": "matrices", "mass": mass[2:, 2:], "stiffness": stiffness[2:, 2:],
                      "stiffness_damping": 2e-5, "contact_dofs": [int(2 * node - 1) for node in nodes]},
        "contact": {"law": "coulomb", "friction": 0.3, "normal_load": 10.0, "tangential_stiffness": 1e6},
        "forcing": {"load_dofs": [2 * elements - 1], "amplitude": 20.0, "frequency": 23.2},
        "time": {"trial": "fourier", "weight": "fourier", "functions": 31, "quadrature_points": 256},
        "analysis": {"stability": False, "phases": False},
    }


def test_a_beam_on_which_seventeen_of_24_contacts_slip_is_solved_from_the_motion_in_which_all_stick():
    record = wb.run(rubbing_beam(24))
    assert record.converged
    assert record.summary["strategy"] == "sticking"
    assert np.count_nonzero(record.summary["friction"]["slip_fraction"]) == 17

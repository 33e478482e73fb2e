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


"""The motion that pairs of bases are compared with, against motions that are found in other ways."""

import tomllib

import numpy as np
import pytest
import wavebalance as wb
from comparisons import CHAIN, CLOSED_STOP, errors_of, motion_of, rows_of
from exact_bars import ElasticBar, RigidBar

PHASES = {"method": "exact", "tolerance": 1e-12}
TOLERANCES = (1e-2, 1e-4, 1e-6, 1e-8, 1e-10)


def compared(scene, budget):
    """A comparison, and the exact solution, which its errors show to be its reference."""
    found = wb.compare(scene, pairs="fourier:fourier", budget=budget)
    reference = motion_of(wb.run({**scene, "time": PHASES}, {"analysis.stability": False}))
    plain = {"time.trial": "fourier", "time.weight": "fourier", "analysis.stability": False, "analysis.phases": False}
    for row in rows_of(found.table, trial="fourier", functions=63.0, converged=1.0):
        record = wb.run(scene, {**plain, "time.functions": 63, "time.quadrature_points": int(row["points"])})
        again = errors_of(motion_of(record), reference)
        assert again == pytest.approx([row["displacement_error"], row["force_error"]], abs=1e-11)
    return found, reference


@pytest.fixture(scope="module")
def published(request):
    """Cases of Jones & Legrand by their names, each compared once: the scene, the comparison and its reference."""
    known = {}

    def case(name):
        if name not in known:
            folder = request.path.parents[2] / "reproduce" / "scenes" / "jones_legrand_2014"
            scene = tomllib.loads((folder / f"{name}.toml").read_text())
            known[name] = (scene, *compared(scene, 5.0 if "rigid" in name else 2.0))
        return known[name]

    return case


# Instants of contact, fractions of the period, with which Newton's method of the exact motion begins.
@pytest.mark.parametrize("case, bar, near, force_error, tolerances", [
    ("case1", ElasticBar, (-0.113, 0.127), 1e-7, (1e-9, 1e-6)),
    ("case2", ElasticBar, (0.049, 0.155), 1e-7, (1e-9, 1e-6)),
    ("case1_rigid", RigidBar, (-0.1125, 0.1266), 1e-9, (1e-10, 1e-8)),
    ("case2_rigid", RigidBar, (0.063, 0.145), 1e-9, (1e-10, 1e-8)),
])
def test_the_reference_of_a_published_case_is_the_exact_motion(case, bar, near, force_error, tolerances, published):
    scene, found, reference = published(case)
    summary = found.summary
    assert found.converged and summary["reference"] == "phases" and summary["reference_stability"] == "stable"
    assert rows_of(summary["pairs"], trial="phases")[0]["admissible"]
    assert summary["reference_error"] <= 1e-12 and summary["reference_force_error"] < force_error
    assert np.all(np.less(errors_of(bar(scene).motion(near, 1024), reference), tolerances))


# One scene with several contacts, one with forces of the velocity and a damping that couples modes.
@pytest.mark.parametrize("scene, error", [(CHAIN, 1e-11), (CLOSED_STOP, 1e-10)], ids=["chain", "closed_stop"])
def test_the_reference_is_the_motion_that_time_stepping_finds(scene, error):
    found, reference = compared(scene, 2.0)
    assert found.converged and found.summary["reference"] == "phases"
    assert found.summary["reference_error"] <= error
    stepping = {"type": "time_stepping", "tolerance": 1e-8, "output_points": 1024}
    stepped = wb.run({**{key: part for key, part in scene.items() if key != "time"}, "analysis": stepping})
    assert stepped.converged, stepped.status
    assert errors_of(motion_of(stepped)[:1], reference[:1])[0] < 1e-6


def test_the_reference_with_a_loss_factor_is_a_refined_balance_with_the_reason():
    summary = wb.compare(CHAIN, {"structure.loss_factor": 0.01}, pairs="fourier:fourier", budget=16.0).summary
    assert summary["reference"] == "finer_balance"
    assert rows_of(summary["pairs"], trial="phases")[0]["failures"] == "a loss factor has no equation in time"
    assert summary["reference_error"] < 1e-4
    # The last two levels of the balance.
    assert summary["reference_error"] < summary["reference_force_error"] < 1e-1


def test_exact_solutions_have_errors_that_fall_with_the_tolerance_and_are_not_below_that_of_the_reference(published):
    _, found, _ = published("case2")
    rows = rows_of(found.table, trial="phases")
    assert len(rows) >= len(TOLERANCES)
    for row in rows:
        assert row["weight"] == "" and row["converged"], row["status"]
        assert found.summary["reference_error"] <= row["displacement_error"] <= row["tolerance"]
        assert row["error"] == max(row["displacement_error"], row["force_error"])
        assert row["seconds"] > 0.0
        assert row["points"] == 4 * (row["functions"] + 1)
    loosest, tightest = ([row["error"] for row in rows if row["tolerance"] == one][-1] for one in (1e-2, 1e-10))
    assert {row["tolerance"] for row in rows} == set(TOLERANCES)
    assert tightest < 1e-6 * loosest

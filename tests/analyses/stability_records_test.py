"""Stability as records, tables and pictures hold it."""

import numpy as np
import pytest
import wavebalance as wb
from rods_and_bars import figure_of, warns

FOURIER = {"time.trial": "fourier", "time.weight": "fourier", "time.functions": 63, "time.quadrature_points": 512}


@pytest.fixture(scope="module")
def solved(request):
    """Solves a scene of Jones & Legrand with Fourier functions, each once."""
    records = {}

    def solve(scene, **changes):
        key = scene, tuple(changes.items())
        if key not in records:
            dotted = {name.replace("__", "."): value for name, value in changes.items()}
            folder = request.path.parents[2] / "reproduce" / "scenes" / "jones_legrand_2014"
            records[key] = wb.run(folder / f"{scene}.toml", {**FOURIER, **dotted})
        return records[key]

    return solve


# Between grazing and the period doubling at 2840.48 Hz.
def test_a_record_says_that_a_period_doubled_motion_is_unstable(solved):
    record = solved("case2", structure__stiffness_damping=1.25e-6, contact__gap=1e-4, forcing__frequency=2800)
    assert record.converged, record.status
    summary = record.summary
    assert summary["stability"] == "unstable" and summary["unstable_multipliers"] == 1
    assert summary["leading_multiplier_real"] < -1.0
    assert summary["leading_multiplier_imag"] == pytest.approx(0.0, abs=1e-9)
    assert warns(record, "unstable")


def test_a_record_of_an_unstable_motion_says_what_the_structure_settles_to_in_its_place(scenes, solved):
    record = wb.run(scenes / "cases_of_others" / "oscillator_with_stop.toml",
                    {"analysis.type": "forced_response", "forcing.frequency": 0.3978873577},
                    unset=["analysis.branches", "analysis.frequency_from", "analysis.frequency_to"])
    assert record.converged, record.status
    assert record.summary["unstable_multipliers"] == 1
    # Behind a period doubling: a motion of two periods, which goes farther.
    assert record.summary["settled_periods"] == 2
    assert record.summary["settled_max_displacement_m"] > record.summary["max_displacement_m"]
    assert warns(record, "converges to another motion, of 2 periods")
    assert "settled_periods" not in solved("case2", forcing__frequency=1275).summary


# Reference: shooting made independently of this code.
def test_a_record_holds_the_leading_multiplier_of_a_stable_motion(solved):
    summary = solved("case2", forcing__frequency=1275).summary
    assert summary["stability"] == "stable" and summary["unstable_multipliers"] == 0
    assert summary["leading_multiplier_real"] == pytest.approx(0.57073047, abs=2e-3)
    assert summary["leading_multiplier_imag"] == pytest.approx(0.19792202, abs=2e-3)


def test_a_motion_with_rigid_contact_is_stable_and_one_without_damping_is_not_known(solved):
    assert solved("case1_rigid").summary["stability"] == "stable"
    undamped = solved("case1", structure__stiffness_damping=0).summary
    assert undamped["stability"] == "undamped" and np.isnan(undamped["unstable_multipliers"])


def test_a_record_holds_no_stability_where_the_scene_wants_none(solved):
    assert not {"stability", "unstable_multipliers"} & set(solved("case1", analysis__stability=False).summary)


def test_a_sweep_lists_its_special_points_and_the_stability_of_each_point(solved, tmp_path):
    record = solved("case2_sweep")
    special, turns = record.summary["special_points"], record.summary["turning_points_Hz"]
    assert special["type"] == ["grazing", "fold", "fold", "grazing"]
    assert record.summary["structure_curve"] == "whole"
    whole = record.summary["structure_special_points"]
    assert list(turns) == [at for kind, at in zip(whole["type"], whole["frequency_Hz"]) if kind == "fold"]
    assert turns == pytest.approx(special["frequency_Hz"][1:3], rel=1e-5) and len(turns) == 2
    unstable, frequency = record.sweep["unstable"], record.sweep["frequency_Hz"]
    assert np.all(np.isnan(unstable) | (unstable == 0.0) | (unstable == 1.0))
    leaves = unstable == 1.0
    assert np.all((frequency[leaves] > 1314.0) & (frequency[leaves] < 1338.0))
    assert np.all(record.sweep["contacts"][leaves] == 1.0)
    assert np.count_nonzero(leaves) > 3
    # Solid and dashed lines of two quantities, and two kinds of points.
    assert len(figure_of(record, tmp_path, "sweep")["panels"][0]["series"]) == 6


# With 256 points the lower fold, 0.002 Hz from a grazing, is not among the folds found.
def test_a_sweep_warns_where_its_turning_points_cannot_be_all(solved):
    record = solved("case2_sweep", time__quadrature_points=256)
    assert record.status == "reached_end"
    odd = len(record.summary["turning_points_Hz"]) % 2 == 1
    assert warns(record, "a curve with this end has an even number of folds") == odd
    assert not warns(record, "the other turns are discretisation artefacts")


def test_a_sweep_without_special_points_has_the_same_counts(solved):
    counts = solved("case2_sweep", analysis__special_points=False)
    assert counts.status == "reached_end"
    assert not {"special_points", "structure_special_points"} & set(counts.summary)
    assert len(counts.summary["turning_points_Hz"]) == 2
    expected, found = solved("case2_sweep").sweep["unstable"], counts.sweep["unstable"]
    assert len(found) == len(expected)
    assert np.all((found == expected) | np.isnan(expected))
    assert np.count_nonzero(found == 1.0) > 3


@pytest.mark.parametrize("other", [{"analysis.branches": True}, {"analysis.motion_at": "special"},
                                   {"analysis.exact": True}])
def test_a_sweep_whose_special_points_are_wanted_cannot_leave_them_out(scenes, other):
    with pytest.raises(wb.SceneError, match="analysis.special_points = true"):
        wb.check(scenes / "jones_legrand_2014" / "case2_sweep.toml", {"analysis.special_points": False, **other})


def test_a_sweep_without_stability_has_the_turning_points_of_the_samples(solved, tmp_path):
    record = solved("case2_sweep", analysis__stability=False)
    assert "special_points" not in record.summary
    assert len(record.summary["turning_points_Hz"]) == 2
    assert "unstable" not in record.sweep
    assert len(figure_of(record, tmp_path, "sweep")["panels"][0]["series"]) == 2


def test_the_grazing_of_one_of_several_contacts_is_one_point():
    # Where the first contact touches between two samples only, the others go on being counted.
    n = 4
    stiffness = 1e4 * (2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1))
    stiffness[-1, -1] = 1e4
    first = np.sqrt(np.linalg.eigvalsh(stiffness)[0]) / 2 / np.pi
    record = wb.run({
        "structure": {"type": "matrices", "mass": np.eye(n), "stiffness": stiffness, "modal_damping": 0.02,
                      "contact_dofs": [4, 3, 2, 1]},
        "contact": {"law": "linear", "stiffness": 1e3, "gap": [1e-3, 0.8e-3, 0.6e-3, 0.3e-3]},
        "forcing": {"load_dofs": [n], "amplitude": 0.4, "frequency": first},
        "time": {"trial": "fourier", "weight": "fourier", "functions": 31, "quadrature_points": 64},
        "analysis": {"type": "frequency_sweep", "frequency_from": 0.8 * first, "frequency_to": 1.1 * first}})
    special = record.summary["special_points"]
    grazing = [status for kind, status in zip(special["type"], special["status"]) if kind == "grazing"]
    assert len(grazing) == np.abs(np.diff(record.sweep["contacts"])).sum() == 4
    assert set(grazing) == {"located"}

"""Comparisons near a motion that is given."""

import numpy as np
import pytest
import wavebalance as wb
from comparisons import CHAIN, STOP, TWO_PAIRS, errors_of, motion_of, rows_of


@pytest.fixture(scope="module")
def curve(tmp_path_factory):
    """The folder of a curve with three motions at 0.18 Hz, by falling displacements: large, unstable, small."""
    folder = tmp_path_factory.mktemp("curve")
    analysis = {"type": "frequency_sweep", "frequency_from": 0.13, "frequency_to": 0.25, "motion_at": 0.18}
    wb.run({**STOP, "analysis": analysis}, output=folder)
    return folder


def motion_in(file):
    """Displacements and forces of a motion's file."""
    table = np.genfromtxt(file, delimiter=",", names=True)
    return [table[name][None, :] for name in ("displacement_m", "contact_force_N")]


@pytest.fixture(scope="module")
def compared(curve):
    """Comparisons from the large and from the small motion."""
    return {number: wb.compare(STOP, pairs=TWO_PAIRS, budget=3.0, start_from=curve / f"motion_0.18Hz_{number}.csv")
            for number in (1, 3)}


@pytest.mark.parametrize("number", [1, 3])
def test_a_start_leads_the_reference_and_each_solve_to_its_motion(number, curve, compared):
    starts = {one: motion_in(curve / f"motion_0.18Hz_{one}.csv") for one in (1, 3)}
    far = errors_of(starts[3][:1], starts[1][:1])[0]
    assert far > 0.1
    found = compared[number]
    assert found.converged
    assert (found.summary["reference"], found.summary["solves_begin_with"]) == ("phases", "reference")
    solved = [row for row in rows_of(found.table, converged=1.0) if row["functions"] >= 31]
    assert len(solved) > 10
    assert all(row["displacement_error"] < 0.1 * far for row in solved)
    # The motion of a pair with a known error, and so the reference, is as large as the start.
    of_fourier = [row for row in rows_of(found.table, trial="fourier", converged=1.0) if row["functions"] <= 255]
    least = min(of_fourier, key=lambda row: row["displacement_error"])
    assert least["displacement_error"] < 1e-4
    sizes = {"time.functions": int(least["functions"]), "time.quadrature_points": int(least["points"])}
    record = wb.run(STOP, sizes, start_from=curve / f"motion_0.18Hz_{number}.csv")
    largest = starts[number][0].max()
    assert motion_of(record)[0].max() == pytest.approx(largest, rel=0.01)
    assert errors_of(motion_of(record)[:1], starts[number][:1])[0] < 0.01


def test_where_solves_begin_is_said_in_the_record(compared):
    assert wb.compare(STOP, pairs=TWO_PAIRS, budget=1.0).summary["solves_begin_with"] == "no_contact"
    assert "Each solve starts from the motion of the reference." in compared[1].text


def test_a_tolerance_has_no_effect_and_does_not_hinder_a_start(curve):
    scene = {**STOP, "time": {"tolerance": 1e-3}}
    found = wb.compare(scene, pairs=TWO_PAIRS, budget=1.0, start_from=curve / "motion_0.18Hz_1.csv")
    assert found.summary["solves_begin_with"] == "reference"


def test_a_start_with_other_contacts_is_refused(tmp_path):
    wb.run(CHAIN, output=tmp_path)
    with pytest.raises(ValueError, match="contact"):
        wb.compare(STOP, pairs=TWO_PAIRS, budget=1.0, start_from=tmp_path)

"""Which error decides in a comparison: displacement, force, or the larger."""

import numpy as np
import pytest
import wavebalance as wb
from comparisons import TWO_PAIRS, rows_of
from rods_and_bars import BAR

SWEEP = {"analysis.type": "frequency_sweep", "analysis.frequency_from": 100, "analysis.frequency_to": 110}


@pytest.fixture(scope="module")
def compared():
    """The bar compared by each error; none is named for both."""
    return {error or "both": wb.compare(BAR, pairs=TWO_PAIRS, budget=2.0, error=error)
            for error in ("", "displacement", "force")}


def test_an_error_of_another_name_is_refused_with_what_is_allowed():
    with pytest.raises(ValueError, match="^--error energy: expected displacement, force or both$"):
        wb.compare(BAR, error="energy")


def test_errors_of_both_recommend_no_motion_whose_force_is_wrong(compared):
    one, other = (rows_of(compared[error].summary["recommendations"])[0] for error in ("displacement", "both"))
    assert one["displacement_error"] <= 1e-2 and one["force_error"] > 2e-2
    assert other["displacement_error"] <= 1e-2 and other["force_error"] <= 1e-2


@pytest.mark.parametrize("measure, weighed", [
    ("displacement", lambda displacement, force: displacement),
    ("force", lambda displacement, force: force),
    ("both", np.maximum),
])
def test_the_error_that_decides_is_one_of_both_or_the_larger(measure, weighed, compared):
    table = compared[measure].table
    solved = table["converged"] == 1.0
    expected = weighed(table["displacement_error"], table["force_error"])
    assert np.count_nonzero(solved) > 20 and np.array_equal(table["error"][solved], expected[solved])


@pytest.mark.parametrize("measure, subject", [("displacement", "the displacement"), ("force", "the force"),
                                              ("both", "displacement and force")])
def test_the_error_is_named_by_sentences_tables_and_the_axis(measure, subject, compared):
    found = compared[measure]
    assert f"For an error of 0.01 in {subject}" in found.text
    assert found.summary["error_of"] == found.summary["recommendations"]["error_of"][0] == measure
    pictures = found.svgs()
    assert set(pictures) == {"error_over_time", "error_over_functions"}
    assert all(f"Relative rms error of {subject}<" in picture for picture in pictures.values())


@pytest.mark.parametrize("error, warnings", [("", 0), ("force", 1), ("both", 1)])
def test_errors_of_a_force_that_does_not_act_are_those_of_the_displacement_and_the_record_says_so(error, warnings):
    found = wb.compare(BAR, {"contact.gap": 1.0}, pairs=TWO_PAIRS, budget=2.0, error=error)
    assert found.summary["error_of"] == "displacement"
    assert "The error is measured in the displacement, because no contact force acts." in found.text
    assert len(found.warnings) == warnings


def test_errors_of_the_force_are_refused_for_sweeps_with_what_is_allowed():
    message = "^--error force: curves of a sweep are compared by their displacements; expected displacement$"
    with pytest.raises(ValueError, match=message):
        wb.compare(BAR, SWEEP, pairs=TWO_PAIRS, error="force")


@pytest.mark.parametrize("error", ["", "displacement"])
def test_errors_of_the_displacement_are_taken_for_sweeps(error):
    assert wb.compare(BAR, {**SWEEP, "structure.elements": 5}, pairs=TWO_PAIRS, budget=0.5, error=error).converged

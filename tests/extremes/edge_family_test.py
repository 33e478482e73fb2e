"""Inputs at the edge: each solves with residuals checked apart from the solver, or says what is wrong with it."""

import numpy as np
import pytest
from edge_bases import FourierPair
from edge_family import Case, difference_between_units, family, keys_of_bar, led_to_what_it_must
from edge_residuals import (
    ERROR,
    LARGEST_MOTION_RESIDUAL,
    NOT_CONVERGED,
    SOLVED,
    WRONG,
    Found,
    Solution,
    motion_residual,
)
from edge_structures import bar_of

import wavebalance as wb


@pytest.mark.parametrize("group", dict.fromkeys(case.group for case in family()))
def test_inputs_at_the_edge_solve_with_checked_residuals_or_say_what_is_wrong(group):
    for case in family():
        if case.group == group:
            found = case.run()
            assert led_to_what_it_must(case, found), (
                f"{case.input()}\nmust be {case.must}: {case.named}\nis {found.outcome}: {found.text}\n"
                f"motion {found.motion}, complementarity {found.complementarity}")


@pytest.mark.parametrize("must, named, may, outcome, text, holds", [
    (SOLVED, "", False, SOLVED, "", True),
    (SOLVED, "", False, SOLVED, "samples that are not finite", False),
    (SOLVED, "", False, NOT_CONVERGED, "", False),
    (SOLVED, "", False, WRONG, "", False),
    (ERROR, "contact.gap", False, ERROR, "contact.gap = 1: ...", True),
    (ERROR, "contact.gap", False, ERROR, "something else", False),
    (NOT_CONVERGED, "stalled", True, SOLVED, "", True),
    (NOT_CONVERGED, "stalled", True, NOT_CONVERGED, "stalled", True),
    (NOT_CONVERGED, "stalled", True, NOT_CONVERGED, "singular", False),
    (NOT_CONVERGED, "stalled", True, WRONG, "", False),
])
def test_a_row_of_the_family_holds_only_with_its_outcome_and_its_words(must, named, may, outcome, text, holds):
    assert led_to_what_it_must(Case("group", "bar.toml", {}, must, named, may), Found(outcome, text)) is holds


def test_a_row_that_must_fail_needs_words():
    with pytest.raises(ValueError, match="gives no words"):
        led_to_what_it_must(Case("group", "bar.toml", {}, ERROR), Found(ERROR, "anything"))


def test_units_do_not_change_the_motion():
    assert difference_between_units() <= 1e-9


def test_a_gap_below_the_normal_numbers_is_solved():
    keys, gap = keys_of_bar(), 4e-320
    bar, law = bar_of(keys), wb.Exponential(keys["contact"]["constant"], keys["contact"]["exponent"], gap)
    structure = wb.Structure(bar.mass, bar.damping, bar.stiffness, bar.load, bar.directions)
    response = wb.forced_response(structure, law, keys["forcing"]["frequency"])
    assert response.converged
    motion = response.structure_motion(256).displacement
    displacement, force = response.displacement, response.contact_force
    residual, _ = motion_residual(Solution(keys, None, bar, FourierPair(63, 256), motion, displacement, force))
    assert residual <= LARGEST_MOTION_RESIDUAL
    by_law = keys["contact"]["constant"] * np.expm1(keys["contact"]["exponent"] * displacement)
    np.testing.assert_allclose(force, np.maximum(by_law, 0.0), rtol=0.0, atol=1e-6 * force.max())

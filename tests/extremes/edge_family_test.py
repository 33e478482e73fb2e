"""Inputs at the edge: each solves with independently checked residuals, or reports its error."""

import pytest
from edge_family import Case, difference_between_units, family, led_to_what_it_must
from edge_residuals import ERROR, NOT_CONVERGED, SOLVED, WRONG, Found


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

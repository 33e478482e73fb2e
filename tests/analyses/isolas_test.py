"""Isolated branches of an oscillator with a stop, analysis.isolas."""

import numpy as np
import pytest
from solved_scenes import STOP, STOP_MOTIONS, STOP_RESPONSE, outcome_of, refusal, rows_of, solved, where

import wavebalance

SOUGHT = {"analysis.isolas": True}
STIFF = {"contact.stiffness": 4.0, "forcing.amplitude": 0.15}
# From above, the curve without contact is followed down to 0.18 Hz, between the folds at 0.1699 and 0.1957 Hz, where
# two other motions exist.
FROM_ABOVE = {**STIFF, "analysis.frequency_from": 0.24, "analysis.frequency_to": 0.18, "analysis.isola_spacing": 0.02}
# A load of 2 N at three times the frequency, whose curve has no contact: a motion of three of its periods is on a
# closed curve, one motion for each of the periods in which it may begin.
THIRD_ORDER = {"forcing": {"amplitude": 0.0, "terms": [{"harmonic": 3, "amplitude": 2.0}]}}
CLOSED = {**SOUGHT, "contact.stiffness": 4.0, "analysis.isola_starts": 6, "analysis.isola_spacing": 0.0175,
          "time.quadrature_points": 504, "analysis.frequency_from": 0.165, "analysis.frequency_to": 0.2}
EXACT = {"analysis.exact": True}


def folds_of_isolas(record):
    return where(record.summary["special_points_of_isolas"], type="fold")["frequency_Hz"]


def test_isolas_are_curves_that_the_sweep_does_not_pass():
    record = solved(STOP, {**FROM_ABOVE, **SOUGHT})
    assert record.converged
    (warning,) = record.warnings
    assert "No contact closes" in warning
    isolas = record.summary["isolas"]
    assert list(isolas["status"]) == ["returned"]
    assert isolas["lowest_frequency_Hz"][0] == pytest.approx(0.18, abs=1e-9)
    # The same fold on the curve from below, which holds both parts.
    whole = solved(STOP, {**STIFF, "analysis.frequency_to": 0.24}).summary["special_points"]
    (fold,) = folds_of_isolas(record)
    assert fold == pytest.approx(where(whole, type="fold")["frequency_Hz"].max(), abs=1e-6)
    main, beside = where(record.sweep, isola=0), where(record.sweep, isola=1)
    assert rows_of(main) + rows_of(beside) == rows_of(record.sweep)
    assert main["max_displacement_m"].max() < 1.0 and beside["max_displacement_m"].max() > 1.5
    assert beside["unstable"].max() > 0.0 and beside["unstable"].min() == 0.0
    assert record.summary["other_motions"] == "sought" and record.summary["isola_frequencies"] == 3
    assert "isola 1 from 0.18 to 0.19569 Hz" in " ".join(outcome_of(record))


@pytest.mark.parametrize("exact", [{}, EXACT], ids=["balance", "exact"])
def test_isolas_may_be_closed_curves(exact):
    record = solved({**STOP, **THIRD_ORDER}, {**CLOSED, **exact})
    assert record.converged, record.status
    assert list(record.summary["isolas"]["status"]) == ["closed"]
    assert len(folds_of_isolas(record)) == 2


def test_all_motions_that_touch_are_on_the_closed_curve():
    """The motions by phases at 0.18 Hz."""
    closed = where(solved({**STOP, **THIRD_ORDER}, CLOSED).sweep, isola=1)
    frequency, force = closed["frequency_Hz"], closed["max_contact_force_N"]
    motions = solved({**STOP_MOTIONS, **THIRD_ORDER}, {"contact.stiffness": 4.0, "forcing.frequency": 0.18,
                                                       "analysis.random_starts": 4}).summary["motions"]
    touching = motions["max_contact_force_N"][motions["max_contact_force_N"] > 0.0]
    assert len(touching) >= 1
    share = (0.18 - frequency[:-1]) / np.diff(frequency)
    across = (share >= 0.0) & (share <= 1.0)
    there = (force[:-1] + share * np.diff(force))[across]
    for exact in touching:
        assert np.abs(there - exact).min() < 2e-2 * exact


def test_isolas_of_exact_curves_are_exact():
    record = solved(STOP, {**FROM_ABOVE, **SOUGHT, **EXACT})
    assert record.converged, record.status
    assert list(record.summary["isolas"]["status"]) == ["returned"]
    assert list(folds_of_isolas(record)) == pytest.approx([0.195690553549], abs=1e-11)


def test_there_are_no_isolas_where_the_curve_holds_all_motions():
    record = solved(STOP, {**SOUGHT, "analysis.isola_spacing": 0.03, "analysis.isola_starts": 1})
    assert rows_of(record.summary["isolas"]) == 0 and record.summary["isola_frequencies"] == 4
    assert "None was found." in outcome_of(record)


@pytest.mark.parametrize("scene, overrides, said", [
    (STOP, FROM_ABOVE, "Isolated branches were not searched for."),
    (STOP_RESPONSE, {}, "Other motions at this frequency were not searched for."),
], ids=["curve", "response"])
def test_motions_that_were_not_sought_are_said_to_be_so(scene, overrides, said):
    record = solved(scene, overrides)
    assert record.summary["other_motions"] == "not_sought" and "isolas" not in record.summary
    assert "isola" not in record.sweep
    assert said in outcome_of(record)


def test_nothing_is_said_of_other_motions_without_contact():
    assert "other_motions" not in solved({**STOP, "contact": {"law": "none"}}).summary


def test_check_announces_isolas_with_what_they_take():
    text = wavebalance.check(STOP, {**FROM_ABOVE, **SOUGHT})
    assert "searched for at 3 frequencies, from rest and 4 random states each: 15 time integrations" in text


def other(kind, *sections):
    """The oscillator with another analysis and isolas."""
    return {**{section: STOP[section] for section in sections}, "analysis": {"type": kind, "isolas": True}}


@pytest.mark.parametrize("scene, overrides, parts", [
    (STOP, {"analysis.isolas": 1}, ["analysis.isolas = 1", "true or false"]),
    (STOP, {**SOUGHT, "analysis.subharmonic": 2}, ["analysis.isolas = true", "analysis.subharmonic = 1"]),
    (STOP, {**SOUGHT, "structure.loss_factor": 0.01, "structure.stiffness_damping": 0},
     ["analysis.isolas = true", "loss factor"]),
    (STOP, {**SOUGHT, "structure.elements": 401}, ["analysis.isolas = true", "at most 400"]),
    (STOP, {"analysis.isola_spacing": 0}, ["analysis.isola_spacing = 0"]),
    (STOP, {"analysis.isola_starts": -1}, ["analysis.isola_starts = -1"]),
    (STOP, ["analysis.isolas=true", "analysis.isola_spacing=1e-7"],
     ["analysis.isola_spacing = 1e-7", "at most 100000"]),
    (other("forced_response", "structure", "contact", "forcing", "time"), {},
     ["analysis.isolas = true", "frequency_sweep"]),
    (other("time_stepping", "structure", "contact", "forcing"), {}, ["analysis.isolas = true", "frequency_sweep"]),
])
def test_isolas_are_refused_where_they_cannot_be_sought(scene, overrides, parts):
    message = str(refusal(scene, overrides))
    assert all(part in message for part in parts), message

"""Exact curves with friction: slip begins and ceases where the motion that sticks reaches the limit."""

import math

import pytest
import wavebalance as wb
from friction_structures import jenkins


def curve(given, **analysis):
    given = {key: given[key] for key in given if key != "time"}
    if analysis["type"] == "frequency_sweep":
        given["forcing"] = {key: value for key, value in given["forcing"].items() if key != "frequency"}
    record = wb.run({**given, "analysis": {"exact": True, **analysis}})
    assert record.status == "reached_end"
    return record


def test_slip_begins_and_ceases_over_the_frequency():
    # The slider holds up to its limit where |k + k_t - w^2 + i c w| = k_t F / limit.
    load, spring, damping = 0.6, 3.0, 0.05
    middle, limit = 1.0 + spring - 0.5 * damping * damping, spring * load
    root = math.sqrt(middle * middle - (1.0 + spring) ** 2 + limit * limit)
    begins, ceases = (math.sqrt(square) / (2.0 * math.pi) for square in (middle - root, middle + root))
    record = curve(jenkins(load, spring, 1.0), type="frequency_sweep", frequency_from=1.0 / (2.0 * math.pi),
                   frequency_to=0.477)
    points = record.summary["special_points"]
    assert points["type"] == ["slip", "slip"]
    assert list(points["frequency_Hz"]) == pytest.approx([begins, ceases], rel=1e-7, abs=0.0)
    sweep = record.sweep
    for frequency, sticks, status in zip(sweep["frequency_Hz"], sweep["stick_fraction"], sweep["phases_status"]):
        outside = max(begins - frequency, frequency - ceases)
        assert abs(outside) <= 1e-7 or (sticks == 1.0) == (outside > 0.0), frequency
        assert status == "converged"


def test_slip_begins_at_its_load():
    record = curve(jenkins(1.0, 1.0, 0.45), type="amplitude_sweep", amplitude_from=1.0, amplitude_to=3.0)
    points = record.summary["special_points"]
    assert points["type"] == ["slip"]
    assert list(points["amplitude_N"]) == pytest.approx([1.7976408151], rel=1e-7, abs=0.0)

"""The record of the picture of speed against accuracy. No time is asserted."""

import itertools
import math


def test_a_smaller_error_never_costs_less_and_fourier_is_its_own_measure(results):
    table = results.table("speed.csv")
    assert len(set(table.texts("scene"))) == 4
    assert len(set(table.texts("bases"))) == 8
    for stair, rows in itertools.groupby(table.rows, lambda row: (row["scene"], row["bases"], row["error_of"])):
        before, asked = 0.0, 1.0
        for row in rows:
            error, seconds = float(row["error_asked"]), float(row["seconds"])
            assert error < asked, stair
            asked = error
            if math.isnan(seconds):
                before = math.inf
                continue
            assert seconds >= before, (stair, asked)
            before = seconds
            assert float(row["seconds_with_plans"]) >= seconds, (stair, asked)
            if row["bases"] == "Fourier:Fourier":
                assert float(row["over_fourier_fourier"]) == 1.0, (stair, asked)
    assert len(results.record("speed")["notes"]) == 4


def test_a_pair_that_reaches_the_largest_error_alone_is_seen_in_its_panel(results):
    panels = results.panels("speed")
    assert len(panels) == 8
    for panel in panels:
        for stair in panel["series"]:
            seen = any(isinstance(value, (int, float)) for value in stair["y"][:-1])
            assert not seen or isinstance(stair["y"][-1], (int, float)), (panel["title"], stair["label"])

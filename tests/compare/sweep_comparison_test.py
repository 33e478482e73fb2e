"""Pairs of bases against each other in sweeps."""

import re

import pytest
import wavebalance as wb
from comparisons import STOP, TWO_PAIRS, rows_of
from rods_and_bars import BAR

# Few elements and points, so that several sizes are followed in a second.
BRIEF = {"structure.elements": 5, "analysis.type": "frequency_sweep", "analysis.frequency_from": 100,
         "analysis.frequency_to": 160, "time.functions": 16, "time.quadrature_points": 64}
OVER_FREQUENCY = {**STOP, "time": {**STOP["time"], "functions": 64, "quadrature_points": 256},
                  "analysis": {"type": "frequency_sweep", "frequency_from": 0.13, "frequency_to": 0.25}}
OVER_AMPLITUDE = {**STOP, "analysis": {"type": "amplitude_sweep", "amplitude_from": 0.05, "amplitude_to": 0.5}}


@pytest.fixture(scope="module", params=["bar", "stop"])
def compared(request):
    """A comparison of two pairs over the frequency, and the frequencies between which it is."""
    if request.param == "bar":
        return wb.compare(BAR, BRIEF, pairs=TWO_PAIRS, budget=2.0), (100.0, 160.0)
    return wb.compare(OVER_FREQUENCY, pairs=TWO_PAIRS, budget=2.0), (0.13, 0.25)


def finest_of(found):
    return rows_of(found.table, distance_from_finest=0.0)[0]


def size_of(row):
    """Functions, counted with the one that a pair of Fourier functions leaves out."""
    return row["functions"] + row["functions"] % 2


def test_curves_of_several_pairs_are_laid_over_the_finest(compared):
    found, (begin, end) = compared
    curves, finest = rows_of(found.table), finest_of(found)
    assert found.status == "converged" and len(curves) >= 6
    sizes = [size_of(row) for row in curves]
    assert sizes == sorted(sizes)  # all pairs of each
    assert size_of(finest) == max(size_of(row) for row in curves if row["status"] == "reached_end")
    assert finest["points"] == 4 * size_of(finest)  # as the scene has per function
    coarse = curves[0]
    assert coarse["status"] == "reached_end"
    assert 0.0 < coarse["distance_from_finest"] < 0.1
    assert coarse["max_displacement_m"] == pytest.approx(finest["max_displacement_m"], rel=0.1)
    assert begin <= finest["frequency_at_max_displacement_Hz"] <= end


@pytest.mark.parametrize("compared", ["stop"], indirect=True)
def test_the_exact_curve_has_the_errors_of_all_which_fall_with_the_size(compared):
    found, _ = compared
    coarse, finest = rows_of(found.table)[0], finest_of(found)
    peak = re.search("The exact curve took .*s. Its peak is ([^ ]*) (m?)m", found.text)
    assert float(peak[1]) * (1e-3 if peak[2] else 1.0) == pytest.approx(finest["max_displacement_m"], rel=0.01)
    assert coarse["distance_from_exact"] > finest["distance_from_exact"] > 0.0
    assert finest["distance_from_exact"] < 0.02


def test_a_comparison_over_the_amplitude_follows_the_curve_of_that_sweep():
    sizes = {"time.functions": 32, "time.quadrature_points": 512}
    found = wb.compare(OVER_AMPLITUDE, sizes, pairs="fourier:fourier", budget=1.5)
    assert found.converged, found.status
    (curve,) = rows_of(found.table, functions=31.0)
    alone = wb.run(OVER_AMPLITUDE, {**sizes, "time.functions": 31, "analysis.stability": False})
    height = alone.sweep["max_displacement_m"]
    assert (curve["points"], curve["curve_points"], curve["turning_points"]) == (512, len(height), 2)
    assert curve["max_displacement_m"] == height.max()
    assert curve["amplitude_at_max_displacement_N"] == alone.sweep["amplitude_N"][height.argmax()]
    assert found.table["distance_from_finest"][0] > 0.0
    assert "N, and it turns 2 times" in found.text

"""The frequency response of Fig. 12: where it turns, and that the files hold all that is drawn."""

import numpy as np
import pytest
from jl14_pairs import PAIRS, trial_and_weight

STEM = "fig12_frequency_response"


@pytest.fixture(scope="module")
def curves(results):
    """The points of all curves."""
    return results.table(f"{STEM}.csv")


@pytest.fixture(scope="module")
def special_points(results):
    """Folds, grazings and period doublings of all curves."""
    return results.table(f"{STEM}_special_points.csv")


def test_the_frequency_response_turns_where_it_should(curves):
    assert curves.columns == ["trial", "weight", "frequency_Hz", "max_displacement_m", "rms_displacement_m",
                              "max_abs_displacement_m", "unstable", "functions"]
    frequency = curves.where(functions="64", trial="fourier").numbers("frequency_Hz")
    assert frequency[0] == pytest.approx(1100.0, abs=1e-9)
    assert frequency[-1] >= 1699.0
    fold = np.flatnonzero(np.diff(frequency) < 0.0)[0]
    assert frequency[fold] == pytest.approx(1337.748, abs=0.1)
    assert frequency[fold:].min() == pytest.approx(1315.067, abs=0.1)
    assert len(curves.where(trial="haar")) > 0


@pytest.mark.parametrize("pair, label", PAIRS.items())
def test_the_files_hold_all_six_pairs_and_where_they_turn(curves, special_points, pair, label):
    assert len(curves.where(functions="64", **trial_and_weight(pair))) > 100
    turns = special_points.where(curve=f"first resonance, {label}").numbers("frequency_Hz")
    assert len(turns) == 2
    assert turns == pytest.approx([1337.9, 1315.0], abs=0.2)


# Whoever draws the figure again finds the line, its stability and its marks in the files.
def test_the_line_of_63_functions_is_unstable_between_its_folds_alone(curves):
    line = curves.where(functions="63")
    assert len(line) > 100
    assert np.all(line.numbers("max_abs_displacement_m") >= line.numbers("max_displacement_m"))
    frequency, unstable = line.numbers("frequency_Hz"), line.numbers("unstable")
    between = frequency[unstable > 0.0]
    assert len(between) > 3
    assert between.min() > 1314.0 and between.max() < 1338.0
    assert np.count_nonzero(np.isnan(unstable)) <= 2  # on a grazing no multipliers are counted


def test_the_marks_of_the_line_and_of_the_second_resonance_are_in_a_file(special_points):
    line = special_points.where(curve="first resonance, 63 functions")
    folds = line.where(type="fold").numbers("frequency_Hz")
    assert len(folds) >= 1  # the other is a grazing
    assert folds[0] == pytest.approx(1337.74, abs=0.1)
    assert len(line.where(type="grazing")) == 2
    doublings = special_points.where(curve="second resonance, small gap", type="period_doubling")
    assert len(doublings) == 2
    assert doublings.numbers("frequency_Hz") == pytest.approx([3428.5, 3960.3], abs=0.5)

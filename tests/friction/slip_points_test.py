"""Where contacts begin to slip along sweeps, against the closed form of the response with the slider stuck."""

import numpy as np
import pytest
import wavebalance as wb
from rubbing_structures import frequency_of, laws_of, structure_of
from known_motions import slider_on_oscillator


def load_that_slips(omega):
    """That whose linear response with the slider stuck reaches the limit: F = (L / k_t) |k + k_t - w^2 + i c w|."""
    return abs(2.0 - omega**2 + 0.05j * omega)


@pytest.mark.parametrize("omega", [0.45, 1.2, 1.41])
def test_slip_begins_at_the_exact_load_of_an_amplitude_sweep(omega):
    exact, mixture = load_that_slips(omega), slider_on_oscillator(1.0, 1.0, omega)
    curve = wb.amplitude_sweep(structure_of(mixture), laws_of(mixture), frequency_of(mixture), 0.3 * exact, 1.7 * exact,
                               wb.Pair("fourier", 31, 128))
    assert curve.status == "reached_end"
    [slip] = curve.special("slip")
    assert slip["located"]
    assert slip["amplitude"] == pytest.approx(exact, rel=1e-8, abs=0.0)
    assert slip["max_displacement"] == pytest.approx(1.0, rel=0.0, abs=1e-4)


def test_slip_of_a_frequency_sweep_is_where_the_stuck_response_reaches_the_limit():
    """Around the resonance of the stuck slider a small load makes it slip between two frequencies."""
    load = 0.2
    mixture = slider_on_oscillator(load, 1.0, 1.0)
    curve = wb.frequency_sweep(structure_of(mixture), laws_of(mixture), 1.2 / (2.0 * np.pi), 1.65 / (2.0 * np.pi),
                               wb.Pair("fourier", 31, 512))
    assert curve.status == "reached_end"
    first, second = (2.0 * np.pi * point["frequency"] for point in curve.special("slip"))
    assert [load_that_slips(first), load_that_slips(second)] == pytest.approx([load, load], rel=0.0, abs=1e-8)

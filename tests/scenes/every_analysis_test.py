"""One small scene of each analysis: an oscillator, m = 1 kg, k = 100 N/m, c = 0.4 N s/m, against closed forms or one another."""

import math

import numpy as np
import pytest

import wavebalance as wb

STRUCTURE = {"type": "matrices", "mass": np.eye(1), "stiffness": 100.0 * np.eye(1), "damping": 0.4 * np.eye(1), "contact_dofs": [1]}
BASES = {"trial": "fourier", "weight": "fourier", "functions": 31, "quadrature_points": 256}
FREE = {"law": "none"}
STOP = {"law": "linear", "stiffness": 400.0, "gap": 0.0}  # touched from the position at rest


def solve(analysis, contact, time=None, frequency=1.3, **keys):
    """The summary of a converged record; frequency in Hz, under a load of 2 N."""
    forcing = {"load_dofs": [1], "amplitude": 2.0} | ({"frequency": frequency} if frequency else {})
    scene = {"structure": STRUCTURE, "contact": contact, "forcing": forcing, "analysis": {"type": analysis} | keys}
    record = wb.run(scene | ({"time": time} if time else {}))
    assert record.converged, record.summary["status"]
    return record.summary


def linear_amplitude(frequency):
    omega = 2.0 * math.pi * frequency
    return 2.0 / abs(100.0 - omega**2 + 0.4j * omega)


def test_a_response_without_contact_is_that_of_the_oscillator():
    rms = linear_amplitude(1.3) / math.sqrt(2.0)
    assert solve("forced_response", FREE, BASES)["rms_vibration_m"] == pytest.approx(rms, rel=1e-12)


def test_a_sweep_over_the_frequency_has_the_oscillators_peak():
    found = solve("frequency_sweep", FREE, BASES, None, frequency_from=1.2, frequency_to=2.0)
    place = math.sqrt(100.0 - 0.5 * 0.4**2) / (2.0 * math.pi)
    assert found["max_displacement_m"] == pytest.approx(linear_amplitude(place), rel=1e-4)
    assert found["frequency_at_max_displacement_Hz"] == pytest.approx(place, rel=1e-3)


def test_an_exact_motion_is_in_time_stepping_and_alone_among_all_motions():
    exact = solve("forced_response", STOP, {"method": "exact"})["max_displacement_m"]
    assert solve("shooting", STOP)["max_displacement_m"] == exact
    assert solve("time_stepping", STOP)["max_displacement_m"] == pytest.approx(exact, rel=1e-6)
    assert solve("forced_response", STOP, BASES)["max_displacement_m"] == pytest.approx(exact, rel=1e-3)
    found = solve("motions", STOP, random_starts=4)
    assert len(found["motions"]["file"]) == 1
    assert found["max_displacement_m"] == pytest.approx(exact, rel=1e-9)


def test_without_a_gap_displacements_are_proportional_to_the_load():
    largest = solve("forced_response", STOP, {"method": "exact"})["max_displacement_m"]
    swept = solve("amplitude_sweep", STOP, BASES, amplitude_from=0.5, amplitude_to=2.0)
    assert swept["max_displacement_m"] == pytest.approx(largest, rel=1e-3)  # of 31 functions


def test_a_mode_has_a_free_part_of_its_period_and_one_with_the_stop():
    """At twice the energy that touches a gap g, free for 3/4 of the own period, with the speed w g at the gap."""
    structure = {key: value for key, value in STRUCTURE.items() if key != "damping"}
    record = wb.run({"structure": structure, "contact": STOP | {"gap": 0.01},
                     "analysis": {"type": "nonlinear_mode", "harmonics": 40, "energy_ratio": 2.0}})
    stiff = math.sqrt(500.0)
    period = 1.5 * math.pi / 10.0 + 2.0 * math.atan2(10.0 / stiff, 0.2) / stiff
    assert record.converged and record.summary["frequency_Hz"] == pytest.approx(1.0 / period, rel=1e-4)

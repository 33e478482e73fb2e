"""Nonlinear modes of one mass with springs that act on both sides, laws without a gap, and a stop with damping."""

import re

import numpy as np
import pytest
import wavebalance as wb

CUBIC = {"law": "cubic", "cubic_stiffness": 0.5}
CLEARANCE = {"law": "clearance", "stiffness": 3.0, "gap": 0.5}
DAMPED = {"law": "kelvin_voigt", "stiffness": 3.0, "damping": 0.05, "gap": 0.5}


def mode(contact, **analysis):
    """A mass of 1 kg on a spring of 1 N/m, and a law."""
    return {
        "structure": {"type": "matrices", "mass": np.eye(1), "stiffness": np.eye(1), "contact_dofs": [1]},
        "contact": contact,
        "forcing": {"load_dofs": [1], "amplitude": 0.0},
        "analysis": {"type": "nonlinear_mode", **analysis},
    }


def solved(contact, **analysis):
    record = wb.run(mode(contact, **analysis))
    assert record.converged, record.status
    return record


def period_of(amplitude, potential, steps=200000):
    """The period of u'' + u + f(u) = 0 of an amplitude by the energy, 4 int du / sqrt(2 (V(a) - V(u))), where the
    substitution u = a sin(t) removes the singularity at the end."""
    angle = 0.5 * np.pi * (np.arange(steps) + 0.5) / steps
    slowness = amplitude * np.cos(angle) / np.sqrt(2.0 * (potential(amplitude) - potential(amplitude * np.sin(angle))))
    return 2.0 * np.pi * slowness.mean()


def test_the_mode_has_the_frequency_of_duffings_oscillator_at_each_energy():
    record = solved(CUBIC, reference_length=1.0, harmonics=9, samples=128, largest_energy=4.0, last_frequency_ratio=3.0)
    energies, ratios = record.backbone["energy_ratio"], record.backbone["frequency_ratio"]
    assert len(energies) > 20 and energies[-1] > 3.9
    for energy, ratio in zip(energies[::5], ratios[::5]):
        # Energy 1 belongs to the linear mode of amplitude 1, 0.5 J: V(a) = a^2 / 2 + a^4 / 8.
        amplitude = np.sqrt(2.0 * (np.sqrt(1.0 + energy) - 1.0))
        period = period_of(amplitude, lambda u: 0.5 * u**2 + 0.125 * u**4)
        assert ratio == pytest.approx(2.0 * np.pi / period, abs=1e-7), energy
    assert np.isnan(record.summary["max_penetration_over_gap"])


def test_the_mode_has_the_frequency_of_a_clearance_on_both_sides():
    record = solved(CLEARANCE, harmonics=21, samples=1024, largest_energy=5.0, last_frequency_ratio=1.9)
    energies, ratios = record.backbone["energy_ratio"], record.backbone["frequency_ratio"]
    assert energies[-1] > 4.9
    for ratio in ratios[::7][energies[::7] < 1.0]:
        assert ratio == pytest.approx(1.0, abs=1e-6)
    for energy, ratio in zip(energies[::7], ratios[::7]):
        if energy < 1.05:
            continue
        # A linear oscillator between the stops, and another, w^2 = 4, beyond: a quarter of a period of each.
        inside = np.arcsin(0.5 / np.sqrt(0.25 * energy))
        # Beyond the stop u - 3/8 turns with w = 2: 4 (u - 3/8)^2 + v^2 stays the same.
        outside = 0.5 * np.arctan2(np.sqrt(0.25 * energy - 0.25), 2.0 * (0.5 - 0.375))
        assert ratio == pytest.approx(0.5 * np.pi / (inside + outside), abs=1e-4), energy


@pytest.mark.parametrize("contact, analysis, part", [
    (CUBIC, {}, 'the law "cubic" has no gap'),
    (CLEARANCE, {"reference_length": 1.0}, "all laws have gaps"),
    ({**CLEARANCE, "gap": 0.0}, {}, "> 0 for a nonlinear mode"),
])
def test_a_length_is_needed_where_no_gap_is_one_and_no_other_is_taken(contact, analysis, part):
    with pytest.raises(wb.SceneError) as refused:
        wb.check(mode(contact, **analysis))
    assert part in refused.value.allowed


def test_the_mode_has_the_damping_that_a_stop_takes_over_the_amplitude(tmp_path):
    """u'' + u + f = 0 with f = 3 (u - 1/2) + c u' beyond the stop: the work of the damper over a period equals the
    work of the artificial damping, xi times the mean square of the velocity, which gives the decay of a free
    motion."""
    fine = {"harmonics": 31, "samples": 2048}
    record = solved(DAMPED, **fine, largest_amplitude=6.0, points=40)
    assert "friction_work_J" not in record.backbone
    ratios, damping, frequencies = (record.backbone[f"{name}_ratio"] for name in ("amplitude", "damping", "frequency"))
    assert record.summary["slip_amplitude_m"] == pytest.approx(0.5, abs=1e-12)
    assert damping[0] == pytest.approx(0.0, abs=1e-10)
    assert frequencies[0] == pytest.approx(1.0, abs=1e-9)
    assert ratios[-1] > 5.9 and damping[-1] > 0.003 and frequencies[-1] > 1.1
    record.write(tmp_path)
    page = re.sub(r"\s+", " ", (tmp_path / "report.html").read_text())
    assert "no contact slips, opens or closes, and the frequency is" in page
    assert f"The frequency is 1 to {frequencies.max():.4g} times this value." in page
    # One motion: the damper dissipates the energy of the artificial damping.
    motion = solved(DAMPED, **fine, amplitude_ratio=3.0)
    force, velocity = motion.response["contact_force_N"], motion.response["velocity_m_per_s"]
    omega = 2.0 * np.pi * motion.summary["frequency_Hz"]
    taken = force @ velocity / (velocity @ velocity)
    assert motion.summary["damping_ratio"] == pytest.approx(taken / (2.0 * omega), rel=0.01)

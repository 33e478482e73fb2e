"""The cases of Jones & Legrand 2014, and a blade's mode and sweep, against figures that were computed independently."""

import tomllib

import numpy as np
import pytest
import wavebalance as wb


@pytest.mark.parametrize("case, largest, largest_modulus, rms, force_ratio, contact_fraction", [
    ("case1", 1.014506e-3, 1.438608e-3, 0.9316321e-3, 0.2902, 0.2396),
    ("case2", 15.20671e-3, 16.26369e-3, 11.47116e-3, 5.694, 0.1069),
])
def test_exact_solutions_meet_the_reference(case, largest, largest_modulus, rms, force_ratio, contact_fraction, scenes):
    scene = tomllib.loads((scenes / "jones_legrand_2014" / f"{case}.toml").read_text())
    record = wb.run({**scene, "time": {"method": "exact"}}, {"analysis.output_points": 65536})
    assert record.converged, record.status
    u, force = record.response["displacement_m"], record.response["contact_force_N"]
    # The listed values have seven digits.
    assert u.max() == pytest.approx(largest, rel=1e-6)
    assert np.abs(u).max() == pytest.approx(largest_modulus, rel=1e-6)
    assert np.sqrt(np.mean(u**2)) == pytest.approx(rms, rel=1e-6)
    assert force.max() / 250e3 == pytest.approx(force_ratio, rel=2e-4)
    # The reference counted samples; a grid of 4096 points resolves the fraction to one of them.
    assert np.mean(force > 0.0) == pytest.approx(contact_fraction, abs=1.0 / 4096)


def test_the_sweep_turns_where_the_reference_turns(scenes):
    record = wb.run(scenes / "jones_legrand_2014" / "case2_sweep.toml",
                    {"time.functions": 63, "time.quadrature_points": 1024, "analysis.stability": False})
    assert record.converged, record.status
    assert record.summary["turning_points_Hz"] == pytest.approx([1337.748, 1315.067], abs=0.1)


@pytest.fixture(scope="module")
def blade(request):
    """Solves the blade's mode, with a choice of mode and energy."""
    scene = request.path.parents[2] / "reproduce" / "scenes" / "laxalde_legrand_2010" / "blade_mode.toml"
    return lambda **analysis: wb.run(scene, {f"analysis.{key}": value for key, value in analysis.items()})


# Found independently; the reduction is within 4e-4.
@pytest.mark.parametrize("mode, expected", enumerate([570.0, 1662.4, 2206.2, 3781.2, 4655.5], start=1))
def test_the_reduced_blade_keeps_the_frequencies(mode, expected, blade):
    summary = blade(mode=mode, energy_ratio=0.5).summary
    assert (summary["degrees_of_freedom"], summary["reduced_degrees_of_freedom"]) == (3936, 112)
    assert summary["contacts"] == 24
    assert summary["linear_frequency_Hz"] == pytest.approx(expected, rel=5e-4)


def test_the_blades_mode_is_converged(blade):
    record = blade()
    assert record.converged, record.status


@pytest.mark.parametrize("energy, ratio", [(1.2, 1.0069), (2.0, 1.0377), (3.0, 1.0808), (7.0, 1.1931)])
def test_the_blades_mode_is_that_found_independently(energy, ratio, blade):
    record = blade(energy_ratio=energy)
    assert record.status == "converged"
    assert record.summary["frequency_ratio"] == pytest.approx(ratio, abs=0.003)
    assert record.summary["residual"] < 1e-9
    assert record.summary["virial_residual"] < 1e-12
    assert record.summary["min_contact_force_N"] >= 0.0


def test_the_blades_leading_edge_touches_first_and_its_trailing_edge_half_a_period_later(blade):
    record = blade(energy_ratio=4.7)
    assert record.status == "converged"
    table = record.contacts
    force = np.array([table["contact_force_N"][table["contact"] == contact] for contact in range(1, 25)])
    begin, half = force[:, 0], force[:, force.shape[1] // 2]
    assert begin[:2].max() > 0.0 and begin[-2:].max() == 0.0
    assert half[-2:].max() > 0.0 and half[:2].max() == 0.0


def distance_from(curve, frequency, displacement):
    """Relative distance of a largest displacement from the nearest part of a curve at its frequency."""
    at, height = curve["frequency_Hz"], curve["max_displacement_m"]
    enclosing = ((at[:-1] - frequency) * (at[1:] - frequency) <= 0.0) & (at[:-1] != at[1:])
    share = (frequency - at[:-1][enclosing]) / np.diff(at)[enclosing]
    found = height[:-1][enclosing] + share * np.diff(height)[enclosing]
    return np.min(np.abs(found - displacement) / displacement, initial=np.inf)


# With fewer elements, loaded by 1.5 times its force, about its resonance; 16 Fourier functions are solved as 15.
@pytest.mark.parametrize("trial", ["fourier", "haar"])
def test_the_blades_sweep_reaches_its_end_through_the_responses_at_single_frequencies(trial, scenes):
    changes = {"structure.chord_elements": 3, "structure.span_elements": 6, "forcing.amplitude": 30,
               "time.trial": trial, "time.weight": "fourier", "time.functions": 16, "analysis.stability": False,
               "analysis.output_points": 64}
    scene, ends = scenes / "blade" / "sweep.toml", ["analysis.frequency_from", "analysis.frequency_to"]
    sweep = wb.run(scene, {**changes, ends[0]: 590, ends[1]: 670})
    assert sweep.status == "reached_end"
    assert len(sweep.summary["turning_points_Hz"]) >= 2
    for frequency in (610.0, 635.0, 660.0):
        response = wb.run(scene, {**changes, "analysis.type": "forced_response", "forcing.frequency": frequency,
                                  "analysis.motion_points": 0, "analysis.phases": False}, unset=ends)
        assert response.converged, frequency
        assert distance_from(sweep.sweep, frequency, response.contacts["displacement_m"].max()) < 2e-3

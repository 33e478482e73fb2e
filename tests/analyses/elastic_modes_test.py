"""Nonlinear modes of a rod with an elastic stop, and the stability of their motions."""

import numpy as np
import pytest
import wavebalance as wb
from rods_and_bars import ROD, figure_of, labels_of

STOP = 1e9  # N/m, five times the rod's
ELASTIC = {**ROD, "contact": {"law": "linear", "stiffness": STOP, "gap": 1e-3}}
STOPPED = {**ROD, "contact": {"law": "linear", "stiffness": 5e8, "gap": 1e-3}}
PLAIN = {"analysis.stability": False}


def test_a_curve_reaches_the_energy_asked_for(tmp_path):
    record = wb.run(ELASTIC, PLAIN)
    assert record.converged and record.status == "converged"
    summary, table = record.summary, record.backbone
    assert summary["residual"] < 1e-8
    assert summary["largest_energy_ratio"] >= 10.0
    assert (summary["functions"], summary["quadrature_points"]) == (21, 80)
    assert table["energy_ratio"][5] == 1.0
    assert table["frequency_ratio"][-1] > 1.1
    assert table["modal_energy_ratio"][-1] < table["energy_ratio"][-1]
    assert figure_of(record, tmp_path, "backbone")["panels"]


def test_a_motion_of_an_energy_has_the_force_of_its_law():
    record = wb.run(ELASTIC, {"analysis.energy_ratio": 3})
    assert record.converged, record.status
    assert record.summary["energy_ratio"] == pytest.approx(3.0, abs=1e-8)
    highest = record.summary["max_displacement_m"]
    assert highest > 1e-3
    assert record.summary["max_contact_force_N"] == pytest.approx(STOP * (highest - 1e-3), abs=1e-9 * STOP * highest)
    assert len(record.response["displacement_m"]) == 1024


def test_a_motion_of_an_energy_below_contact_is_the_linear_mode():
    record = wb.run(ELASTIC, {"analysis.energy_ratio": 0.25})
    assert record.status == "linear"
    assert record.summary["max_displacement_m"] == pytest.approx(0.5e-3, abs=1e-12)


def test_an_exponential_law_has_a_curve():
    record = wb.run({**ROD, "contact": {"law": "exponential", "constant": 1e5, "exponent": 5e3, "gap": 1e-3}}, PLAIN)
    assert record.converged, record.status
    assert record.summary["largest_energy_ratio"] >= 10.0


def frequency(trial, weight, functions):
    """Frequency over the linear one at three times the energy of grazing, of a rod with two elements."""
    time = {"trial": trial, "weight": weight, "functions": functions, "quadrature_points": 512}
    record = wb.run({**ELASTIC, "time": time}, {"analysis.energy_ratio": 3, "structure.elements": 2})
    assert record.converged, record.status
    return record.summary["frequency_ratio"]


@pytest.fixture(scope="module")
def fine_frequency():
    """Response with 127 Fourier functions."""
    return frequency("fourier", "fourier", 127)


@pytest.mark.parametrize("trial, weight", [
    ("fourier", "fourier"), ("bspline", "bspline"), ("daubechies6", "daubechies6"), ("daubechies6", "fourier"),
    ("haar", "fourier"),
])
def test_pairs_of_bases_agree(trial, weight, fine_frequency):
    assert frequency(trial, weight, 64) == pytest.approx(fine_frequency, abs=2e-4)


def test_a_curve_below_the_energy_asked_for_says_where_it_ends():
    short = {**PLAIN, "analysis.last_frequency_ratio": 1.02}
    record = wb.run(ELASTIC, short)
    assert record.converged
    assert "ended at frequency ratio 1.02" in record.status
    assert "before the energy ratio 10 asked for: last_frequency_ratio is reached" in record.status
    motion = wb.run(ELASTIC, {**short, "analysis.energy_ratio": 9})
    assert not motion.converged
    assert motion.status.startswith("ended at frequency ratio 1.02")


@pytest.mark.parametrize("changes, part", [
    ({"analysis.samples": 20}, "expected samples > 2 x harmonics = 20"),
    ({"time.trial": "fourier"}, "expected both time.trial and time.weight"),
    ({"time.trial": "haar", "time.weight": "bspline", "time.functions": 64}, "damps a free motion"),
])
def test_bad_input_names_the_key_and_what_is_allowed(changes, part):
    with pytest.raises(wb.SceneError) as refused:
        wb.check(ELASTIC, changes)
    assert part in str(refused.value)


def test_a_curve_has_a_count_at_every_point_that_is_known_and_its_special_points(tmp_path):
    record = wb.run(STOPPED)
    assert record.converged, record.status
    assert record.summary["stability"] == "converged"
    unstable, contacts = record.backbone["unstable"], record.backbone["contacts"]
    assert (unstable[0], contacts[5], contacts[-1]) == (0.0, 0.0, 1.0)
    changes = np.count_nonzero(unstable[1:] != unstable[:-1])
    assert 0 < changes <= len(record.summary["special_points"]["type"])
    assert {"ω", "ω, unstable"} <= set(labels_of(figure_of(record, tmp_path, "backbone")))


def test_a_motion_of_an_energy_has_its_leading_multiplier():
    summary = wb.run(STOPPED, {"analysis.energy_ratio": 1.5}).summary
    assert summary["stability"] == "stable" and summary["unstable_multipliers"] == 0
    error = summary["leading_multiplier_error"]
    modulus = np.hypot(summary["leading_multiplier_real"], summary["leading_multiplier_imag"])
    assert error < 1e-2 and modulus == pytest.approx(1.0, abs=2.0 * error)


def test_rigid_contact_with_mass_has_no_stability_without_a_law_of_impact(tmp_path):
    curve = wb.run(ROD)
    assert curve.summary["stability"] == "no_law_of_impact"
    assert "special_points" not in curve.summary
    assert "ω, unstable" not in labels_of(figure_of(curve, tmp_path, "backbone"))
    motion = wb.run(ROD, {"analysis.energy_ratio": 2}).summary
    assert motion["stability"] == "no_law_of_impact"
    assert np.isnan(motion["unstable_multipliers"])


def test_rigid_contact_without_mass_has_a_stability():
    record = wb.run(ROD, {"contact.mass": "redistribute", "analysis.harmonics": 20, "analysis.samples": 160,
                          "analysis.points": 100, "analysis.largest_energy": 2})
    assert record.converged, record.status
    assert record.summary["stability"] == "converged"
    assert record.summary["contact_mass_frequency_change"] < 0.2
    assert record.backbone["unstable"][0] == 0.0
    assert record.backbone["frequency_ratio"][-1] > 1.05


def test_stability_is_left_out_on_request(tmp_path):
    record = wb.run(STOPPED, PLAIN)
    assert "stability" not in record.summary
    assert labels_of(figure_of(record, tmp_path, "backbone"))[0].startswith("ω")


def test_a_curve_to_a_large_energy_has_about_the_points_asked_for(tmp_path):
    # u'' + u + u^3 = 0: omega is the arithmetic-geometric mean of (1 + A^2)^0.5 and (1 + A^2 / 2)^0.5.
    matrix = tmp_path / "one.mtx"
    matrix.write_text("%%MatrixMarket matrix coordinate real general\n1 1 1\n1 1 1.0\n")
    scene = {"structure": {"type": "matrices", "mass": str(matrix), "stiffness": str(matrix), "contact_dofs": [1]},
             "contact": {"law": "cubic", "cubic_stiffness": 1.0},
             "analysis": {"type": "nonlinear_mode", "harmonics": 31, "reference_length": 1.0, "largest_energy": 500.0,
                          "points": 150, "stability": False}}
    record = wb.run(scene)
    assert record.converged, record.status
    table = record.backbone
    assert 75 <= len(table["energy_ratio"]) <= 600
    amplitude = table["max_displacement_m"]
    high, low = np.sqrt(1.0 + amplitude**2), np.sqrt(1.0 + 0.5 * amplitude**2)
    for _ in range(8):
        high, low = 0.5 * (high + low), np.sqrt(high * low)
    np.testing.assert_allclose(table["frequency_ratio"], high, rtol=1e-6)
    assert np.isnan(table["contact_fraction"]).all()  # a spring that always acts is never in contact
